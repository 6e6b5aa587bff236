#include "packstone/structure/inclusion_mix.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

const Cell kCube{};
const Cell kBox{3, {2, 3, 1.5}, {true, true, true}};
const Cell kSquare = cell_2d(1, 1);

InclusionGroup group_of(ShapeKind shape, const char* name = "beads") {
  InclusionGroup group;
  group.name = name;
  group.shape = shape;
  return group;
}

InclusionGroup ordered(ShapeKind shape, std::int64_t count, double share) {
  InclusionGroup group = group_of(shape);
  group.count = count;
  group.fraction = share;
  return group;
}

InclusionGroup beads_of_radius(double radius) {
  InclusionGroup group = group_of(ShapeKind::sphere);
  group.measure = SizeMeasure::radius;
  group.size.law = ConstantLaw{radius};
  return group;
}

double fraction_of(const Cell& cell, const InclusionMix& mix, int group) {
  double sum = 0.0;
  for (const OrderedBody& b : mix.bodies) sum += b.group == group ? volume(b.body) : 0.0;
  return sum / volume(cell);
}

template <class Shape>
Shape body_at(const InclusionMix& mix, std::size_t i) {
  return std::get<Shape>(mix.bodies.at(i).body);
}

TEST_CASE("count and fraction are met exactly by every shape, whatever its laws") {
  for (ShapeKind shape : {ShapeKind::sphere, ShapeKind::ellipsoid, ShapeKind::cylinder,
                          ShapeKind::spherocylinder, ShapeKind::disk, ShapeKind::ellipse}) {
    const Cell cell = dimension(shape) == 2 ? kSquare : kBox;
    for (Weighting by : {Weighting::number, Weighting::volume}) {
      InclusionGroup group = ordered(shape, 300, 0.21);
      group.size = {lognormal_from_moments(1.0, 0.4, 0.3, 3.0), by};
      group.aspect.law = UniformLaw{shape == ShapeKind::ellipse ? 1.0 : 0.5, 2.0};
      group.aspect_second.law = NormalLaw{1.0, 0.2, 0.5, 1.5};
      const InclusionMix mix = draw_inclusions(cell, {group}, 1);
      CHECK(mix.bodies.size() == 300);
      // Each volume rounds some five times, independently; the sum of 300 some ten times.
      CHECK(fraction_of(cell, mix, 0) == Approx(0.21).epsilon(3e-15));
      for (const OrderedBody& b : mix.bodies) CHECK_NOTHROW(check_body(b.body));
    }
  }
}

TEST_CASE("equal fibers have the size that count, fraction and aspect give by hand") {
  InclusionGroup fibers = ordered(ShapeKind::cylinder, 200, 0.40);
  fibers.name = "fibers";
  fibers.aspect.law = ConstantLaw{5};
  const InclusionMix mix = draw_inclusions(kCube, {fibers}, 1);
  // 200 pi r^2 (10 r) = 0.4
  const double radius = std::cbrt(0.4 / (2000 * pi));
  CHECK(body_at<Cylinder>(mix, 17).radius == Approx(radius).epsilon(1e-14));
  CHECK(body_at<Cylinder>(mix, 17).half_length == Approx(5 * radius).epsilon(1e-14));
  CHECK(mix.derived == std::vector<std::string>{"fibers: diameter 0.0798589 and length 0.399295 "
                                                "follow from count 200 and fraction 0.4"});
  CHECK(mix.open_count == std::vector<bool>{false});
}

TEST_CASE("a straight length over diameter is the aspect of a spherocylinder") {
  InclusionGroup group = ordered(ShapeKind::spherocylinder, 10, 0.1);
  group.aspect.law = ConstantLaw{3};
  const auto body = body_at<Spherocylinder>(draw_inclusions(kCube, {group}, 1), 0);
  CHECK(body.half_length / body.radius == Approx(3.0).epsilon(1e-14));
}

TEST_CASE("the aspects of an ellipsoid are a/b and a/c, of a spheroid one for both") {
  InclusionGroup group = ordered(ShapeKind::ellipsoid, 10, 0.1);
  group.aspect.law = ConstantLaw{1.25};
  group.aspect_second.law = ConstantLaw{2};
  const Vec3 s = body_at<Ellipsoid>(draw_inclusions(kCube, {group}, 1), 3).semi_axes;
  CHECK(s.x / s.y == Approx(1.25).epsilon(1e-14));
  CHECK(s.x / s.z == Approx(2.0).epsilon(1e-14));
  group.spheroid = true;
  group.aspect.law = UniformLaw{0.5, 3.0};
  const InclusionMix mix = draw_inclusions(kCube, {group}, 1);
  for (std::size_t i = 0; i < 10; ++i) {
    CHECK(body_at<Ellipsoid>(mix, i).semi_axes.y == body_at<Ellipsoid>(mix, i).semi_axes.z);
  }
}

