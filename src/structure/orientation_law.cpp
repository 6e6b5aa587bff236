#include "packstone/structure/orientation_law.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/core/symmetric_eigen.hpp"
#include "structure/axis_laws.hpp"
#include "structure/exact_tensor.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

constexpr double kTensorTolerance = 1e-9;  // of a tensor as given
constexpr double kNoComponent = 1e-13;     // eigenvalues below are 0

// --- checks ------------------------------------------------------------------------------------

std::string vector_text(const Vec3& v) {
  return "[" + number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z) + "]";
}

void check_direction(const std::string& field, const Vec3& v) {
  const double length = norm(v);
  if (length > 0.0 && std::isfinite(length)) return;
  throw InvalidArgument(field + " = " + vector_text(v) +
                        ", allowed are finite vectors that are not zero");
}

void check_tensor(const std::string& field, const SymMat3& a) {
  for (double entry : {a.xx, a.yy, a.zz, a.yz, a.xz, a.xy}) {
    if (std::isfinite(entry)) continue;
    throw InvalidArgument(field + " has the entry " + number_text(entry) +
                          ", allowed are finite numbers");
  }
  if (std::abs(trace(a) - 1.0) > kTensorTolerance) {
    throw InvalidArgument(field + " has trace " + number_text(trace(a), 12) +
                          ", allowed is 1 within 1e-9");
  }
  const double least = symmetric_eigen(a).values.z;
  if (least < -kTensorTolerance) {
    throw InvalidArgument(field + " has the eigenvalue " + number_text(least, 12) +
                          ", allowed are eigenvalues >= 0");
  }
}

void check_in_space(const OrientationLaw& law, const std::string& what) {
  if (!std::holds_alternative<AngleOrientation>(law)) return;
  throw InvalidArgument(what +
                        ".degrees is for 2D cells; in 3D use random, axis, planar or tensor");
}

void check_in_plane(const OrientationLaw& law, const std::string& what) {
  if (const auto* aligned = std::get_if<AlignedOrientation>(&law)) {
    if (aligned->axis.z == 0.0) return;
    throw InvalidArgument(what + ".axis = " + vector_text(aligned->axis) +
                          ", allowed in 2D are axes with z = 0");
  }
  if (const auto* planar = std::get_if<PlanarOrientation>(&law)) {
    if (planar->normal.x == 0.0 && planar->normal.y == 0.0) return;
    throw InvalidArgument(what + ".planar has the normal " + vector_text(planar->normal) +
                          ", allowed in 2D is the plane of the cell, xy");
  }
  if (const auto* ordered = std::get_if<TensorOrientation>(&law)) {
    const SymMat3& a = ordered->tensor;
    const double out = std::max({std::abs(a.zz), std::abs(a.yz), std::abs(a.xz)});
    if (out <= kTensorTolerance) return;
    throw InvalidArgument(what + ".tensor has an entry " + number_text(out) +
                          " along z, allowed in 2D are tensors with zz = yz = xz = 0");
  }
}

// --- the laws ----------------------------------------------------------------------------------

// Its first number turns the body about its axis; the axis takes the numbers after it.
RandomStream axis_stream(std::uint64_t seed, std::uint64_t group, std::int64_t item) {
  RandomStream random(seed, StreamId::orientations, static_cast<std::uint64_t>(item), group);
  static_cast<void>(random.bits());
  return random;
}

// The tensor in its own frame, with what rounding left of it repaired.
struct Eigenframe {
  Vec3 values;
  Mat3 frame;
  int rank = 0;
};

Eigenframe eigenframe(const SymMat3& tensor) {
  const SymmetricEigen eigen = symmetric_eigen(tensor);
  Eigenframe result{eigen.values, eigen.vectors};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (result.values[i] < kNoComponent) result.values[i] = 0.0;
    if (result.values[i] > 0.0) ++result.rank;
    sum += result.values[i];
  }
  result.values = result.values / sum;
  return result;
}

using AxisSampler = std::function<Vec3(RandomStream&)>;

