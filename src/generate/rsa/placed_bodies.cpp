#include "generate/rsa/placed_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "packstone/core/memory_hints.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone::rsa {
namespace {

// The difference d of two coordinates brought to the nearest image; per_length is 1 / length, or 0
// where nothing is periodic. Adding and subtracting 1.5 * 2^52 rounds to an integer, without a
// branch that nobody could predict.
inline double nearest(double d, double length, double per_length) {
  constexpr double round = 0x1.8p52;
  return d - length * ((d * per_length + round) - round);
}

// The images of one coordinate difference that come within reach: first + k length, k < count.
struct AxisImages {
  double first;
  int count;
};
inline AxisImages images_within(double d, double length, double reach) {
  if (length == 0.0) return {d, std::abs(d) < reach ? 1 : 0};
  AxisImages images{d, 0};
  while (images.first > -reach) images.first -= length;
  while (images.first <= -reach) images.first += length;
  while (images.first + images.count * length < reach) ++images.count;
  return images;
}

// Length over width from which the mask of axes, and the grid of capsules, save time.
constexpr double kLong = 5.0;
constexpr double kVeryLong = 15.0;

double mean_aspect(const std::vector<OrderedBody>& bodies) {
  double half_lengths = 0.0, radii = 0.0;
  for (const OrderedBody& ordered : bodies) {
    const Outline outline = outline_of(ordered.body);
    half_lengths += outline.half_length;
    radii += outline.radius;
  }
  return half_lengths / radii;
}

double thinnest_of(const std::vector<OrderedBody>& bodies) {
  double least = std::numeric_limits<double>::infinity();
  for (const OrderedBody& ordered : bodies) {
    least = std::min(least, outline_of(ordered.body).in_radius);
  }
  return least;
}

// Shifts n, in periods, for which lo - distance < x + n length < hi + distance.
struct ShiftRange {
  int first;
  int last;
};

}  // namespace

Candidate::Candidate(const Body& from, bool with_extents) : body(from), outline(outline_of(from)) {
  if (with_extents) half_extents = packstone::half_extents(from);
}

bool proven_apart(const Body& a, const Outline& outline_a, const Body& b, const Outline& outline_b,
                  const Vec3& r_ab, double min_gap) noexcept {
  const Verdict seen = glance(outline_a, outline_b, r_ab, min_gap).verdict;
  if (seen != Verdict::undecided) return seen == Verdict::separated;
  return overlap(a, b, r_ab, min_gap) == Verdict::separated;
}

// The pairs of one trial. Those that outlines do not settle wait for the exact test until all
// others have been looked at, because a later one may settle the trial at once.
class PlacedBodies::NearPairs {
 public:
  NearPairs(const PlacedBodies& placed, const Candidate& candidate)
      : placed_(placed), candidate_(candidate) {}

  // False: the candidate is known not to fit.
  bool add(std::int32_t body, const Vec3& r) {
    cost_ += Cost::glance;
    const Verdict seen =
        quick_verdict(candidate_.outline, placed_.bodies_[body].outline, r, placed_.min_gap_);
    if (seen != Verdict::undecided) return seen == Verdict::separated;
    if (count_ == kCapacity && !settle()) return false;
    near_[static_cast<std::size_t>(count_++)] = {body, r.x, r.y, r.z};
    return true;
  }

  // Is the candidate apart from all that wait?
  bool settle() {
    for (int k = 0; k < count_; ++k) {
      const Near& pair = near_[static_cast<std::size_t>(k)];
      cost_ += Cost::kernel;
      if (overlap(candidate_.body, placed_.bodies_[pair.body].body, {pair.x, pair.y, pair.z},
                  placed_.min_gap_) != Verdict::separated) {
        return false;
      }
    }
    count_ = 0;
    return true;
  }

  [[nodiscard]] std::int64_t cost() const { return cost_; }

 private:
  static constexpr int kCapacity = 32;
  // A pair that the balls of outlines do not settle. Coordinates one by one, since a Vec3 would be
  // set to zero for every trial.
  struct Near {
    std::int32_t body;
    double x, y, z;  // From the candidate.
  };

  const PlacedBodies& placed_;
  const Candidate& candidate_;
  std::array<Near, kCapacity> near_;
  int count_ = 0;
  std::int64_t cost_ = 0;
};

PlacedBodies::PlacedBodies(const Cell& cell, double min_gap, std::int64_t expected)
    : cell_(cell),
      min_gap_(min_gap),
      use_grid_(expected > kMostSearchedOneByOne),
      needs_extents_(use_grid_),
      shortest_period_(shortest_period(cell)),
      period_{0.0, 0.0, 0.0},
      per_period_{0.0, 0.0, 0.0},
      lanes_(cell_),
      grid_(cell) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    needs_extents_ |= !cell.periodic[axis];
    if (!cell.periodic[axis]) continue;
    period_[axis] = cell.size[axis];
    per_period_[axis] = 1.0 / cell.size[axis];
  }
  const auto count = static_cast<std::size_t>(expected);
  bodies_.reserve(count);
  prefer_large_pages(bodies_.data(), count * sizeof(Placed));
  if (use_grid_) grid_.reserve(expected);
}

