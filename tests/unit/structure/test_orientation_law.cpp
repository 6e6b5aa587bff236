#include "packstone/structure/orientation_law.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "packstone/core/error.hpp"
#include "structure/axis_laws.hpp"
#include "structure/exact_tensor.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

constexpr SymMat3 kIsotropic{1.0 / 3, 1.0 / 3, 1.0 / 3, 0, 0, 0};
constexpr SymMat3 kInjection{0.7, 0.25, 0.05, 0, 0, 0};
constexpr SymMat3 kAligned{0.9, 0.05, 0.05, 0, 0, 0};
constexpr SymMat3 kPlanar{0.5, 0.5, 0, 0, 0, 0};
constexpr SymMat3 kTurned{0.4, 0.35, 0.25, 0.05, 0.1, -0.08};
constexpr SymMat3 kNeedle{1 - 2e-9, 1e-9, 1e-9, 0, 0, 0};
constexpr SymMat3 kNearlyPlanar{0.6, 0.4 - 1e-8, 1e-8, 0, 0, 0};
constexpr SymMat3 kPlanarTurned{0.6, 0.4, 0, 0, 0, 0.2};
constexpr TensorFamily kFamilies[] = {TensorFamily::angular_central_gaussian,
                                      TensorFamily::bingham};

double largest(const SymMat3& a) {
  return std::max({std::abs(a.xx), std::abs(a.yy), std::abs(a.zz), std::abs(a.yz), std::abs(a.xz),
                   std::abs(a.xy)});
}

double error(const std::vector<Vec3>& axes, const SymMat3& tensor) {
  return largest(orientation_tensor(axes) - tensor);
}

double mean_of(const std::vector<Vec3>& axes, const std::function<double(const Vec3&)>& f) {
  double sum = 0.0;
  for (const Vec3& u : axes) sum += f(u);
  return sum / static_cast<double>(axes.size());
}

double x4(const Vec3& u) { return std::pow(u.x, 4); }
double y4(const Vec3& u) { return std::pow(u.y, 4); }
double x2y2(const Vec3& u) { return u.x * u.x * u.y * u.y; }

// The largest distance of the distribution of `values`, which lie in [0, 1), from uniform.
double distance_from_uniform(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto k = static_cast<double>(i);
    worst = std::max({worst, std::abs(values[i] - k / n), std::abs((k + 1) / n - values[i])});
  }
  return worst;
}

// P(D > 2.2 / sqrt(n)) = 1.2e-4; seeds are fixed.
double kolmogorov_bound(std::size_t n) { return 2.2 / std::sqrt(static_cast<double>(n)); }

// The oracle: means over an octant of the sphere by midpoints in both angles, which all densities
// here continue symmetrically. The polar axis is x, the axis that directions crowd about.
double mean_over_sphere(const std::function<double(const Vec3&)>& density,
                        const std::function<double(const Vec3&)>& f) {
  constexpr int n = 500;
  double sum = 0.0, weight = 0.0;
  for (int i = 0; i < n; ++i) {
    const double theta = 0.5 * pi * (i + 0.5) / n;
    const double t = std::cos(theta), r = std::sin(theta);
    for (int j = 0; j < n; ++j) {
      const double phi = 0.5 * pi * (j + 0.5) / n;
      const Vec3 u{t, r * std::cos(phi), r * std::sin(phi)};
      const double p = r * density(u);
      sum += p * f(u);
      weight += p;
    }
  }
  return sum / weight;
}

std::function<double(const Vec3&)> density_of(const AngularCentralGaussian& law) {
  return [law](const Vec3& u) { return std::pow(norm(unscale(u, law.root_lambda)), -3); };
}

std::function<double(const Vec3&)> density_of(const Bingham& law) {
  return [law](const Vec3& u) { return std::exp(-dot(law.kappa, scale(u, u))); };
}

