#include "generate/rsa/placed_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"

namespace packstone::rsa {
namespace {

// Up to here a loop over all bodies beats the grid: for equal ellipsoids of aspect 2 at fraction
// 0.25 the two take the same time near 180 bodies.
constexpr std::int64_t kMostSearchedOneByOne = 150;

// In the search one by one: covers the rounding of floats, and that of the coarse coordinates
// relative to the longest edge [-].
constexpr float kFloatSlack = 1e-5F;
constexpr double kCoarseSlack = 0x1p-28;

// The part of the reach, squared, that counts as near in the search one by one [-].
constexpr float kNearPart = 0.25F;

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
    near_[count_++] = {body, r};
    return true;
  }

  // Is the candidate apart from all that wait?
  bool settle() {
    for (int k = 0; k < count_; ++k) {
      const Near& pair = near_[k];
      cost_ += Cost::kernel;
      if (overlap(candidate_.body, placed_.bodies_[pair.body].body, pair.r, placed_.min_gap_) !=
          Verdict::separated) {
        return false;
      }
    }
    count_ = 0;
    return true;
  }

  [[nodiscard]] std::int64_t cost() const { return cost_; }

 private:
  static constexpr int kCapacity = 32;

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
      shortest_period_(std::numeric_limits<double>::infinity()),
      period_{0.0, 0.0, 0.0},
      per_period_{0.0, 0.0, 0.0},
      grid_step_{0.0, 0.0, 0.0},
      per_grid_step_{0.0, 0.0, 0.0},
      grid_(cell) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    // 2^32 steps to a period; along walls half as many, so that no difference wraps around.
    grid_step_[axis] = cell.size[axis] * (cell.periodic[axis] ? 0x1p-32 : 0x1p-30);
    per_grid_step_[axis] = 1.0 / grid_step_[axis];
    needs_extents_ |= !cell.periodic[axis];
    if (!cell.periodic[axis]) continue;
    period_[axis] = cell.size[axis];
    per_period_[axis] = 1.0 / cell.size[axis];
    shortest_period_ = std::min(shortest_period_, cell.size[axis]);
  }
  const auto count = static_cast<std::size_t>(expected);
  bodies_.reserve(count);
  if (use_grid_) {
    grid_.reserve(expected);
    return;
  }
  for (auto* column : {&x_, &y_, &z_}) column->reserve(count);
  for (auto* column : {&reach_, &core_}) column->reserve(count);
}

void PlacedBodies::clear() {
  bodies_.clear();
  for (auto* column : {&x_, &y_, &z_}) column->clear();
  for (auto* column : {&reach_, &core_}) column->clear();
  if (use_grid_) grid_.clear();
  largest_circum_radius_ = 0.0;
}

// More bodies came than were expected.
void PlacedBodies::switch_to_grid() {
  use_grid_ = true;
  needs_extents_ = true;
  for (std::int32_t i = 0; i < size(); ++i) {
    grid_.insert(i, bodies_[i].center, packstone::half_extents(bodies_[i].body));
  }
}

void PlacedBodies::add(const Candidate& candidate, const Vec3& center) {
  if (!use_grid_ && size() >= kMostSearchedOneByOne) switch_to_grid();
  if (use_grid_) {
    grid_.insert(size(), center, packstone::half_extents(candidate.body));
  } else {
    const GridPoint p = grid_point(center);
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
    reach_.push_back(static_cast<float>(candidate.outline.circum_radius));
    const double longest = std::max({cell_.size.x, cell_.size.y, cell_.size.z});
    core_.push_back(
        static_cast<float>(std::max(0.0, candidate.outline.in_radius - kCoarseSlack * longest)));
  }
  bodies_.push_back({candidate.body, candidate.outline, center});
  largest_circum_radius_ = std::max(largest_circum_radius_, candidate.outline.circum_radius);
}

bool PlacedBodies::leaves_room_for(const Candidate& candidate, const Vec3& center,
                                   std::int64_t& cost) const {
  NearPairs near(*this, candidate);
  const bool possible =
      use_grid_ ? search_grid(candidate, center, near) : search_all(candidate, center, near, cost);
  const bool fits = possible && near.settle();
  cost += near.cost();
  return fits;
}