PlacedBodies::PlacedBodies(const Cell& cell, double min_gap, const std::vector<OrderedBody>& bodies,
                           std::span<const std::int64_t> order)
    : PlacedBodies(cell, min_gap, std::ssize(order)) {
  if (!use_grid_ || cell.dimension == 2) return;
  const double aspect = mean_aspect(bodies);
  if (aspect >= kLong) axes_.emplace(cell, min_gap, thinnest_of(bodies));
  if (aspect < kVeryLong) return;
  for (const std::int64_t item : order) {
    const Body& body = bodies[static_cast<std::size_t>(item)].body;
    expected_.push_back(capsule_about(outline_of(body), {}));
  }
  capsules_.emplace(cell);
  capsules_->reset(expected_);
}

void PlacedBodies::clear() {
  bodies_.clear();
  lanes_.clear();
  if (axes_) axes_->clear();
  if (capsules_) {
    capsules_->reset(expected_);
  } else if (use_grid_) {
    grid_.clear();
  }
  largest_circum_radius_ = 0.0;
}

// More bodies came than were expected.
void PlacedBodies::switch_to_grid() {
  use_grid_ = true;
  needs_extents_ = true;
  for (std::int32_t i = 0; i < size(); ++i) insert(i, packstone::half_extents(bodies_[i].body));
}

Capsule PlacedBodies::capsule_about(const Outline& outline, const Vec3& center) const {
  return {center, outline.axis, outline.half_length, outline.radius + 0.5 * min_gap_};
}

void PlacedBodies::insert(std::int32_t i, const Vec3& half_extents) {
  const Placed& placed = bodies_[i];
  if (axes_) axes_->add(placed.outline, placed.center);
  if (capsules_) {
    capsules_->insert(i, capsule_about(placed.outline, placed.center));
  } else {
    grid_.insert(i, placed.center, half_extents, placed.outline.in_radius);
  }
}

void PlacedBodies::add(const Candidate& candidate, const Vec3& center) {
  if (!use_grid_ && size() >= kMostSearchedOneByOne) switch_to_grid();
  bodies_.push_back({candidate.outline, center, candidate.body});
  if (use_grid_) {
    insert(size() - 1, packstone::half_extents(candidate.body));
  } else {
    lanes_.add(candidate.outline, center);
  }
  largest_circum_radius_ = std::max(largest_circum_radius_, candidate.outline.circum_radius);
}

bool PlacedBodies::look_around(const Outline& outline, const Vec3& center, View& view,
                               std::int64_t& cost) const {
  if (use_grid_) {
    cost += Cost::search;
    return capsules_ || !grid_.meets_core(center, outline.in_radius + min_gap_);
  }
  cost += static_cast<std::int64_t>(lanes_.groups()) * Cost::pair;
  return !lanes_.ball_overlaps(outline.in_radius, min_gap_, center, view);
}

bool PlacedBodies::leaves_room_for(const Candidate& candidate, const Vec3& center, const View& view,
                                   std::int64_t& cost, std::int32_t since) const {
  NearPairs near(*this, candidate);
  if (use_grid_) {
    if (axes_ && axes_->blocks(candidate.outline, center)) return false;
    return search_grid(candidate, center, near, since) && near.settle();
  }
  const Outline& outline = candidate.outline;
  if (outline.half_length > 0.0 && outline.ends != Outline::Ends::loose) {
    cost += static_cast<std::int64_t>(lanes_.groups()) * Cost::glance;
    if (lanes_.rod_overlaps(outline, min_gap_, view)) return false;
  }
  const bool fits = search_listed(candidate, center, view, near) && near.settle();
  cost += near.cost();
  return fits;
}

bool PlacedBodies::search_listed(const Candidate& candidate, const Vec3& center, const View& view,
                                 NearPairs& near) const {
  const double reach = candidate.outline.circum_radius + min_gap_;
  const bool one_image_each = reach + largest_circum_radius_ < 0.5 * shortest_period_;
  std::array<std::int32_t, BodyLanes::kMost> bodies;
  const std::int32_t count = lanes_.list_near(reach, view, bodies);
  for (std::int32_t k = 0; k < count; ++k) {
    const std::int32_t body = bodies[static_cast<std::size_t>(k)];
    const Vec3 r = nearest_image(bodies_[body].center - center);
    if (!near.add(body, r)) return false;
    if (!one_image_each && !add_farther_images(body, r, reach, near)) return false;
  }
  return true;
}

