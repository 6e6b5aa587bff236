#include "io/inclusion_record.hpp"

#include "packstone/core/overloaded.hpp"

namespace packstone {

std::vector<std::string> shape_words() {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < kShapeKinds; ++i) {
    words.emplace_back(name(static_cast<ShapeKind>(i)));
  }
  return words;
}

std::string_view name(NumberField field) noexcept {
  constexpr std::string_view names[] = {"center", "radius",     "half_length", "axis",
                                        "axes",   "quaternion", "angle"};
  return names[static_cast<std::size_t>(field)];
}

int arity(NumberField field, ShapeKind shape) noexcept {
  // Rows as ShapeKind, columns as NumberField.
  constexpr int table[kShapeKinds][kNumberFields] = {
      {3, 1, 0, 0, 0, 0, 0},  // sphere
      {3, 0, 0, 0, 3, 4, 0},  // ellipsoid
      {3, 1, 1, 3, 0, 0, 0},  // cylinder
      {3, 1, 1, 3, 0, 0, 0},  // spherocylinder
      {2, 1, 0, 0, 0, 0, 0},  // disk
      {2, 0, 0, 0, 2, 0, 1},  // ellipse
  };
  return table[static_cast<std::size_t>(shape)][static_cast<std::size_t>(field)];
}

Vec3 InclusionRecord::center(int dimension) const {
  const auto& c = (*this)[NumberField::center];
  return {c[0], c[1], dimension == 2 ? 0.0 : c[2]};
}

Body InclusionRecord::body(ShapeKind shape) const {
  const double radius = (*this)[NumberField::radius][0];
  const double half_length = (*this)[NumberField::half_length][0];
  const auto& u = (*this)[NumberField::axis];
  const auto& a = (*this)[NumberField::axes];
  const auto& q = (*this)[NumberField::quaternion];
  switch (shape) {
    case ShapeKind::sphere:
      return Sphere{radius};
    case ShapeKind::ellipsoid:
      return Ellipsoid{{a[0], a[1], a[2]}, {q[0], q[1], q[2], q[3]}};
    case ShapeKind::cylinder:
      return Cylinder{radius, half_length, {u[0], u[1], u[2]}};
    case ShapeKind::spherocylinder:
      return Spherocylinder{radius, half_length, {u[0], u[1], u[2]}};
    case ShapeKind::disk:
      return Disk{radius};
    case ShapeKind::ellipse:
      break;
  }
  return Ellipse{{a[0], a[1]}, (*this)[NumberField::angle][0]};
}

void InclusionRecord::set(const Inclusion& inclusion) {
  const auto put = [this](NumberField field, std::array<double, kMaxNumbers> values) {
    (*this)[field] = values;
  };
  const auto put_rod = [&](const auto& b) {
    put(NumberField::radius, {b.radius});
    put(NumberField::half_length, {b.half_length});
    put(NumberField::axis, {b.axis.x, b.axis.y, b.axis.z});
  };
  const Vec3& c = inclusion.center;
  put(NumberField::center, {c.x, c.y, c.z});
  std::visit(Overloaded{[&](const Sphere& b) { put(NumberField::radius, {b.radius}); },
                        [&](const Ellipsoid& b) {
                          const Quaternion& q = b.orientation;
                          put(NumberField::axes, {b.semi_axes.x, b.semi_axes.y, b.semi_axes.z});
                          put(NumberField::quaternion, {q.w, q.x, q.y, q.z});
                        },
                        [&](const Cylinder& b) { put_rod(b); },
                        [&](const Spherocylinder& b) { put_rod(b); },
                        [&](const Disk& b) { put(NumberField::radius, {b.radius}); },
                        [&](const Ellipse& b) {
                          put(NumberField::axes, {b.semi_axes.x, b.semi_axes.y});
                          put(NumberField::angle, {b.angle});
                        }},
             inclusion.body);
}

}  // namespace packstone
