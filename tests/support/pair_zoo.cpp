#include "support/pair_zoo.hpp"

#include <cmath>
#include <numbers>

#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone::zoo {
namespace {

// The same body with its axes turned to the frame `q`.
Body posed(const Body& body, const Quaternion& q) {
  const Mat3 frame = to_matrix(q);
  return std::visit(
      Overloaded{[](const Sphere& b) -> Body { return b; },
                 [&](const Ellipsoid& b) -> Body {
                   return Ellipsoid{b.semi_axes, q};
                 },
                 [&](const Cylinder& b) -> Body {
                   return Cylinder{b.radius, b.half_length, normalized(frame.col_z)};
                 },
                 [&](const Spherocylinder& b) -> Body {
                   return Spherocylinder{b.radius, b.half_length, normalized(frame.col_z)};
                 },
                 [](const Disk& b) -> Body { return b; },
                 [&](const Ellipse& b) -> Body {
                   return Ellipse{b.semi_axes, 2.0 * std::atan2(q.z, q.w)};
                 }},
      body);
}

// A turn by a right angle about one of the axes, or none.
Quaternion right_angle(int axis) {
  const double s = std::numbers::sqrt2 / 2;
  if (axis == 0) return {s, s, 0, 0};
  if (axis == 1) return {s, 0, s, 0};
  return axis == 2 ? Quaternion{s, 0, 0, s} : Quaternion{};
}

}  // namespace

std::string_view name(PairClass pair_class) {
  constexpr std::string_view names[] = {
      "generic",    "near",  "parallel", "coaxial",   "coplanar",  "orthogonal", "concentric",
      "near-paral", "sizes", "far",      "tangent-2", "tangent-6", "tangent-10", "tangent-13"};
  return names[static_cast<int>(pair_class)];
}

double Zoo::uniform(double low, double high) {
  return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
}

double Zoo::log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

Vec3 Zoo::direction(int dimension) {
  const double phi = uniform(0, 2 * std::numbers::pi);
  if (dimension == 2) return {std::cos(phi), std::sin(phi), 0};
  const double z = uniform(-1, 1);
  const double rho = std::sqrt(1 - z * z);
  return {rho * std::cos(phi), rho * std::sin(phi), z};
}

Quaternion Zoo::rotation() {
  for (;;) {
    const Quaternion q{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    if (norm(q) < 1 && norm(q) > 0.1) return normalized(q);
  }
}

Body Zoo::body(ShapeKind kind, double size) {
  const double aspect = log_uniform(0.02, 100);
  const double rod = size / std::cbrt(aspect);
  Body body;
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{size};
    case ShapeKind::disk:
      return Disk{size};
    case ShapeKind::cylinder:
      body = Cylinder{rod, rod * aspect};
      break;
    case ShapeKind::spherocylinder:
      body = Spherocylinder{rod, rod * aspect};
      break;
    case ShapeKind::ellipse: {
      body = Ellipse{{size * std::sqrt(aspect), size / std::sqrt(aspect)}};
      return posed(body, from_axis_angle({0, 0, 1}, uniform(-3, 3)));
    }
    case ShapeKind::ellipsoid: {
      const double other = uniform(0, 1) < 0.3 ? 1.0 : std::pow(aspect, uniform(0, 1));
      Vec3 axes{rod * aspect, rod * other, rod};
      if (uniform(0, 1) < 0.5) std::swap(axes.x, axes.z);
      body = Ellipsoid{axes};
      break;
    }
  }
  return posed(body, rotation());
}