AxisSampler planar_sampler(const Vec3& normal) {
  const Vec3 n = normalized(normal);
  const Vec3 u = any_perpendicular(n);
  const Vec3 v = cross(n, u);
  return [=](RandomStream& random) {
    const double angle = 2.0 * pi * random.uniform();
    return normalized(std::cos(angle) * u + std::sin(angle) * v);
  };
}

// In the eigenframe of the tensor.
AxisSampler family_sampler(const Vec3& values, TensorFamily family) {
  if (family == TensorFamily::bingham) {
    return [law = bingham_with_moments(values)](RandomStream& r) { return sample(law, r); };
  }
  return [law = acg_with_moments(values)](RandomStream& r) { return sample(law, r); };
}

AxisSampler axis_sampler(const OrientationLaw& law) {
  return std::visit(
      Overloaded{[](const RandomOrientation&) -> AxisSampler { return random_direction; },
                 [](const AlignedOrientation& l) -> AxisSampler {
                   return [u = normalized(l.axis)](RandomStream&) { return u; };
                 },
                 [](const PlanarOrientation& l) { return planar_sampler(l.normal); },
                 [](const TensorOrientation& l) -> AxisSampler {
                   const Eigenframe a = eigenframe(l.tensor);
                   return [a, inner = family_sampler(a.values, l.family)](RandomStream& random) {
                     return normalized(a.frame * inner(random));
                   };
                 },
                 [](const AngleOrientation&) -> AxisSampler { return {}; }},
      law);
}

std::vector<Vec3> sample_with(const AxisSampler& sampler, std::int64_t count, std::uint64_t seed,
                              std::uint64_t group, std::int64_t first) {
  std::vector<Vec3> axes(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    RandomStream random = axis_stream(seed, group, first + i);
    axes[static_cast<std::size_t>(i)] = sampler(random);
  }
  return axes;
}

std::vector<Vec3> exact_tensor_axes(const TensorOrientation& law, std::int64_t count,
                                    std::uint64_t seed, std::uint64_t group) {
  const Eigenframe a = eigenframe(law.tensor);
  if (a.rank > count) {
    throw InvalidArgument("an orientation tensor of rank " + std::to_string(a.rank) +
                          " cannot be met by " + std::to_string(count) +
                          " inclusions, allowed are counts >= " + std::to_string(a.rank));
  }
  std::vector<Vec3> axes = sample_with(family_sampler(a.values, law.family), count, seed, group, 0);
  make_exact(axes, a.values);
  for (Vec3& u : axes) u = normalized(a.frame * u);
  return axes;
}

// --- angles ------------------------------------------------------------------------------------

double in_half_turn(double angle) {
  const double reduced = std::fmod(angle, pi);
  const double shifted = reduced < 0.0 ? reduced + pi : reduced;
  return shifted < pi ? shifted : 0.0;
}

std::vector<double> angles_of(const std::vector<Vec3>& axes) {
  std::vector<double> angles;
  angles.reserve(axes.size());
  for (const Vec3& u : axes) angles.push_back(in_half_turn(std::atan2(u.y, u.x)));
  return angles;
}

std::vector<double> angles_of(const AngleOrientation& law, std::int64_t count, std::uint64_t seed,
                              std::uint64_t group, std::int64_t first) {
  std::vector<double> angles =
      draw(law.degrees, count, seed, StreamId::orientations, group, 1, first);
  for (double& angle : angles) angle = in_half_turn(std::fmod(angle, 180.0) * (pi / 180.0));
  return angles;
}

// The law as one of axes in the plane z = 0.
OrientationLaw flattened(const OrientationLaw& law) {
  if (std::holds_alternative<RandomOrientation>(law)) return PlanarOrientation{};
  OrientationLaw flat = law;
  if (auto* ordered = std::get_if<TensorOrientation>(&flat)) {
    ordered->tensor.zz = ordered->tensor.yz = ordered->tensor.xz = 0.0;
  }
  return flat;
}

}  // namespace

