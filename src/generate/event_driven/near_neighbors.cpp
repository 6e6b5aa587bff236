#include "generate/event_driven/near_neighbors.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/structure/images.hpp"

namespace packstone::event_driven {
namespace {

// Numbers of neighbors that runs are fastest with, as measured: more of them where bodies are so
// long that finding them takes long.
constexpr double kFewNeighbors = 14.0;
constexpr double kManyNeighbors = 28.0;
constexpr double kLong = 5.0;

double least_semi_axis(Form form, const Spin& spin, double second) {
  if (form == Form::spherocylinder) return spin.lateral;
  const double least = std::min(spin.axial, spin.lateral);
  return form == Form::scalene ? std::min(least, second) : least;
}

}  // namespace

NearNeighbors::NearNeighbors(const Bodies& bodies, const Cell& cell)
    : bodies_(bodies), cell_(cell), grid_(cell), near_(bodies, cell) {
  const std::size_t n = bodies.flight.size();
  double aspects = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double second = bodies.second_semi_axis(k);
    const double least = least_semi_axis(bodies.form[k], bodies.spin[k], second);
    margin_scale_.push_back(std::cbrt(least * least * bodies.reach[k]));
    aspects += bodies.reach[k] / least;
  }
  // Beside bodies much larger than most there are small ones: it is their distances that count.
  constexpr double kLargest = 2.0;
  double mean = 0.0;
  for (const double scale : margin_scale_) mean += scale / static_cast<double>(n);
  for (double& scale : margin_scale_) scale = std::min(scale, kLargest * mean);
  const bool long_bodies = aspects > kLong * static_cast<double>(n);
  wanted_ = long_bodies ? kManyNeighbors : kFewNeighbors;
  if (cell.dimension == 2) wanted_ *= 0.6;
}

// Fills candidates_ with whoever in the grid may be near body i.
void NearNeighbors::gather(std::int32_t i) {
  candidates_.clear();
  const double reach = near_.reach(i);
  grid_.query(near_.capsule(i), scratch_, [&](std::int32_t j, const CapsuleGrid::Image& image) {
    if (j != i) candidates_.push_back(near_.neighbor(i, j, image));
    return true;
  });
  for_own_images(cell_, {reach, reach, reach}, 0.0, [&](const std::array<int, 3>& image) {
    candidates_.push_back(near_.neighbor(i, i, image));
    return true;
  });
}

// Puts body i into the grid, and it and those in there whose neighborhoods meet its own into each
// other's lists.
void NearNeighbors::join(std::int32_t i) {
  gather(i);
  near_.keep_near(i, candidates_);
  for (const Neighbor& candidate : candidates_) lists_.add(i, candidate);
  grid_.insert(i, near_.capsule(i));
  add_walls(i);
}

void NearNeighbors::add_walls(std::int32_t i) {
  for (int axis = 0; axis < cell_.dimension; ++axis) {
    if (cell_.periodic[static_cast<std::size_t>(axis)]) continue;
    for (const bool high : {false, true}) {
      if (near_.wall_gap(i, axis, high) > near_.margin(i)) continue;
      Neighbor neighbor;
      neighbor.body = wall(axis, high);
      lists_.add(i, neighbor);
    }
  }
}

// Too many neighbors: a thinner margin, and the other way round.
double NearNeighbors::adapted_margin(std::int32_t i) const {
  constexpr double kMostChange = 1.3, kThinnest = 0.2, kThickest = 2.5;
  const double factor =
      std::clamp(std::cbrt(wanted_ / (lists_.size(i) + 1.0)), 1.0 / kMostChange, kMostChange);
  const double usual = mean_margin_ * margin_scale_[static_cast<std::size_t>(i)];
  return std::clamp(factor * near_.margin(i), kThinnest * usual, kThickest * usual);
}

// Takes all bodies as they stand, with margins of `margin` times their scale, into the grid.
void NearNeighbors::stand_all(double t, double margin) {
  const std::int32_t n = bodies_.count();
  std::vector<Capsule> capsules;
  capsules.reserve(static_cast<std::size_t>(n));
  for (std::int32_t i = 0; i < n; ++i) {
    near_.set(i, t, margin * margin_scale_[static_cast<std::size_t>(i)]);
    capsules.push_back(near_.capsule(i));
  }
  grid_.reset(capsules);
}

// Margins, in units of each body's own scale, at which bodies have as many neighbors as wanted:
// from the gaps around a sample of them.
void NearNeighbors::settle_margins(double t) {
  constexpr std::int32_t kSample = 64;
  const std::int32_t n = bodies_.count();
  const double spacing =
      cell_.dimension == 2 ? std::sqrt(volume(cell_) / n) : std::cbrt(volume(cell_) / n);
  double scale = 0.0;
  for (const double s : margin_scale_) scale += s / n;
  const double most = 0.5 * spacing / scale;
  stand_all(t, most);
  for (std::int32_t i = 0; i < n; ++i) grid_.insert(i, near_.capsule(i));
  std::vector<double> margins;  // At which a neighbor comes in.
  std::int32_t asked = 0;
  for (std::int32_t i = 0; i < n; i += std::max(1, n / kSample), ++asked) {
    gather(i);
    gaps_.resize(candidates_.size());
    near_.bound_gaps(i, candidates_, gaps_.data());
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      margins.push_back(gaps_[k] / (margin_scale_[static_cast<std::size_t>(i)] +
                                    margin_scale_[static_cast<std::size_t>(candidates_[k].body)]));
    }
  }
  mean_margin_ = most;
  const auto rank = static_cast<std::size_t>(wanted_ * asked);
  if (rank >= margins.size()) return;
  const auto at = margins.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(margins.begin(), at, margins.end());
  mean_margin_ = std::clamp(*at, 1e-3 * most, most);
}

void NearNeighbors::rebuild_all(double t) {
  settle_margins(t);
  const std::int32_t n = bodies_.count();
  lists_.reset(n);
  stand_all(t, mean_margin_);
  for (std::int32_t i = 0; i < n; ++i) join(i);
}

void NearNeighbors::rebuild(std::int32_t i, double t) {
  ++rebuilds_;
  const double margin = adapted_margin(i);
  lists_.remove(i);
  grid_.remove(i);
  near_.set(i, t, margin);
  join(i);
}

}  // namespace packstone::event_driven