Pair Zoo::pose(ShapeKind kind_a, ShapeKind kind_b, PairClass pair_class) {
  const int dim = dimension(kind_a);
  const bool tiny = pair_class == PairClass::sizes;
  Pair pair{body(kind_a, tiny ? 1000.0 : 1.0), body(kind_b, log_uniform(0.3, 3)), {}};
  if (tiny && uniform(0, 1) < 0.5) {
    pair = {body(kind_a, 1.0), body(kind_b, 1000.0), {}};
  }
  const Quaternion frame = dim == 2 ? from_axis_angle({0, 0, 1}, uniform(-3, 3)) : rotation();
  const double reach = size_of(pair);
  const double distance = uniform(0, 1.1) * reach;
  pair.r = distance * direction(dim);
  const auto pick = [&](int count) { return static_cast<int>(uniform(0, count)); };
  switch (pair_class) {
    case PairClass::parallel:
    case PairClass::coaxial: {
      pair.a = posed(pair.a, frame);
      pair.b = posed(pair.b, frame);
      const Mat3 axes = to_matrix(frame);
      if (pair_class == PairClass::coaxial) {
        const int axis = dim == 2 ? pick(2) : pick(4);
        pair.r = distance * (axis == 0 ? axes.col_x : axis == 1 ? axes.col_y : axes.col_z);
      }
      break;
    }
    case PairClass::coplanar: {
      if (dim == 2) break;
      const Vec3 normal = to_matrix(frame).col_x;
      pair.a = posed(pair.a, from_axis_angle(normal, uniform(0, 3)) * frame);
      pair.b = posed(pair.b, from_axis_angle(normal, uniform(0, 3)) * frame);
      pair.r = distance * rotate(from_axis_angle(normal, uniform(0, 6)), to_matrix(frame).col_y);
      break;
    }
    case PairClass::orthogonal: {
      const Mat3 axes = to_matrix(frame);
      const int axis = dim == 2 ? pick(2) : pick(3);
      pair.a = posed(pair.a, frame);
      pair.b = posed(pair.b, frame * right_angle(dim == 2 ? 2 : pick(3)));
      pair.r = distance * (axis == 0 ? axes.col_x : axis == 1 ? axes.col_y : axes.col_z);
      break;
    }
    case PairClass::concentric:
      pair.r = uniform(0, 1) < 0.3 ? Vec3{} : 1e-9 * pair.r;
      if (uniform(0, 1) < 0.3) pair.a = posed(pair.a, frame), pair.b = posed(pair.b, frame);
      break;
    case PairClass::nearly_parallel: {
      const Vec3 axis = dim == 2 ? Vec3{0, 0, 1} : direction(3);
      pair.a = posed(pair.a, frame);
      pair.b = posed(pair.b, from_axis_angle(axis, log_uniform(1e-14, 0.1)) * frame);
      break;
    }
    case PairClass::far:
      pair.r = uniform(1, 20) * reach * normalized(pair.r);
      break;
    default:
      break;
  }
  return pair;
}

Pair Zoo::pair(ShapeKind kind_a, ShapeKind kind_b, PairClass pair_class) {
  const bool tangent = pair_class >= PairClass::tangent_2;
  const bool near = pair_class == PairClass::near || pair_class == PairClass::sizes;
  const auto base = tangent ? static_cast<PairClass>(static_cast<int>(uniform(0, 9))) : pair_class;
  Pair pair = pose(kind_a, kind_b, base);
  if (!tangent && !near) return pair;
  if (norm_sq(pair.r) == 0.0) pair.r = direction(dimension(kind_a));
  constexpr double widths[] = {1e-2, 1e-6, 1e-10, 1e-13};
  const double width =
      tangent ? widths[static_cast<int>(pair_class) - static_cast<int>(PairClass::tangent_2)] : 0.2;
  const ContactScale scale = contact_scale(pair.a, pair.b, pair.r);
  pair.r = ((1.0 + width * uniform(-1, 1)) / scale.lower) * pair.r;
  return pair;
}

std::vector<std::pair<ShapeKind, ShapeKind>> kinds_of_pairs() {
  std::vector<std::pair<ShapeKind, ShapeKind>> pairs;
  for (int a = 0; a < 6; ++a) {
    for (int b = a; b < 6; ++b) {
      const auto kind_a = static_cast<ShapeKind>(a), kind_b = static_cast<ShapeKind>(b);
      if (dimension(kind_a) == dimension(kind_b)) pairs.emplace_back(kind_a, kind_b);
    }
  }
  return pairs;
}

double size_of(const Pair& pair) { return circum_radius(pair.a) + circum_radius(pair.b); }

Pair moved_apart(Pair pair, double gap_wanted) {
  const Gap g = gap(pair.a, pair.b, pair.r);
  if (g.value < gap_wanted) pair.r += (gap_wanted - g.value) * g.normal;
  return pair;
}

}  // namespace packstone::zoo