void check_orientation_law(const OrientationLaw& law, const std::string& what, int dimension) {
  std::visit(
      Overloaded{[](const RandomOrientation&) {},
                 [&](const AlignedOrientation& l) { check_direction(what + ".axis", l.axis); },
                 [&](const PlanarOrientation& l) { check_direction(what + ".planar", l.normal); },
                 [&](const TensorOrientation& l) { check_tensor(what + ".tensor", l.tensor); },
                 [&](const AngleOrientation& l) {
                   check_distribution(l.degrees, what + ".degrees");
                   if (l.degrees.by == Weighting::volume) {
                     throw InvalidArgument(what +
                                           ".degrees counts volume, allowed is by = "
                                           "\"number\"");
                   }
                 }},
      law);
  dimension == 2 ? check_in_plane(law, what) : check_in_space(law, what);
}

std::vector<Vec3> draw_axes(const OrientationLaw& law, std::int64_t count, std::uint64_t seed,
                            std::uint64_t group) {
  check_orientation_law(law, "orientation");
  if (const auto* ordered = std::get_if<TensorOrientation>(&law)) {
    return exact_tensor_axes(*ordered, count, seed, group);
  }
  return sample_with(axis_sampler(law), count, seed, group, 0);
}

std::vector<Vec3> sample_axes(const OrientationLaw& law, std::int64_t count, std::uint64_t seed,
                              std::uint64_t group, std::int64_t first) {
  check_orientation_law(law, "orientation");
  return sample_with(axis_sampler(law), count, seed, group, first);
}

Quaternion random_turn_about(const Vec3& axis, int body_axis, std::uint64_t seed,
                             std::uint64_t group, std::int64_t item) {
  PACKSTONE_ASSERT(body_axis >= 0 && body_axis <= 2);
  RandomStream random(seed, StreamId::orientations, static_cast<std::uint64_t>(item), group);
  const Quaternion twist = from_axis_angle({0, 0, 1}, 2.0 * pi * random.uniform());
  // A third of a turn about (1, 1, 1), one way or the other, takes body x or y to z.
  const Quaternion to_z = body_axis == 0   ? Quaternion{0.5, -0.5, -0.5, -0.5}
                          : body_axis == 1 ? Quaternion{0.5, 0.5, 0.5, 0.5}
                                           : Quaternion{};
  return normalized(from_z_to(axis) * twist * to_z);
}

std::vector<Quaternion> draw_rotations(const OrientationLaw& law, std::int64_t count,
                                       std::uint64_t seed, std::uint64_t group, int body_axis) {
  const std::vector<Vec3> axes = draw_axes(law, count, seed, group);
  std::vector<Quaternion> rotations;
  rotations.reserve(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    rotations.push_back(
        random_turn_about(axes[i], body_axis, seed, group, static_cast<std::int64_t>(i)));
  }
  return rotations;
}

std::vector<double> draw_angles(const OrientationLaw& law, std::int64_t count, std::uint64_t seed,
                                std::uint64_t group) {
  check_orientation_law(law, "orientation", 2);
  if (const auto* angle = std::get_if<AngleOrientation>(&law)) {
    return angles_of(*angle, count, seed, group, 0);
  }
  return angles_of(draw_axes(flattened(law), count, seed, group));
}

std::vector<double> sample_angles(const OrientationLaw& law, std::int64_t count, std::uint64_t seed,
                                  std::uint64_t group, std::int64_t first) {
  check_orientation_law(law, "orientation", 2);
  if (const auto* angle = std::get_if<AngleOrientation>(&law)) {
    return angles_of(*angle, count, seed, group, first);
  }
  return angles_of(sample_axes(flattened(law), count, seed, group, first));
}

SymMat3 orientation_tensor(const std::vector<Vec3>& axes) noexcept {
  // Block by block, so that rounding grows like the root of the number of blocks.
  constexpr std::size_t block = 1024;
  SymMat3 sum;
  for (std::size_t begin = 0; begin < axes.size(); begin += block) {
    SymMat3 part;
    for (std::size_t i = begin; i < std::min(axes.size(), begin + block); ++i) {
      part = part + dyad(axes[i]);
    }
    sum = sum + part;
  }
  return axes.empty() ? sum : (1.0 / static_cast<double>(axes.size())) * sum;
}

}  // namespace packstone
