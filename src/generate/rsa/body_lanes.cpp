#include "generate/rsa/body_lanes.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/core/error.hpp"

// Vectors pass between functions of this file alone, all of them inlined: no binary interface.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace packstone::rsa {
namespace {

// Lengths that decide on an overlap are shortened by this part of the longest edge of the cell or
// body: above what the dozen operations below lose, 2^-24 each.
constexpr double kMargin = 3e-6;

constexpr float kNever = 1e30F;

template <class Flags>
[[gnu::always_inline]] inline bool any(const Flags& flags) {
  using Halves = std::int64_t __attribute__((vector_size(16)));
  const auto low = __builtin_shufflevector(flags, flags, 0, 1, 2, 3);
  const auto high = __builtin_shufflevector(flags, flags, 4, 5, 6, 7);
  const auto either = (Halves)(low | high);
  return (either[0] | either[1]) != 0;
}

template <class Floats>
[[gnu::always_inline]] inline Floats within(const Floats& v, const Floats& most) {
  const Floats low = v > -most ? v : -most;
  return low < most ? low : most;
}

template <class Floats>
[[gnu::always_inline]] inline Floats magnitude(const Floats& v) {
  return v < Floats{} ? -v : v;
}

}  // namespace

BodyLanes::BodyLanes(const Cell& cell)
    : wide_(__builtin_cpu_supports("avx2") != 0),
      margin_(kMargin * std::max({cell.size.x, cell.size.y, cell.size.z})) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    // 2^32 steps to a period; along walls a quarter of them, so that no difference wraps around.
    step_[axis] = cell.size[axis] * (cell.periodic[axis] ? 0x1p-32 : 0x1p-30);
    per_step_[axis] = 1.0 / step_[axis];
  }
}

void BodyLanes::clear() {
  groups_.clear();
  count_ = 0;
  has_rods_ = false;
}

inline std::array<std::uint32_t, 3> BodyLanes::coarse(const Vec3& p) const {
  const auto wrapping = [](double steps) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(steps));
  };
  return {wrapping(p.x * per_step_[0]), wrapping(p.y * per_step_[1]), wrapping(p.z * per_step_[2])};
}

void BodyLanes::add(const Outline& outline, const Vec3& center) {
  PACKSTONE_ASSERT(count_ < kMost);
  const std::size_t first = static_cast<std::size_t>(count_++) % kLanes;
  if (first == 0) groups_.emplace_back();
  Group& group = groups_.back();
  const auto [x, y, z] = coarse(center);
  const bool flat = outline.ends == Outline::Ends::flat;
  const bool loose = outline.ends == Outline::Ends::loose;
  const double margin = margin_ + kMargin * outline.half_length;
  const double radius = std::max(0.0, (loose ? outline.in_radius : outline.radius) - margin);
  const double half = loose ? 0.0 : outline.half_length;
  has_rods_ |= half > 0.0;
  for (std::size_t lane = first; lane < kLanes; ++lane) {
    group.x[lane] = x;
    group.y[lane] = y;
    group.z[lane] = z;
    group.ux[lane] = static_cast<float>(outline.axis.x);
    group.uy[lane] = static_cast<float>(outline.axis.y);
    group.uz[lane] = static_cast<float>(outline.axis.z);
    group.half[lane] = static_cast<float>(half - (flat ? margin : 0.0));
    group.flat_radius[lane] = static_cast<float>(flat ? radius : 0.0);
    group.round_radius[lane] = static_cast<float>(flat ? 0.0 : radius);
    group.flat_half[lane] = flat ? static_cast<float>(half - margin) : kNever;
    group.core[lane] = static_cast<float>(std::max(0.0, outline.in_radius - margin));
    group.circum[lane] = static_cast<float>(outline.circum_radius + margin);
  }
  backwards_ = group.core[0] > groups_.front().core[0];
}