TEST_CASE("each measure of size is what the body has") {
  const Cell big{3, {10, 10, 10}, {true, true, true}};
  const auto first = [&](ShapeKind shape, SizeMeasure measure) {
    InclusionGroup group = group_of(shape);
    group.count = 2;
    group.measure = measure;
    group.size.law = ConstantLaw{0.7};
    group.aspect.law = ConstantLaw{2};
    group.aspect_second.law = ConstantLaw{3};
    return draw_inclusions(dimension(shape) == 2 ? cell_2d(10, 10) : big, {group}, 1)
        .bodies[1]
        .body;
  };
  for (ShapeKind shape : {ShapeKind::sphere, ShapeKind::ellipsoid, ShapeKind::cylinder,
                          ShapeKind::spherocylinder, ShapeKind::disk, ShapeKind::ellipse}) {
    CHECK(volume(first(shape, SizeMeasure::volume)) == Approx(0.7).epsilon(1e-14));
    const double ball = dimension(shape) == 2 ? pi / 4 * 0.49 : pi / 6 * 0.343;
    CHECK(volume(first(shape, SizeMeasure::equivalent)) == Approx(ball).epsilon(1e-14));
  }
  CHECK(std::get<Sphere>(first(ShapeKind::sphere, SizeMeasure::radius)).radius == 0.7);
  CHECK(std::get<Disk>(first(ShapeKind::disk, SizeMeasure::radius)).radius == 0.7);
  const auto rod = std::get<Cylinder>(first(ShapeKind::cylinder, SizeMeasure::radius));
  CHECK((rod.radius == 0.7 && rod.half_length == 1.4));
  const auto capsule =
      std::get<Spherocylinder>(first(ShapeKind::spherocylinder, SizeMeasure::half_length));
  CHECK((capsule.radius == 0.35 && capsule.half_length == 0.7));
}

TEST_CASE("fixed dimensions are kept to the last bit") {
  InclusionGroup group = group_of(ShapeKind::ellipsoid);
  group.count = 3;
  group.dimensions = Vec3{0.1, 0.07, 0.03};
  CHECK(body_at<Ellipsoid>(draw_inclusions(kCube, {group}, 1), 2).semi_axes ==
        Vec3{0.1, 0.07, 0.03});
  group.shape = ShapeKind::cylinder;
  CHECK(body_at<Cylinder>(draw_inclusions(kCube, {group}, 1), 2).radius == 0.1);
  group.shape = ShapeKind::ellipse;
  CHECK(body_at<Ellipse>(draw_inclusions(kSquare, {group}, 1), 2).semi_axes == Vec2{0.1, 0.07});
}

TEST_CASE("size and fraction give the nearest whole count") {
  for (double share : {0.05, 0.1, 0.2, 0.3}) {
    InclusionGroup beads = beads_of_radius(0.05);
    beads.fraction = share;
    const InclusionMix mix = draw_inclusions(kCube, {beads}, 1);
    const double one = 4.0 / 3.0 * pi * 0.05 * 0.05 * 0.05;
    CHECK(mix.bodies.size() == static_cast<std::size_t>(std::lround(share / one)));
    CHECK(std::abs(fraction_of(kCube, mix, 0) - share) <= 0.5 * one);
  }
  InclusionGroup beads = beads_of_radius(0.1);
  beads.fraction = 0.1;
  CHECK(draw_inclusions(kCube, {beads}, 1).derived.front() ==
        "beads: count 24 follows from fraction 0.1 and diameter 0.2; whole inclusions make it "
        "fraction 0.100531");
}

TEST_CASE("drawn sizes and fraction stop where the sum comes nearest") {
  InclusionGroup beads = beads_of_radius(0.0);
  beads.size.law = LognormalLaw{std::log(0.02), 0.5};
  beads.fraction = 0.3;
  const InclusionMix mix = draw_inclusions(kCube, {beads}, 4);
  InclusionGroup more = beads;
  more.fraction.reset();
  more.count = static_cast<std::int64_t>(mix.bodies.size()) + 1;
  const InclusionMix longer = draw_inclusions(kCube, {more}, 4);
  const auto misses = [&](std::size_t count) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) sum += volume(longer.bodies[i].body);
    return std::abs(sum - 0.3);
  };
  const std::size_t n = mix.bodies.size();
  for (std::size_t i = 0; i < n; ++i) REQUIRE(mix.bodies[i].body == longer.bodies[i].body);
  CHECK(misses(n) <= misses(n - 1));
  CHECK(misses(n) <= misses(n + 1));
}