TEST_CASE("random axes and rotations prefer no direction") {
  const int n = 40'000;
  const auto axes = draw_axes(RandomOrientation{}, n, 3, 0);
  // Five standard errors: var(x^2) = 4/45, var(x^4) = 1/9 - 1/25, var(x^2 y^2) = 1/105 - 1/225.
  CHECK(error(axes, kIsotropic) < 5 * std::sqrt(4.0 / 45 / n));
  CHECK(mean_of(axes, x4) == Approx(0.2).margin(5 * std::sqrt(0.0712 / n)));
  CHECK(mean_of(axes, x2y2) == Approx(1.0 / 15).margin(5 * std::sqrt(0.0051 / n)));
  for (int body_axis : {0, 1, 2}) {
    const auto rotations = draw_rotations(RandomOrientation{}, n, 3, 0, body_axis);
    // The angle of a uniform rotation has the distribution function (theta - sin theta) / pi:
    // R. E. Miles, Biometrika 52 (1965) 636-639.
    std::vector<double> share;
    for (const Quaternion& q : rotations) {
      const double theta = 2.0 * std::acos(std::min(1.0, std::abs(q.w)));
      share.push_back((theta - std::sin(theta)) / pi);
    }
    CHECK(distance_from_uniform(share) < kolmogorov_bound(share.size()));
  }
}

TEST_CASE("aligned axes are the axis, and rotations turn the chosen body axis to it") {
  const Vec3 wanted{1, -2, 2};
  const AlignedOrientation law{wanted};
  for (const Vec3& u : draw_axes(law, 10, 1, 0)) CHECK(norm(u - wanted / 3.0) < 1e-15);
  for (int body_axis : {0, 1, 2}) {
    Vec3 e;
    e[static_cast<std::size_t>(body_axis)] = 1.0;
    for (const Quaternion& q : draw_rotations(law, 10, 1, 0, body_axis)) {
      CHECK(norm(rotate(q, e) - wanted / 3.0) < 2e-15);
      CHECK(norm(q) == Approx(1.0).epsilon(1e-15));
    }
  }
}