[[gnu::always_inline]] inline bool BodyLanes::ball_overlaps_in(double radius, double min_gap,
                                                               const Vec3& center,
                                                               View& view) const {
  const auto [cx, cy, cz] = coarse(center);
  const auto sx = static_cast<float>(step_[0]), sy = static_cast<float>(step_[1]),
             sz = static_cast<float>(step_[2]);
  const auto ball = static_cast<float>(std::max(0.0, radius + min_gap - margin_));
  const std::size_t count = groups_.size();
  // Most trials end with a body whose inscribed ball covers the center, so this alone is looked for
  // first, from the end where the stouter bodies stand, two groups at a time.
  Signed covered{};
  for (std::size_t step = 0; step < count; ++step) {
    const std::size_t k = backwards_ ? count - 1 - step : step;
    const Group& b = groups_[k];
    // Unsigned differences wrap around as the cell does: these are the nearest images.
    const Floats x = sx * __builtin_convertvector((Signed)(cx - b.x), Floats);
    const Floats y = sy * __builtin_convertvector((Signed)(cy - b.y), Floats);
    const Floats z = sz * __builtin_convertvector((Signed)(cz - b.z), Floats);
    view.x[k] = x;
    view.y[k] = y;
    view.z[k] = z;
    const Floats range = ball + b.core;
    covered |= x * x + y * y + z * z < range * range;
    if (((step & 1) != 0 || step + 1 == count) && any(covered)) return true;
  }
  if (!has_rods_) return false;
  for (std::size_t k = 0; k < count; ++k) {
    Signed meets;
    ball_meets(ball, groups_[k], view, k, meets);
    if (any(meets)) return true;
  }
  return false;
}

[[gnu::always_inline]] inline void BodyLanes::ball_meets(float ball, const Group& b,
                                                         const View& view, std::size_t k,
                                                         Signed& meets) {
  const Floats zero{};
  const Floats &x = view.x[k], &y = view.y[k], &z = view.z[k];
  const Floats along = x * b.ux + y * b.uy + z * b.uz;
  const Floats ex = x - along * b.ux, ey = y - along * b.uy, ez = z - along * b.uz;
  const Floats side_sq = ex * ex + ey * ey + ez * ez;
  const Floats beyond = magnitude(along) - b.half;
  const Floats past_end = beyond > zero ? beyond : zero;
  const Floats range = ball + b.round_radius;
  const Floats wide = range + b.flat_radius;
  // Beside the body, at a round end, above a flat one.
  const Signed beside = (side_sq < wide * wide) & (beyond <= zero);
  const Signed round = side_sq + past_end * past_end < range * range;
  const Signed above = (side_sq < b.flat_radius * b.flat_radius) & (past_end < range);
  meets = beside | round | above;
}

// The rod on trial, the same for all lanes; lengths that decide are shortened by the margin.
struct BodyLanes::Rod {
  float ux, uy, uz;
  float half, flat_half, radius, slack;
  bool flat;
};

// Where the segments of the rod, a, and of the bodies of a group, b, are nearest: at s along a and
// t along b, with e from the one to the other. Nearly so for nearly parallel segments; whatever is
// claimed holds for any two points.
struct BodyLanes::Feet {
  Floats s, t, ex, ey, ez;
};

[[gnu::always_inline]] inline BodyLanes::Feet BodyLanes::feet(const Rod& a, const Group& b,
                                                              const View& view, std::size_t k) {
  const Floats x = -view.x[k], y = -view.y[k], z = -view.z[k];
  const Floats cosine = a.ux * b.ux + a.uy * b.uy + a.uz * b.uz;
  const Floats det = 1.0F - cosine * cosine;
  const Floats along_a = a.ux * x + a.uy * y + a.uz * z;
  const Floats along_b = b.ux * x + b.uy * y + b.uz * z;
  const Floats free = (along_a - cosine * along_b) / det;
  const Floats half = a.half + Floats{};
  const Floats first = within(det > 1e-3F ? free : Floats{}, half);
  const Floats t = within(cosine * first - along_b, b.half);
  const Floats s = within(along_a + cosine * t, half);
  return {s, t, x + t * b.ux - s * a.ux, y + t * b.uy - s * a.uy, z + t * b.uz - s * a.uz};
}

