#include "generate/advancing_layer/linear_program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace packstone::advancing_layer {
namespace {

// Below it two sides count as parallel.
constexpr double kParallel = 1e-13;
// By how much of the box a side may be broken.
constexpr double kRounding = 1e-14;

constexpr std::array<Vec2, 4> kOutward{Vec2{1, 0}, Vec2{-1, 0}, Vec2{0, 1}, Vec2{0, -1}};

// a . x <= b in the plane.
struct Side {
  Vec2 a;
  double b;
};

// The part of a line p + s t that is left.
struct Interval {
  double low;
  double high;

  void cut(const Side& side, const Vec2& p, const Vec2& t) {
    const double along = dot(side.a, t);
    const double left = side.b - dot(side.a, p);
    if (along > kParallel) {
      high = std::min(high, left / along);
    } else if (along < -kParallel) {
      low = std::max(low, left / along);
    }
  }
};

// The x of least c . x in all sides and |x_k| <= most; nothing where there is none.
std::optional<Vec2> least(std::span<const Side> sides, const Vec2& c, double most) {
  const auto corner = [&](double slope) { return slope > 0.0 ? -most : slope < 0.0 ? most : 0.0; };
  Vec2 x{corner(c.x), corner(c.y)};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& broken = sides[i];
    if (dot(broken.a, x) <= broken.b + kRounding * most) continue;
    const double length_sq = norm_sq(broken.a);
    if (!(length_sq > kParallel * kParallel)) continue;
    const Vec2 p = (broken.b / length_sq) * broken.a;
    const Vec2 t{-broken.a.y, broken.a.x};
    const double far = 4.0 * most / std::sqrt(length_sq);
    Interval left{-far, far};
    for (const Vec2& out : kOutward) left.cut({out, most}, p, t);
    for (std::size_t k = 0; k < i; ++k) left.cut(sides[k], p, t);
    if (left.low > left.high) return std::nullopt;
    const double slope = dot(c, t);
    const double level = std::clamp(0.0, left.low, left.high);
    x = p + (slope > 0.0 ? left.low : slope < 0.0 ? left.high : level) * t;
  }
  return x;
}

}  // namespace

template <>
Vec3 lowest_point<2>(std::span<const HalfSpace> sides, double most) {
  thread_local std::vector<Side> flat;
  flat.clear();
  for (const HalfSpace& side : sides) flat.push_back({flatten(side.n), side.reach});
  const auto x = least(flat, {0.0, 1.0}, most);
  return x ? lift(*x) : Vec3{};
}

template <>
Vec3 lowest_point<3>(std::span<const HalfSpace> sides, double most) {
  const std::array<HalfSpace, 6> box{{{{1, 0, 0}, most},
                                      {{-1, 0, 0}, most},
                                      {{0, 1, 0}, most},
                                      {{0, -1, 0}, most},
                                      {{0, 0, 1}, most},
                                      {{0, 0, -1}, most}}};
  thread_local std::vector<Side> flat;
  Vec3 x{0.0, 0.0, -most};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const HalfSpace& broken = sides[i];
    if (dot(broken.n, x) <= broken.reach + kRounding * most) continue;
    // On the plane of the broken side, p + s t + u v.
    const Vec3 p = broken.reach * broken.n;
    const Vec3 t = any_perpendicular(broken.n);
    const Vec3 v = cross(broken.n, t);
    flat.clear();
    const auto put = [&](const HalfSpace& side) {
      flat.push_back({{dot(side.n, t), dot(side.n, v)}, side.reach - dot(side.n, p)});
    };
    for (const HalfSpace& side : box) put(side);
    for (std::size_t k = 0; k < i; ++k) put(sides[k]);
    const auto on_plane = least(flat, {t.z, v.z}, 4.0 * most);
    if (!on_plane) return {};
    x = p + on_plane->x * t + on_plane->y * v;
  }
  return x;
}

}  // namespace packstone::advancing_layer