TEST_CASE("the turn about the axis is uniform") {
  for (int body_axis : {0, 1, 2}) {
    Vec3 side;
    side[static_cast<std::size_t>((body_axis + 1) % 3)] = 1.0;
    std::vector<double> turn;
    for (const Quaternion& q :
         draw_rotations(AlignedOrientation{{0, 0, 1}}, 20'000, 5, 2, body_axis)) {
      const Vec3 v = rotate(q, side);
      REQUIRE(std::abs(v.z) < 1e-15);
      turn.push_back(std::clamp(std::atan2(v.y, v.x) / (2 * pi) + 0.5, 0.0, 1.0));
    }
    CHECK(distance_from_uniform(turn) < kolmogorov_bound(turn.size()));
  }
}

TEST_CASE("planar axes lie in the plane, exactly for a coordinate plane, and turn uniformly") {
  std::vector<double> turn;
  for (const Vec3& u : draw_axes(PlanarOrientation{{0, 0, 2}}, 20'000, 1, 0)) {
    REQUIRE(u.z == 0.0);
    turn.push_back(std::clamp(std::atan2(u.y, u.x) / (2 * pi) + 0.5, 0.0, 1.0));
  }
  CHECK(distance_from_uniform(turn) < kolmogorov_bound(turn.size()));
  const Vec3 normal{1, 2, -3};
  for (const Vec3& u : draw_axes(PlanarOrientation{normal}, 100, 1, 0)) {
    CHECK(std::abs(dot(u, normal)) < 4e-15);
    CHECK(norm(u) == Approx(1.0).epsilon(1e-15));
  }
}

TEST_CASE("a tensor is met exactly by any sample that is not smaller than its rank") {
  for (const TensorFamily family : kFamilies) {
    for (const SymMat3& tensor : {kIsotropic, kInjection, kAligned, kPlanar, kTurned, kNeedle,
                                  kNearlyPlanar, kPlanarTurned}) {
      const bool planar = tensor.zz == 0.0;
      for (int count : {2, 3, 4, 5, 7, 10, 30, 100, 1000}) {
        if (count < 3 && !planar) continue;
        const int samples = count <= 10 ? 20 : 2;
        for (int seed = 1; seed <= samples; ++seed) {
          const auto axes = draw_axes(TensorOrientation{tensor, family}, count,
                                      static_cast<std::uint64_t>(seed), 0);
          INFO("tensor " << tensor.xx << ", count " << count << ", seed " << seed);
          // Promised is 1e-12; a sum of `count` numbers of size 1 rounds to some 1e-15.
          CHECK(error(axes, tensor) < 1e-14);
          for (const Vec3& u : axes) {
            REQUIRE(std::abs(norm(u) - 1.0) < 1e-15);
            if (planar) REQUIRE(u.z == 0.0);
          }
        }
      }
    }
  }
}

TEST_CASE("a tensor of rank 1 is one direction, for one inclusion too") {
  const Vec3 n = normalized(Vec3{3, -1, 2});
  for (int count : {1, 2, 50}) {
    for (const Vec3& u : draw_axes(TensorOrientation{dyad(n)}, count, 1, 0)) {
      CHECK(std::abs(std::abs(dot(u, n)) - 1.0) < 1e-15);
    }
  }
}

TEST_CASE("fewer inclusions than the rank of the tensor are refused") {
  CHECK_THROWS_WITH(draw_axes(TensorOrientation{kIsotropic}, 2, 1, 0),
                    Catch::Contains("rank 3 cannot be met by 2 inclusions"));
  CHECK_THROWS_WITH(draw_axes(TensorOrientation{kPlanar}, 1, 1, 0),
                    Catch::Contains("rank 2 cannot be met by 1 inclusions"));
  CHECK_NOTHROW(draw_axes(TensorOrientation{kPlanar}, 2, 1, 0));
}

TEST_CASE("the construction behind the correction works alone") {
  for (const SymMat3& tensor : {kIsotropic, kInjection, kAligned}) {
    for (int count : {3, 4, 5, 17, 400}) {
      const auto start = sample_axes(RandomOrientation{}, count, 9, 0);
      const auto axes = exact_axes(start, {tensor.xx, tensor.yy, tensor.zz});
      // Each of the `count` rotations rounds once.
      CHECK(error(axes, tensor) < 1e-15 * (10 + count));
      for (const Vec3& u : axes) CHECK(std::abs(norm(u) - 1.0) < 1e-15);
    }
  }
}

TEST_CASE("the parameters of both families give the moments that were asked for") {
  for (const SymMat3& tensor :
       {kIsotropic, kInjection, kAligned, SymMat3{0.48, 0.48, 0.04, 0, 0, 0}}) {
    const Vec3 wanted{tensor.xx, tensor.yy, tensor.zz};
    const auto acg = density_of(acg_with_moments(wanted));
    const auto bingham = density_of(bingham_with_moments(wanted));
    for (const auto& density : {acg, bingham}) {
      // The error of the midpoint rule.
      CHECK(mean_over_sphere(density, [](const Vec3& u) { return u.x * u.x; }) ==
            Approx(wanted.x).margin(2e-5));
      CHECK(mean_over_sphere(density, [](const Vec3& u) { return u.y * u.y; }) ==
            Approx(wanted.y).margin(2e-5));
    }
  }
}

TEST_CASE("the moments are inverted for extreme tensors as well") {
  for (double small : {1e-2, 1e-4, 1e-8, 1e-12}) {
    for (const Vec3& wanted :
         {Vec3{1 - 2 * small, small, small}, Vec3{0.5, 0.5 - small, small},
          Vec3{0.7, 0.3 - small, small}, Vec3{1 - 1.5 * small, small, 0.5 * small}}) {
      INFO(wanted.x << ' ' << wanted.y << ' ' << wanted.z);
      const Vec3 acg = acg_moments(acg_with_moments(wanted));
      const Vec3 bingham = bingham_moments(bingham_with_moments(wanted));
      for (std::size_t i = 1; i < 3; ++i) {
        CHECK(acg[i] == Approx(wanted[i]).epsilon(1e-9));
        CHECK(bingham[i] == Approx(wanted[i]).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("exact samples have the fourth moments of their family") {
  const int n = 40'000;
  for (const SymMat3& tensor : {kInjection, kAligned}) {
    const Vec3 wanted{tensor.xx, tensor.yy, tensor.zz};
    const std::function<double(const Vec3&)> densities[] = {
        density_of(acg_with_moments(wanted)), density_of(bingham_with_moments(wanted))};
    for (std::size_t f = 0; f < 2; ++f) {
      const auto axes = draw_axes(TensorOrientation{tensor, kFamilies[f]}, n, 8, 1);
      // Five standard errors; u_x^4 varies by at most 0.4, the others by less.
      const double margin = 5 * 0.4 / std::sqrt(n);
      CHECK(mean_of(axes, x4) == Approx(mean_over_sphere(densities[f], x4)).margin(margin));
      CHECK(mean_of(axes, y4) == Approx(mean_over_sphere(densities[f], y4)).margin(0.5 * margin));
      CHECK(mean_of(axes, x2y2) ==
            Approx(mean_over_sphere(densities[f], x2y2)).margin(0.25 * margin));
    }
    // The families differ by more than that: the choice matters.
    CHECK(mean_over_sphere(densities[0], x4) - mean_over_sphere(densities[1], x4) > 0.02);
  }
}

TEST_CASE("planar samples have the fourth moments of their family in the plane") {
  const int n = 40'000;
  const SymMat3 tensor{0.8, 0.2, 0, 0, 0, 0};
  const auto mean_over_circle = [](const auto& density) {
    double sum = 0, weight = 0;
    for (int i = 0; i < 4000; ++i) {
      const double phi = pi * (i + 0.5) / 4000;
      const Vec3 u{std::cos(phi), std::sin(phi), 0};
      sum += density(u) * x4(u);
      weight += density(u);
    }
    return sum / weight;
  };
  const AngularCentralGaussian acg = acg_with_moments({0.8, 0.2, 0});
  const Bingham bingham = bingham_with_moments({0.8, 0.2, 0});
  const double means[] = {mean_over_circle([&](const Vec3& u) {
                            return 1.0 / (u.x * u.x / std::pow(acg.root_lambda.x, 2) +
                                          u.y * u.y / std::pow(acg.root_lambda.y, 2));
                          }),
                          mean_over_circle(density_of(bingham))};
  for (std::size_t f = 0; f < 2; ++f) {
    const auto axes = draw_axes(TensorOrientation{tensor, kFamilies[f]}, n, 8, 1);
    // Five standard errors of u_x^4, whose spread is below 0.4.
    CHECK(mean_of(axes, x4) == Approx(means[f]).margin(5 * 0.4 / std::sqrt(n)));
  }
}

TEST_CASE("a uniform sample becomes one of the angular central Gaussian law by correction alone") {
  const int n = 20'000;
  for (const SymMat3& tensor : {kInjection, kAligned}) {
    const Vec3 wanted{tensor.xx, tensor.yy, tensor.zz};
    auto axes = sample_axes(RandomOrientation{}, n, 21, 0);
    make_exact(axes, wanted);
    const auto density = density_of(acg_with_moments(wanted));
    CHECK(error(axes, tensor) < 1e-14);
    CHECK(mean_of(axes, x4) ==
          Approx(mean_over_sphere(density, x4)).margin(5 * 0.4 / std::sqrt(n)));
  }
}

// Rms angle between the axes as drawn and as corrected [degrees].
double rms_turn(const TensorOrientation& law, int count, int samples) {
  double sum = 0.0;
  for (int s = 0; s < samples; ++s) {
    const auto seed = static_cast<std::uint64_t>(100 + s);
    const auto before = sample_axes(law, count, seed, 0);
    const auto after = draw_axes(law, count, seed, 0);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double angle = std::asin(std::min(1.0, norm(cross(before[i], after[i]))));
      sum += angle * angle;
    }
  }
  return std::sqrt(sum / count / samples) * 180.0 / pi;
}

TEST_CASE("the correction turns no more than the noise of the sample, 50 / sqrt(count) degrees") {
  for (const TensorFamily family : kFamilies) {
    for (const SymMat3& tensor : {kIsotropic, kInjection, kAligned}) {
      for (int count : {100, 1000, 10'000}) {
        const double turn =
            rms_turn({tensor, family}, count, count > 5000 ? 4 : 20) * std::sqrt(count);
        INFO("tensor " << tensor.xx << ", count " << count << ": " << turn);
        CHECK(turn < 60.0);
        CHECK(turn > 20.0);
      }
    }
  }
}

TEST_CASE("an axis depends on seed, group and item alone until the correction") {
  for (const OrientationLaw& law :
       {OrientationLaw{RandomOrientation{}}, OrientationLaw{PlanarOrientation{}},
        OrientationLaw{TensorOrientation{kTurned}},
        OrientationLaw{TensorOrientation{kTurned, TensorFamily::bingham}}}) {
    const auto all = sample_axes(law, 20, 1, 3);
    const auto tail = sample_axes(law, 5, 1, 3, 15);
    CHECK(std::equal(tail.begin(), tail.end(), all.begin() + 15));
    CHECK_FALSE(sample_axes(law, 1, 2, 3).front() == all.front());
    CHECK_FALSE(sample_axes(law, 1, 1, 4).front() == all.front());
  }
}

TEST_CASE("in the plane every law gives angles in [0, pi)") {
  const std::vector<OrientationLaw> laws{RandomOrientation{},
                                         PlanarOrientation{},
                                         AlignedOrientation{{-1, 1, 0}},
                                         TensorOrientation{{0.7, 0.3, 0, 0, 0, 0.1}},
                                         AngleOrientation{{UniformLaw{-500, 700}}},
                                         AngleOrientation{{ConstantLaw{180}}},
                                         AngleOrientation{{ConstantLaw{-1e-15}}}};
  for (const OrientationLaw& law : laws) {
    for (double angle : draw_angles(law, 500, 1, 0)) REQUIRE((angle >= 0.0 && angle < pi));
  }
}

TEST_CASE("angles in the plane follow their law") {
  for (double angle : draw_angles(AlignedOrientation{{-1, 1, 0}}, 3, 1, 0)) {
    CHECK(angle == Approx(0.75 * pi).epsilon(1e-15));
  }
  for (double angle : draw_angles(AngleOrientation{{ConstantLaw{-30}}}, 3, 1, 0)) {
    CHECK(angle == Approx(150 * pi / 180).epsilon(1e-15));
  }
  std::vector<double> random, uniform;
  for (double a : draw_angles(RandomOrientation{}, 20'000, 1, 0)) random.push_back(a / pi);
  for (double a : draw_angles(AngleOrientation{{UniformLaw{10, 40}}}, 20'000, 1, 0)) {
    uniform.push_back((a * 180 / pi - 10) / 30);
  }
  CHECK(distance_from_uniform(random) < kolmogorov_bound(random.size()));
  CHECK(distance_from_uniform(uniform) < kolmogorov_bound(uniform.size()));
  const auto angles = draw_angles(TensorOrientation{{0.7, 0.3, 0, 0, 0, 0.1}}, 50, 1, 0);
  double xx = 0, xy = 0;
  for (double a : angles) {
    xx += std::cos(a) * std::cos(a) / 50;
    xy += std::cos(a) * std::sin(a) / 50;
  }
  CHECK(xx == Approx(0.7).epsilon(1e-14));
  CHECK(xy == Approx(0.1).epsilon(1e-13));
  const auto tail = sample_angles(RandomOrientation{}, 5, 1, 0, 10);
  const auto all = draw_angles(RandomOrientation{}, 15, 1, 0);
  CHECK(std::equal(tail.begin(), tail.end(), all.begin() + 10));
}

TEST_CASE("orientation laws that are none are refused with the field and the range") {
  const auto refused = [](const OrientationLaw& law, int dimension, const char* message) {
    CHECK_THROWS_AS(check_orientation_law(law, "fibers", dimension), InvalidArgument);
    CHECK_THROWS_WITH(check_orientation_law(law, "fibers", dimension), Catch::Contains(message));
  };
  refused(AlignedOrientation{{0, 0, 0}}, 3, "fibers.axis = [0, 0, 0]");
  refused(PlanarOrientation{{NAN, 0, 0}}, 3, "fibers.planar = [nan, 0, 0]");
  refused(TensorOrientation{{0.5, 0.3, 0.1, 0, 0, 0}}, 3, "trace 0.9, allowed is 1");
  refused(TensorOrientation{{0.5, 0.6, -0.1, 0, 0, 0}}, 3, "eigenvalue -0.1, allowed");
  refused(TensorOrientation{{0.5, 0.5, 0, 0, 0, 0.6}}, 3, "eigenvalue -0.1");
  refused(TensorOrientation{{NAN, 0.5, 0, 0, 0, 0}}, 3, "entry nan");
  refused(AngleOrientation{}, 3, "fibers.degrees is for 2D");
  refused(AngleOrientation{{UniformLaw{2, 1}}}, 2, "fibers.degrees.uniform[0] = 2");
  refused(AngleOrientation{{UniformLaw{1, 2}, Weighting::volume}}, 2, "counts volume");
  refused(AlignedOrientation{{0, 1, 1}}, 2, "allowed in 2D are axes with z = 0");
  refused(PlanarOrientation{{1, 0, 0}}, 2, "allowed in 2D is the plane");
  refused(TensorOrientation{kIsotropic}, 2, "allowed in 2D are tensors with zz");
  CHECK_NOTHROW(check_orientation_law(TensorOrientation{kPlanar}, "fibers", 2));
  CHECK_THROWS_AS(draw_axes(AngleOrientation{}, 1, 1, 0), InvalidArgument);
}

TEST_CASE("the tensor of many axes is summed without loss") {
  // 10^6 equal axes: a running sum would lose 1e-13.
  const Vec3 u = normalized(Vec3{1, 2, 3});
  CHECK(largest(orientation_tensor(std::vector<Vec3>(1'000'000, u)) - dyad(u)) < 2e-14);
  CHECK(orientation_tensor({}) == SymMat3{});
}

}  // namespace
}  // namespace packstone