TEST_CASE("size and count give the fraction, and say so") {
  InclusionGroup beads = beads_of_radius(0.1);
  beads.count = 24;
  CHECK(draw_inclusions(kCube, {beads}, 1).derived.front() ==
        "beads: fraction 0.100531 follows from count 24 and diameter 0.2");
}

TEST_CASE("a size alone leaves the count open, and bodies come item by item") {
  InclusionGroup beads = group_of(ShapeKind::cylinder);
  beads.measure = SizeMeasure::equivalent;
  beads.size.law = UniformLaw{0.05, 0.1};
  beads.aspect.law = UniformLaw{1, 3};
  beads.orientation = TensorOrientation{{0.7, 0.25, 0.05, 0, 0, 0}};
  const InclusionMix mix = draw_inclusions(kCube, {beads}, 1);
  CHECK(mix.bodies.empty());
  CHECK(mix.open_count == std::vector<bool>{true});
  CHECK(mix.derived.front() ==
        "beads: the count is open, inclusions are added until the cell is full; the orientation "
        "tensor is met by chance only, to about 0.4 / sqrt(count), as a sample is corrected only "
        "where its count is known");
  const auto all = draw_open_group(kCube, beads, 2, 0, 20, 1);
  const auto tail = draw_open_group(kCube, beads, 2, 15, 5, 1);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(tail[i].body == all[15 + i].body);
    CHECK(tail[i].group == 2);
  }
}

TEST_CASE("groups come in their order and do not change one another") {
  const InclusionGroup a = ordered(ShapeKind::sphere, 5, 0.1);
  InclusionGroup b = ordered(ShapeKind::cylinder, 7, 0.1);
  b.size.law = UniformLaw{1, 2};
  const InclusionMix one = draw_inclusions(kCube, {a, b}, 1);
  const InclusionMix two = draw_inclusions(kCube, {ordered(ShapeKind::sphere, 50, 0.2), b}, 1);
  REQUIRE(one.bodies.size() == 12);
  for (std::size_t i = 0; i < 12; ++i) CHECK(one.bodies[i].group == (i < 5 ? 0 : 1));
  for (std::size_t i = 0; i < 7; ++i) CHECK(one.bodies[5 + i].body == two.bodies[50 + i].body);
  const InclusionMix other = draw_inclusions(kCube, {a, b}, 2);
  CHECK_FALSE(other.bodies[5].body == one.bodies[5].body);
  // Two groups alike in all but place draw different numbers.
  const InclusionMix twins = draw_inclusions(kCube, {b, b}, 1);
  CHECK_FALSE(twins.bodies[0].body == twins.bodies[7].body);
}

TEST_CASE("a prescribed tensor holds for the symmetry axes of every shape") {
  const SymMat3 wanted{0.6, 0.3, 0.1, 0.02, -0.05, 0.1};
  for (double aspect : {3.0, 0.3}) {
    InclusionGroup group = ordered(ShapeKind::ellipsoid, 60, 0.05);
    group.aspect.law = ConstantLaw{aspect};
    group.spheroid = true;
    group.orientation = TensorOrientation{wanted};
    std::vector<Vec3> axes;
    for (const OrderedBody& b : draw_inclusions(kCube, {group}, 1).bodies) {
      axes.push_back(to_matrix(std::get<Ellipsoid>(b.body).orientation).col_x);
    }
    CHECK(std::abs(orientation_tensor(axes).xy - wanted.xy) < 1e-14);
    CHECK(std::abs(orientation_tensor(axes).zz - wanted.zz) < 1e-14);
  }
  for (ShapeKind shape : {ShapeKind::cylinder, ShapeKind::spherocylinder}) {
    InclusionGroup group = ordered(shape, 60, 0.05);
    group.orientation = TensorOrientation{wanted};
    std::vector<Vec3> axes;
    for (const OrderedBody& b : draw_inclusions(kCube, {group}, 1).bodies) {
      axes.push_back(std::visit(
          [](const auto& s) {
            if constexpr (requires { s.axis; }) return s.axis;
            return Vec3{};
          },
          b.body));
    }
    CHECK(std::abs(orientation_tensor(axes).xz - wanted.xz) < 1e-14);
  }
}

