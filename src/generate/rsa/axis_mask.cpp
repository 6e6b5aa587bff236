#include "generate/rsa/axis_mask.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/core/memory_hints.hpp"

namespace packstone::rsa {
namespace {

// Rounding of fractions of the cell, summed up along an axis of so many steps in a cell of so many
// voxels, stays below this part of a voxel.
constexpr double kMargin = 0.01;
constexpr std::int64_t kMostSteps = 8192;
constexpr std::int64_t kMostVoxelsAlong = 4096;
constexpr std::int64_t kLooksAtOnce = 16;

// Part of the axis about whose points the body holds a ball.
struct Core {
  double half;    // Of its length [L].
  double radius;  // Of the ball [L].
};
Core core_of(const Outline& body) {
  const double half = body.half_length - (body.ends == Outline::Ends::flat ? body.radius : 0.0);
  if (body.ends == Outline::Ends::loose || half <= 0.0) return {0.0, body.in_radius};
  return {half, body.radius};
}

}  // namespace

// All points within a radius of an axis, but for what is beyond its ends.
struct AxisMask::Tube {
  Vec3 center;
  Vec3 axis;
  double half;    // Of its length [L].
  double radius;  // [L]

  [[nodiscard]] Stretch whole() const { return {-half, half}; }

  // What of the axis is within the radius of x[a] = from, from the center.
  [[nodiscard]] Stretch beside(std::size_t a, double from) const {
    if (std::abs(axis[a]) < kAcross) return whole();
    const double one = (from - radius) / axis[a], other = (from + radius) / axis[a];
    return {std::max(-half, std::min(one, other)), std::min(half, std::max(one, other))};
  }

  // Along x, at y and z, all from the center; nothing where first > last. With u the axis and
  // s = y u_y + z u_z,
  //     (1 - u_x^2) x^2 - 2 u_x s x + y^2 + z^2 - s^2 <= radius^2  and  |u_x x + s| <= half.
  [[nodiscard]] Stretch row(double y, double z) const {
    constexpr Stretch kNothing{1.0, 0.0};
    const double ux = axis.x, across_sq = 1.0 - ux * ux;
    const double s = y * axis.y + z * axis.z, rest = y * y + z * z - s * s - radius * radius;
    Stretch x{-half - radius, half + radius};
    if (across_sq < kAcross * kAcross) {
      if (rest > 0.0) return kNothing;
    } else {
      const double root_sq = ux * ux * s * s - across_sq * rest;
      if (root_sq < 0.0) return kNothing;
      x = {(ux * s - std::sqrt(root_sq)) / across_sq, (ux * s + std::sqrt(root_sq)) / across_sq};
    }
    if (std::abs(ux) < kAcross) return std::abs(s) > half ? kNothing : x;
    const double end = std::copysign(half, ux);
    return {std::max(x.first, (-s - end) / ux), std::min(x.last, (-s + end) / ux)};
  }

 private:
  static constexpr double kAcross = 1e-6;
};

AxisMask::AxisMask(const Cell& cell, double min_gap, double thinnest) : cell_(cell) {
  // As measured: finer voxels close more, and take longer to close.
  constexpr double kVoxelsPerReach = 2.5;
  constexpr double kMostVoxels = 0x1p30;
  const double least_reach = 2.0 * thinnest + min_gap;
  const double edge = least_reach / kVoxelsPerReach;
  double voxels = 1.0, diagonal_sq = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double count = std::ceil(cell.size[a] / edge);
    if (count > static_cast<double>(kMostVoxelsAlong)) return;
    count_[a] = static_cast<std::int64_t>(count);
    blocks_[a] = static_cast<std::uint32_t>(count_[a] + 7) / 8;
    voxels *= 8.0 * blocks_[a];
    diagonal_sq += std::pow(cell.size[a] / count, 2);
  }
  if (voxels > kMostVoxels) return;
  reach_ = thinnest + min_gap - 0.5 * std::sqrt(diagonal_sq) - kMargin * edge;
  step_ = 2.0 * edge;
  const auto words = static_cast<std::size_t>(voxels) / 64;
  closed_.reserve(words);
  prefer_large_pages(closed_.data(), words * sizeof(std::uint64_t));
  closed_.assign(words, 0);
}

void AxisMask::clear() { std::fill(closed_.begin(), closed_.end(), 0); }

