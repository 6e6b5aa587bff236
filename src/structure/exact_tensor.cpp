#include "structure/exact_tensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "packstone/core/mat.hpp"
#include "packstone/structure/orientation_law.hpp"
#include "structure/tensor_turns.hpp"

namespace packstone {
namespace {

constexpr int kMostIterations = 60;
constexpr double kExact = 2e-15;       // where iteration stops
constexpr double kGoodEnough = 1e-13;  // what is accepted once rounding ends the progress
constexpr double kLargestMap = 0.5;    // bound on |S|

// Equation (1).
Mat6 response(const std::vector<Vec3>& axes) {
  Mat6 g{};
  for (const Vec3& u : axes) add_products(basis_turns(u), 1.0, g);
  const double factor = 2.0 / static_cast<double>(axes.size());
  for (Vec6& row : g) {
    for (double& entry : row) entry *= factor;
  }
  return made_definite(g);
}

double largest_entry(const SymMat3& a) {
  return std::max({std::abs(a.xx), std::abs(a.yy), std::abs(a.zz), std::abs(a.yz), std::abs(a.xz),
                   std::abs(a.xy)});
}

SymMat3 missing(const std::vector<Vec3>& axes, const Vec3& target) {
  return SymMat3{target.x, target.y, target.z, 0, 0, 0} - orientation_tensor(axes);
}

void map_axes(std::vector<Vec3>& axes, const SymMat3& residual) {
  Vec6 s = solve(response(axes), components(residual));
  const double size = std::sqrt(std::inner_product(s.begin(), s.end(), s.begin(), 0.0));
  if (size > kLargestMap) {
    for (double& value : s) value *= kLargestMap / size;
  }
  const SymMat3 map = from_components(s);
  for (Vec3& u : axes) u = normalized(u + map * u);
}

bool iterate(std::vector<Vec3>& axes, const Vec3& target) {
  std::vector<Vec3> best;
  double least = 1.0;
  for (int i = 0; i < kMostIterations; ++i) {
    const SymMat3 residual = missing(axes, target);
    const double error = largest_entry(residual);
    if (error <= kExact) return true;
    if (!std::isfinite(error)) break;
    if (least <= kGoodEnough && error >= 0.5 * least) {
      if (error > least) axes = best;
      return true;
    }
    if (error < least) {
      least = error;
      if (error <= kGoodEnough) best = axes;
    }
    map_axes(axes, residual);
  }
  return false;
}

// Turns columns `low` (shorter than 1) and `high` (longer) against each other until `low` has
// length 1; u u^T + v v^T stays.
void settle(Vec3& low, Vec3& high) {
  const double a = norm_sq(high) - 1.0, b = dot(low, high), c = norm_sq(low) - 1.0;
  // a t^2 + 2 b t + c = 0 with a > 0 > c: the root of smaller size, free of cancellation.
  const double root = std::sqrt(b * b - a * c);
  const double t = b >= 0.0 ? -c / (b + root) : -c / (b - root);
  const double cosine = 1.0 / std::hypot(1.0, t);
  const Vec3 u = cosine * (low + t * high);
  high = cosine * (high - t * low);
  low = u;
}

// Rows of the matrix of axes, made orthogonal with squared norm `wanted` (Gram-Schmidt, twice).
void orthogonalize_rows(std::vector<Vec3>& axes, const Vec3& wanted) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (wanted[k] == 0.0) continue;
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t j = 0; j < k; ++j) {
        double along = 0.0;
        for (const Vec3& u : axes) along += u[j] * u[k];
        for (Vec3& u : axes) u[k] -= along / wanted[j] * u[j];
      }
    }
    double square = 0.0;
    for (const Vec3& u : axes) square += u[k] * u[k];
    for (Vec3& u : axes) u[k] *= std::sqrt(wanted[k] / square);
  }
}

}  // namespace

std::vector<Vec3> exact_axes(const std::vector<Vec3>& start, const Vec3& target) {
  std::vector<Vec3> axes = start;
  orthogonalize_rows(axes, static_cast<double>(axes.size()) * target);
  std::vector<std::size_t> low, high;
  for (std::size_t i = 0; i < axes.size(); ++i) (norm_sq(axes[i]) < 1.0 ? low : high).push_back(i);
  while (!low.empty() && !high.empty()) {
    const std::size_t i = low.back(), j = high.back();
    low.pop_back();
    settle(axes[i], axes[j]);
    if (norm_sq(axes[j]) < 1.0) {
      high.pop_back();
      low.push_back(j);
    }
  }
  for (Vec3& u : axes) u = normalized(u);
  return axes;
}

void make_exact(std::vector<Vec3>& axes, const Vec3& target) {
  if (target.y == 0.0) {
    for (Vec3& u : axes) u = {1, 0, 0};
    return;
  }
  const std::vector<Vec3> start = axes;
  if (!iterate(axes, target)) axes = exact_axes(start, target);
}

}  // namespace packstone