bool PlacedBodies::search_all(const Candidate& candidate, const Vec3& center, NearPairs& near,
                              std::int64_t& cost) const {
  constexpr std::int32_t block = 64;
  const double reach = candidate.outline.circum_radius + min_gap_;
  const double longest = std::max({cell_.size.x, cell_.size.y, cell_.size.z});
  const auto float_reach = static_cast<float>(reach + kCoarseSlack * longest);
  const auto float_core = static_cast<float>(candidate.outline.in_radius + min_gap_);
  const GridPoint c = grid_point(center);
  const auto sx = static_cast<float>(grid_step_[0]), sy = static_cast<float>(grid_step_[1]),
             sz = static_cast<float>(grid_step_[2]);
  const bool one_image_each = reach + largest_circum_radius_ < 0.5 * shortest_period_;
  const std::int32_t count = size();
  for (std::int32_t first = 0; first < count; first += block) {
    const std::int32_t in_block = std::min(block, count - first);
    float part[block], near_part[block];
    int inside = 0;
    for (std::int32_t k = 0; k < in_block; ++k) {
      // Unsigned differences wrap around as the cell does: these are the nearest images.
      const float dx = sx * static_cast<float>(static_cast<std::int32_t>(x_[first + k] - c.x));
      const float dy = sy * static_cast<float>(static_cast<std::int32_t>(y_[first + k] - c.y));
      const float dz = sz * static_cast<float>(static_cast<std::int32_t>(z_[first + k] - c.z));
      const float distance_sq = dx * dx + dy * dy + dz * dz;
      const float far = (float_reach + reach_[first + k]) * (1.0F + kFloatSlack);
      const float near_by = (float_core + core_[first + k]) * (1.0F - kFloatSlack);
      inside |= static_cast<int>(distance_sq < near_by * near_by);
      part[k] = distance_sq - far * far;
      near_part[k] = distance_sq - kNearPart * far * far;
    }
    cost += in_block / 4 * Cost::pair;
    if (inside != 0) return false;
    // The nearer ones of those within reach first: they are the likeliest to overlap.
    std::int32_t nearer[block + 1], farther[block + 1];
    std::int32_t nearer_count = 0, farther_count = 0;
    for (std::int32_t k = 0; k < in_block; ++k) {
      const bool is_near = near_part[k] <= 0.0F;
      nearer[nearer_count] = first + k;
      nearer_count += is_near ? 1 : 0;
      farther[farther_count] = first + k;
      farther_count += !is_near && part[k] <= 0.0F ? 1 : 0;
    }
    const auto look_at = [&](std::int32_t body) {
      const Vec3 r = nearest_image(bodies_[body].center - center);
      return near.add(body, r) && (one_image_each || add_farther_images(body, r, reach, near));
    };
    for (std::int32_t k = 0; k < nearer_count; ++k) {
      if (!look_at(nearer[k])) return false;
    }
    for (std::int32_t k = 0; k < farther_count; ++k) {
      if (!look_at(farther[k])) return false;
    }
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

PlacedBodies::GridPoint PlacedBodies::grid_point(const Vec3& p) const {
  const auto coordinate = [&](std::size_t axis) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(p[axis] * per_grid_step_[axis]));
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

bool PlacedBodies::search_grid(const Candidate& candidate, const Vec3& center,
                               NearPairs& near) const {
  // In large packings most of the time goes into waiting for memory, so bodies are asked for some
  // at a time before the first of them is looked at.
  constexpr int capacity = 6;
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
  const auto visit = [&](std::int32_t id, const HierarchicalGrid::Image& image) {
    const auto* bytes = reinterpret_cast<const char*>(&bodies_[id]);
    for (std::size_t line = 0; line < sizeof(Placed); line += 64) __builtin_prefetch(bytes + line);
    hits[static_cast<std::size_t>(count++)] = {id, image_shift(cell_, image)};
    return count < capacity || look_at_hits();
  };
  return grid_.query(center, candidate.half_extents, min_gap_, visit) && look_at_hits();
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
