#include "structure/tabulated_law.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <utility>

namespace packstone {
namespace {

constexpr int kMostHalvings = 24;
constexpr double kPanelTolerance = 1e-13;

std::vector<double> graded(const std::vector<double>& breaks) {
  std::vector<double> edges{breaks.front()};
  for (double next : breaks) {
    while (next > 2.0 * edges.back()) edges.push_back(2.0 * edges.back());
    if (next > edges.back()) edges.push_back(next);
  }
  return edges;
}

}  // namespace

TabulatedLaw::TabulatedLaw(std::function<double(double)> log_density,
                           const std::vector<double>& breaks)
    : log_density_(std::move(log_density)) {
  const std::vector<double> edges = graded(breaks);
  log_scale_ = -std::numeric_limits<double>::infinity();
  for (double x : edges) log_scale_ = std::max(log_scale_, log_density_(x));

  std::vector<double> first_pass;
  double total = 0.0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    first_pass.push_back(integral(edges[i], edges[i + 1]));
    total += first_pass.back();
  }
  edges_.push_back(edges.front());
  cumulative_.push_back(0.0);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    add_panel(edges[i], edges[i + 1], first_pass[i], kPanelTolerance * total, kMostHalvings);
  }
}

double TabulatedLaw::density(double x) const { return std::exp(log_density_(x) - log_scale_); }

double TabulatedLaw::integral(double lo, double hi) const {
  return boost::math::quadrature::gauss<double, 15>::integrate(
      [this](double x) { return density(x); }, lo, hi);
}

void TabulatedLaw::add_panel(double lo, double hi, double value, double tolerance, int depth) {
  const double middle = 0.5 * (lo + hi);
  const double left = integral(lo, middle);
  const double right = integral(middle, hi);
  if (depth == 0 || std::abs(left + right - value) <= tolerance) {
    edges_.push_back(hi);
    cumulative_.push_back(cumulative_.back() + left + right);
    return;
  }
  add_panel(lo, middle, left, tolerance, depth - 1);
  add_panel(middle, hi, right, tolerance, depth - 1);
}

double TabulatedLaw::quantile(double u) const {
  const double wanted = u * cumulative_.back();
  const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end(), wanted);
  const auto last = static_cast<std::ptrdiff_t>(edges_.size()) - 2;
  const auto panel = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - cumulative_.begin() - 1, 0, last));

  const double start = edges_[panel];
  const double target = wanted - cumulative_[panel];
  double lo = start, hi = edges_[panel + 1];
  double x = lo + (hi - lo) * target / (cumulative_[panel + 1] - cumulative_[panel]);
  // Newton, kept inside a bracket that shrinks each time.
  for (int i = 0; i < 60; ++i) {
    const double excess = integral(start, x) - target;
    (excess > 0.0 ? hi : lo) = x;
    double next = x - excess / density(x);
    if (!(next >= lo && next <= hi)) next = 0.5 * (lo + hi);
    const double step = next - x;
    x = next;
    if (std::abs(step) <= 1e-14 * x) break;
  }
  return x;
}

double TabulatedLaw::log_integral() const { return std::log(cumulative_.back()) + log_scale_; }

}  // namespace packstone