// A point between the feet that both bodies hold proves an overlap.
[[gnu::always_inline]] inline void BodyLanes::sides_meet(const Rod& a, const Group& b,
                                                         const Feet& f, Signed& meet) {
  const Floats radius_b = b.flat_radius + b.round_radius;
  const Floats range = a.radius + radius_b + 2.0F * a.slack;
  const Floats share = (a.radius + a.slack) / range;
  const Floats height_a = f.s + share * (f.ex * a.ux + f.ey * a.uy + f.ez * a.uz);
  const Floats height_b = f.t - (1.0F - share) * (f.ex * b.ux + f.ey * b.uy + f.ez * b.uz);
  meet = (f.ex * f.ex + f.ey * f.ey + f.ez * f.ez < range * range) &
         (magnitude(height_a) <= a.flat_half) & (magnitude(height_b) <= b.flat_half) &
         (radius_b > Floats{});
}

// So does the point of one body nearest to the foot in the other, where the other holds it: this
// sees flat ends that meet something.
[[gnu::always_inline]] inline void BodyLanes::ends_meet(const Rod& a, const Group& b, const Feet& f,
                                                        Signed& meet) {
  const Floats zero{};
  const Floats radius_b = b.flat_radius + b.round_radius;
  const Floats ea = f.ex * a.ux + f.ey * a.uy + f.ez * a.uz;
  const Floats eb = f.ex * b.ux + f.ey * b.uy + f.ez * b.uz;
  // How much of the way across, of length squared `across`, stays within `radius`: at most the root
  // of q = radius^2 / across, which is no less than 2 q / (1 + q).
  const auto part = [](const Floats& radius, const Floats& across) __attribute__((always_inline)) {
    const Floats sq = radius * radius;
    return sq >= across ? Floats{} + 1.0F : 2.0F * sq / (sq + across);
  };
  // The way across a, and from the foot in b to the point of a: up a, and back across it.
  const Floats px = f.ex - ea * a.ux, py = f.ey - ea * a.uy, pz = f.ez - ea * a.uz;
  const Floats up_a = within(f.s + ea, zero + (a.flat ? a.flat_half : a.half)) - f.s - ea;
  const Floats back_a = part(a.radius + zero, px * px + py * py + pz * pz) - 1.0F;
  const Floats wx = up_a * a.ux + back_a * px, wy = up_a * a.uy + back_a * py,
               wz = up_a * a.uz + back_a * pz;
  const Floats along_b = wx * b.ux + wy * b.uy + wz * b.uz;
  const Floats off_b = b.flat_radius > zero ? along_b : zero;
  const Floats nx = wx - off_b * b.ux, ny = wy - off_b * b.uy, nz = wz - off_b * b.uz;
  const Signed in_b = (magnitude(f.t + along_b) <= b.flat_half) &
                      (nx * nx + ny * ny + nz * nz < radius_b * radius_b);
  // The same the other way round, where e points back.
  const Floats qx = eb * b.ux - f.ex, qy = eb * b.uy - f.ey, qz = eb * b.uz - f.ez;
  const Floats most_b = b.flat_half < b.half ? b.flat_half : b.half;
  const Floats up_b = within(f.t - eb, most_b) - f.t + eb;
  const Floats back_b = part(radius_b, qx * qx + qy * qy + qz * qz) - 1.0F;
  const Floats vx = up_b * b.ux + back_b * qx, vy = up_b * b.uy + back_b * qy,
               vz = up_b * b.uz + back_b * qz;
  const Floats along_a = vx * a.ux + vy * a.uy + vz * a.uz;
  const Floats off_a = a.flat ? along_a : zero;
  const Floats mx = vx - off_a * a.ux, my = vy - off_a * a.uy, mz = vz - off_a * a.uz;
  const Signed in_a = (magnitude(f.s + along_a) <= a.flat_half) &
                      (mx * mx + my * my + mz * mz < a.radius * a.radius);
  meet = (in_a | in_b) & (radius_b > zero);
}