AxisMask::Fraction AxisMask::fraction_of(const Vec3& x) const {
  Fraction fraction{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double part = x[a] / cell_.size[a];
    fraction[a] =
        static_cast<std::uint32_t>(static_cast<std::uint64_t>((part - std::floor(part)) * 0x1p32));
  }
  return fraction;
}

// Voxel centers x with lo <= x <= hi along an axis, numbered without wrapping; inside walls.
AxisMask::Range AxisMask::centers_between(std::size_t a, double lo, double hi) const {
  const double per_edge = static_cast<double>(count_[a]) / cell_.size[a];
  Range r{static_cast<std::int64_t>(std::ceil(lo * per_edge - 0.5)),
          static_cast<std::int64_t>(std::floor(hi * per_edge - 0.5))};
  if (!cell_.periodic[a]) r = {std::max<std::int64_t>(r.first, 0), std::min(r.last, count_[a] - 1)};
  return r;
}

// Voxel centers beside a stretch of a tube.
AxisMask::Range AxisMask::range_of(std::size_t a, const Tube& tube, const Stretch& along) const {
  const double one = along.first * tube.axis[a], other = along.last * tube.axis[a];
  return centers_between(a, tube.center[a] + std::min(one, other) - tube.radius,
                         tube.center[a] + std::max(one, other) + tube.radius);
}

void AxisMask::close_row(std::int64_t ky, std::int64_t kz, const Range& xs) {
  const auto wrap = [&](std::size_t a, std::int64_t k) {
    const std::int64_t m = k % count_[a];
    return static_cast<std::uint32_t>(m < 0 ? m + count_[a] : m);
  };
  const std::uint32_t y = wrap(1, ky), z = wrap(2, kz);
  std::uint32_t x = wrap(0, xs.first);
  for (std::int64_t k = xs.first; k <= xs.last; ++k) {
    const std::size_t v = voxel(x, y, z);
    closed_[v / 64] |= std::uint64_t{1} << (v % 64);
    if (++x == static_cast<std::uint32_t>(count_[0])) x = 0;
  }
}

void AxisMask::close(const Tube& tube) {
  const Range layers = range_of(2, tube, tube.whole());
  for (std::int64_t kz = layers.first; kz <= layers.last; ++kz) {
    const double z = center_of(2, kz) - tube.center.z;
    const Range rows = range_of(1, tube, tube.beside(2, z));
    for (std::int64_t ky = rows.first; ky <= rows.last; ++ky) {
      const Stretch row = tube.row(center_of(1, ky) - tube.center.y, z);
      close_row(ky, kz, centers_between(0, tube.center.x + row.first, tube.center.x + row.last));
    }
  }
}

void AxisMask::add(const Outline& body, const Vec3& center) {
  const Core core = core_of(body);
  const double shortest = std::min({cell_.size.x, cell_.size.y, cell_.size.z});
  const double radius = std::min(reach_ + core.radius, 0.5 * shortest);
  if (empty() || !(radius > 0.0)) return;
  close({center, body.axis, core.half, radius});
}

bool AxisMask::blocks(const Outline& body, const Vec3& center) const {
  if (empty()) return false;
  const double half = core_of(body).half;
  const auto steps = std::min(kMostSteps, static_cast<std::int64_t>(2.0 * half / step_));
  Fraction at = fraction_of(center - half * body.axis);
  const Fraction step = fraction_of(step_ * body.axis);
  const auto index = [&](std::size_t a) {
    const std::uint64_t scaled = std::uint64_t{at[a]} * static_cast<std::uint64_t>(count_[a]);
    return static_cast<std::uint32_t>(scaled >> 32U);
  };
  // Some at a time, so that they wait for the memory together.
  std::array<std::size_t, kLooksAtOnce> voxels;
  for (std::int64_t left = steps + 1; left > 0; left -= kLooksAtOnce) {
    const std::int64_t count = std::min(left, kLooksAtOnce);
    for (std::int64_t k = 0; k < count; ++k) {
      const std::size_t v = voxel(index(0), index(1), index(2));
      voxels[static_cast<std::size_t>(k)] = v;
      __builtin_prefetch(&closed_[v / 64]);
      for (std::size_t a = 0; a < 3; ++a) at[a] += step[a];
    }
    for (std::int64_t k = 0; k < count; ++k) {
      const std::size_t v = voxels[static_cast<std::size_t>(k)];
      if ((closed_[v / 64] >> (v % 64) & 1U) != 0) return true;
    }
  }
  return false;
}

}  // namespace packstone::rsa