TEST_CASE("the major axis of an ellipse takes the ordered angle, whichever axis that is") {
  for (const Vec3& semi_axes : {Vec3{0.02, 0.01, 0}, Vec3{0.01, 0.02, 0}}) {
    InclusionGroup group = group_of(ShapeKind::ellipse);
    group.count = 4;
    group.dimensions = semi_axes;
    group.orientation = AngleOrientation{{ConstantLaw{30}}};
    for (const OrderedBody& b : draw_inclusions(kSquare, {group}, 1).bodies) {
      // Farther along 30 degrees than across: the second moment says which is the major axis.
      const SymMat3 m = second_moment(b.body);
      const Vec3 u{std::cos(pi / 6), 0.5, 0};
      CHECK(dot(u, m * u) / trace(m) == Approx(0.8).epsilon(1e-13));
    }
  }
}

TEST_CASE("random ellipsoids with drawn aspects are isotropic in every body axis") {
  InclusionGroup group = ordered(ShapeKind::ellipsoid, 20'000, 0.2);
  group.aspect.law = UniformLaw{0.5, 2};
  group.aspect_second.law = UniformLaw{0.5, 2};
  std::vector<Vec3> x, y, z;
  for (const OrderedBody& b : draw_inclusions(kCube, {group}, 1).bodies) {
    const Mat3 m = to_matrix(std::get<Ellipsoid>(b.body).orientation);
    x.push_back(m.col_x);
    y.push_back(m.col_y);
    z.push_back(m.col_z);
  }
  // Five standard errors of u_x^2, whose variance is 4/45.
  const double margin = 5 * std::sqrt(4.0 / 45 / 20'000);
  for (const auto& axes : {x, y, z}) {
    CHECK(orientation_tensor(axes).xx == Approx(1.0 / 3).margin(margin));
    CHECK(orientation_tensor(axes).zz == Approx(1.0 / 3).margin(margin));
  }
}

void refused(const Cell& cell, const std::vector<InclusionGroup>& groups, const char* message) {
  CHECK_THROWS_AS(draw_inclusions(cell, groups, 1), InvalidArgument);
  CHECK_THROWS_WITH(draw_inclusions(cell, groups, 1), Catch::Contains(message));
}

TEST_CASE("groups that say too much or too little are refused") {
  InclusionGroup group = group_of(ShapeKind::sphere);
  refused(kCube, {group}, "group 'beads': nothing says how many");
  group.count = 10;
  refused(kCube, {group}, "group 'beads': count alone does not fix");
  group.count.reset();
  group.fraction = 0.1;
  refused(kCube, {group}, "group 'beads': fraction alone does not fix");
  group = beads_of_radius(0.1);
  group.count = 10;
  group.fraction = 0.1;
  refused(kCube, {group}, "allowed are two of the three");
  group.fraction.reset();
  group.count = 0;
  refused(kCube, {group}, "count = 0; allowed are counts >= 1");
  group.name.clear();
  refused(kCube, {beads_of_radius(0.1), group}, "group 1: count = 0");
  refused(kCube, {ordered(ShapeKind::sphere, 5, 1.2)}, "fraction = 1.2");
  refused(kCube, {ordered(ShapeKind::sphere, 5, 0.0)}, "fraction = 0");
  refused(kCube, {ordered(ShapeKind::sphere, 5, NAN)}, "fraction = nan");
}

TEST_CASE("shapes, measures and laws that do not fit are refused") {
  refused(kCube, {ordered(ShapeKind::disk, 5, 0.1)},
          "shape = disk; allowed in a 3D cell are sphere");
  refused(kSquare, {ordered(ShapeKind::sphere, 5, 0.1)},
          "shape = sphere; allowed in a 2D cell are disk");
  InclusionGroup group = ordered(ShapeKind::ellipsoid, 5, 0.1);
  group.fraction.reset();
  group.measure = SizeMeasure::radius;
  refused(kCube, {group}, "a radius does not fix the size of the shape ellipsoid");
  group = ordered(ShapeKind::sphere, 5, 0.1);
  group.size.law = NormalLaw{1, 0.5};
  refused(kCube, {group}, "size can be as small as -3.");
  group.size.law = ConstantLaw{0};
  refused(kCube, {group}, "size can be as small as 0, allowed are values > 0");
  group.size.law = UniformLaw{2, 1};
  refused(kCube, {group}, "group 'beads': size.uniform[0] = 2");
  group = ordered(ShapeKind::cylinder, 5, 0.1);
  group.aspect.law = ConstantLaw{-2};
  refused(kCube, {group}, "aspect can be as small as -2");
  group.aspect = {UniformLaw{1, 2}, Weighting::volume};
  refused(kCube, {group}, "aspect counts volume");
  group.fraction.reset();
  group.measure = SizeMeasure::radius;
  group.size.law = ConstantLaw{0.01};
  CHECK_NOTHROW(draw_inclusions(kCube, {group}, 1));
  group.size.law = UniformLaw{0.01, 0.02};
  refused(kCube, {group}, "except for cylinders of one radius");
  group = ordered(ShapeKind::cylinder, 2, 0.1);
  group.orientation = TensorOrientation{};
  refused(kCube, {group}, "group 'beads': an orientation tensor of rank 3");
  InclusionGroup single = ordered(ShapeKind::ellipse, 1, 0.1);
  single.orientation = TensorOrientation{{0.5, 0.5, 0, 0, 0, 0}};
  refused(kSquare, {single}, "group 'beads': an orientation tensor of rank 2");
  group.orientation = AngleOrientation{};
  refused(kCube, {group}, "group 'beads': orientation.degrees is for 2D");
  group = group_of(ShapeKind::cylinder);
  group.count = 1;
  group.dimensions = Vec3{0.1, -1, 0};
  refused(kCube, {group}, "half length = -1");
  CHECK_THROWS_AS(draw_inclusions(Cell{3, {1, 0, 1}, {}}, {}, 1), InvalidArgument);
  CHECK_THROWS_WITH(draw_open_group(kCube, ordered(ShapeKind::sphere, 5, 0.1), 0, 0, 1, 1),
                    Catch::Contains("allowed here is a size alone"));
}

TEST_CASE("fractions that no number of inclusions comes near are refused") {
  refused(kCube, {ordered(ShapeKind::cylinder, 9, 0.5), ordered(ShapeKind::sphere, 9, 0.5)},
          "fraction = 0.5; it makes the fractions sum to 1");
  InclusionGroup large = beads_of_radius(0.3);
  large.fraction = 0.05;
  refused(kCube, {large},
          "it is less than half an inclusion; allowed with diameter 0.6 are fractions >= 0.0565");
}

TEST_CASE("no more inclusions are drawn than a limit for all groups together allows") {
  const InclusionLimit limit{1000, 0.0};
  const auto message_of = [&](const std::vector<InclusionGroup>& groups) {
    try {
      return std::to_string(draw_inclusions(kCube, groups, 1, limit).bodies.size());
    } catch (const InvalidGroup& problem) {
      return std::string(problem.what());
    }
  };
  CHECK(message_of({ordered(ShapeKind::sphere, 400, 0.1), ordered(ShapeKind::sphere, 600, 0.1)}) ==
        "1000");
  CHECK(message_of({ordered(ShapeKind::sphere, 400, 0.1), ordered(ShapeKind::sphere, 601, 0.1)}) ==
        "group 'beads': count = 601; allowed are 1000 in all");
  const double ball = 4.0 / 3.0 * std::numbers::pi * 0.01 * 0.01 * 0.01;
  InclusionGroup beads = beads_of_radius(0.01);
  beads.fraction = 1000.2 * ball;
  CHECK(message_of({beads}) == "1000");
  beads.fraction = 1001.2 * ball;
  CHECK_THAT(message_of({beads}), Catch::Contains("takes some 1e+03 inclusions of this size; all"));
  beads.fraction = 900.2 * ball;
  CHECK(message_of({ordered(ShapeKind::sphere, 100, 0.1), beads}) == "1000");
  CHECK_THAT(message_of({ordered(ShapeKind::sphere, 101, 0.1), beads}), Catch::Contains("in all"));
  beads.size.law = UniformLaw{0.009, 0.011};
  beads.fraction = 0.9;
  CHECK_THAT(message_of({beads}), Catch::Contains("inclusions of this size; allowed are 1000"));
  CHECK(InclusionLimit{1000, 2e6}.why_not(3000) ==
        "that needs some 6 GB of memory, this machine has 2 GB; allowed are 1000 in all");
}

TEST_CASE("what is refused says whose it is and which field") {
  InclusionGroup group = ordered(ShapeKind::sphere, 5, 1.2);
  try {
    static_cast<void>(draw_inclusions(kCube, {ordered(ShapeKind::sphere, 5, 0.1), group}, 1));
    FAIL("accepted");
  } catch (const InvalidGroup& problem) {
    CHECK(problem.group() == 1);
    CHECK(problem.field() == GroupField::fraction);
    CHECK(problem.why() == "allowed are fractions > 0 and < 1");
    CHECK(std::string(problem.what()) == "group 'beads': fraction = 1.2; " + problem.why());
  }
  CHECK(std::string(InvalidGroup("", 2, GroupField::size, "", "why").what()) == "group 2: why");
}

}  // namespace
}  // namespace packstone