// Images of a body other than the nearest one, at r.
bool PlacedBodies::add_farther_images(std::int32_t body, const Vec3& r, double reach,
                                      NearPairs& near) const {
  const double far = reach + bodies_[body].outline.circum_radius;
  if (far >= shortest_period_) return add_all_farther_images(body, r, far, near);
  // Along each axis at most one image more, on the other side.
  std::array<double, 3> d{r.x, r.y, r.z}, other{0, 0, 0};
  unsigned possible = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    other[axis] = d[axis] - std::copysign(period_[axis], d[axis]);
    if (period_[axis] > 0.0 && std::abs(other[axis]) < far) possible |= 1u << axis;
  }
  for (unsigned which = possible; which != 0; which = (which - 1) & possible) {
    const Vec3 image{(which & 1u) != 0 ? other[0] : d[0], (which & 2u) != 0 ? other[1] : d[1],
                     (which & 4u) != 0 ? other[2] : d[2]};
    if (norm_sq(image) < far * far * (1.0 + 1e-12) && !near.add(body, image)) return false;
  }
  return true;
}

// The same for bodies that reach over several periods.
bool PlacedBodies::add_all_farther_images(std::int32_t body, const Vec3& r, double far,
                                          NearPairs& near) const {
  const AxisImages x = images_within(r.x, period_[0], far);
  const AxisImages y = images_within(r.y, period_[1], far);
  const AxisImages z = images_within(r.z, period_[2], far);
  for (int nz = 0; nz < z.count; ++nz) {
    for (int ny = 0; ny < y.count; ++ny) {
      for (int nx = 0; nx < x.count; ++nx) {
        const Vec3 image{x.first + nx * period_[0], y.first + ny * period_[1],
                         z.first + nz * period_[2]};
        const double moved =
            std::abs(image.x - r.x) + std::abs(image.y - r.y) + std::abs(image.z - r.z);
        if (moved > 0.25 * shortest_period_ && !near.add(body, image)) return false;
      }
    }
  }
  return true;
}

Vec3 PlacedBodies::nearest_image(const Vec3& d) const {
  return {nearest(d.x, period_[0], per_period_[0]), nearest(d.y, period_[1], per_period_[1]),
          nearest(d.z, period_[2], per_period_[2])};
}

template <class Visit>
bool PlacedBodies::query(const Candidate& candidate, const Vec3& center, const Visit& visit) const {
  if (capsules_) return capsules_->query_pieces(capsule_about(candidate.outline, center), visit);
  return grid_.query(center, candidate.half_extents, min_gap_, visit);
}

bool PlacedBodies::search_grid(const Candidate& candidate, const Vec3& center, NearPairs& near,
                               std::int32_t since) const {
  // In large packings most of the time goes into waiting for memory, so bodies are asked for some
  // at a time before the first of them is looked at. Those that capsules meet mostly overlap.
  constexpr int capacity = 6;
  const int at_once = capsules_ ? 1 : capacity;
  struct Hit {
    std::int32_t id;
    Vec3 shift;
  };
  std::array<Hit, capacity> hits;
  int count = 0;
  const auto look_at_hits = [&] {
    for (int k = 0; k < count; ++k) {
      const Hit& hit = hits[static_cast<std::size_t>(k)];
      if (!near.add(hit.id, (bodies_[hit.id].center - center) + hit.shift)) return false;
    }
    count = 0;
    return true;
  };
  const auto visit = [&](std::int32_t id, const std::array<int, 3>& image) {
    if (id < since) return true;
    prefetch(&bodies_[id], sizeof(Outline) + sizeof(Vec3));
    hits[static_cast<std::size_t>(count++)] = {id, image_shift(cell_, image)};
    return count < at_once || look_at_hits();
  };
  return query(candidate, center, visit) && look_at_hits();
}

void PlacedBodies::add_images_near(std::int32_t i, const Vec3& lo, const Vec3& hi, double reach,
                                   std::vector<PlacedImage>& images) const {
  const Vec3& c = bodies_[i].center;
  const double distance = (reach + bodies_[i].outline.circum_radius + min_gap_) * (1.0 + 1e-12);
  const auto range = [&](std::size_t axis) -> ShiftRange {
    const double length = period_[axis];
    if (length == 0.0) return {0, 0};
    return {static_cast<int>(std::ceil((lo[axis] - distance - c[axis]) / length)),
            static_cast<int>(std::floor((hi[axis] + distance - c[axis]) / length))};
  };
  const ShiftRange x = range(0), y = range(1), z = range(2);
  for (int nz = z.first; nz <= z.last; ++nz) {
    for (int ny = y.first; ny <= y.last; ++ny) {
      for (int nx = x.first; nx <= x.last; ++nx) {
        images.push_back({c + image_shift(cell_, {nx, ny, nz}), i});
      }
    }
  }
}

std::vector<PlacedImage> PlacedBodies::images_near(const Vec3& lo, const Vec3& hi,
                                                   double reach) const {
  std::vector<PlacedImage> images;
  for (std::int32_t i = 0; i < size(); ++i) add_images_near(i, lo, hi, reach, images);
  return images;
}

}  // namespace packstone::rsa