BodyLanes::Rod BodyLanes::rod_of(const Outline& outline, double min_gap) const {
  const double margin = margin_ + kMargin * outline.half_length;
  const bool flat = outline.ends == Outline::Ends::flat;
  return {static_cast<float>(outline.axis.x),
          static_cast<float>(outline.axis.y),
          static_cast<float>(outline.axis.z),
          static_cast<float>(outline.half_length - (flat ? margin : 0.0)),
          flat ? static_cast<float>(outline.half_length - margin) : kNever,
          static_cast<float>(outline.radius - margin),
          static_cast<float>(0.5 * min_gap),
          flat};
}

[[gnu::always_inline]] inline bool BodyLanes::rod_overlaps_in(const Outline& outline,
                                                              double min_gap,
                                                              const View& view) const {
  const Rod rod = rod_of(outline, min_gap);
  if (rod.radius <= 0.0F) return false;
  const std::size_t count = groups_.size();
  std::array<Feet, kMostGroups> kept;
  Signed meet;
  for (std::size_t k = 0; k < count; ++k) {
    kept[k] = feet(rod, groups_[k], view, k);
    sides_meet(rod, groups_[k], kept[k], meet);
    if (any(meet)) return true;
  }
  for (std::size_t k = 0; k < count; ++k) {
    ends_meet(rod, groups_[k], kept[k], meet);
    if (any(meet)) return true;
  }
  return false;
}

[[gnu::always_inline]] inline std::int32_t BodyLanes::list_near_in(
    double reach, const View& view, std::array<std::int32_t, kMost>& bodies) const {
  // The part of the reach, squared, that counts as near [-].
  constexpr float near_part = 0.25F;
  const auto most = static_cast<float>(reach + margin_);
  std::array<std::int32_t, kMost + 1> farther;
  std::int32_t near_count = 0, far_count = 0;
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    const Group& b = groups_[k];
    const Floats distance_sq =
        view.x[k] * view.x[k] + view.y[k] * view.y[k] + view.z[k] * view.z[k];
    const Floats far = b.circum + most;
    const Signed within = distance_sq <= far * far;
    if (!any(within)) continue;
    const Signed is_near = distance_sq <= near_part * far * far;
    const auto first = static_cast<std::int32_t>(k * kLanes);
    const auto lanes = static_cast<std::size_t>(std::min<std::int32_t>(kLanes, count_ - first));
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::int32_t body = first + static_cast<std::int32_t>(lane);
      if (is_near[lane] != 0) {
        bodies[static_cast<std::size_t>(near_count++)] = body;
      } else if (within[lane] != 0) {
        farther[static_cast<std::size_t>(far_count++)] = body;
      }
    }
  }
  std::copy_n(farther.begin(), far_count, bodies.begin() + near_count);
  return near_count + far_count;
}

// The same operations, one by one, whichever registers hold the lanes: equal bits.
__attribute__((target("avx2"))) bool BodyLanes::ball_overlaps_wide(double radius, double min_gap,
                                                                   const Vec3& center,
                                                                   View& view) const {
  return ball_overlaps_in(radius, min_gap, center, view);
}

__attribute__((target("avx2"))) bool BodyLanes::rod_overlaps_wide(const Outline& rod,
                                                                  double min_gap,
                                                                  const View& view) const {
  return rod_overlaps_in(rod, min_gap, view);
}

bool BodyLanes::ball_overlaps(double radius, double min_gap, const Vec3& center, View& view) const {
  return wide_ ? ball_overlaps_wide(radius, min_gap, center, view)
               : ball_overlaps_in(radius, min_gap, center, view);
}

bool BodyLanes::rod_overlaps(const Outline& rod, double min_gap, const View& view) const {
  return wide_ ? rod_overlaps_wide(rod, min_gap, view) : rod_overlaps_in(rod, min_gap, view);
}

__attribute__((target("avx2"))) std::int32_t BodyLanes::list_near_wide(
    double reach, const View& view, std::array<std::int32_t, kMost>& bodies) const {
  return list_near_in(reach, view, bodies);
}

std::int32_t BodyLanes::list_near(double reach, const View& view,
                                  std::array<std::int32_t, kMost>& bodies) const {
  return wide_ ? list_near_wide(reach, view, bodies) : list_near_in(reach, view, bodies);
}

}  // namespace packstone::rsa
