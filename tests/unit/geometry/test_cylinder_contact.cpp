#include "packstone/geometry/cylinder_contact.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/convex_contact.hpp"
#include "support/each_pair.hpp"

using namespace packstone;
using zoo::Pair;
using zoo::PairClass;
using zoo::Zoo;

namespace {

template <class A, class B>
void compare_with_general(ShapeKind kind_a, ShapeKind kind_b) {
  zoo::for_each_pair(kind_a, kind_b, 600, 500, [](const Pair& p, PairClass, int) {
    const A& a = std::get<A>(p.a);
    const B& b = std::get<B>(p.b);
    const Verdict staged = decide(a, b, p.r, 0.0).verdict;
    const Verdict general = convex::decide(a, b, p.r, 0.0).verdict;
    const bool open = staged == Verdict::undecided || general == Verdict::undecided;
    REQUIRE((open || staged == general));
  });
}

}  // namespace

TEST_CASE("the staged decision agrees with the general one") {
  compare_with_general<Cylinder, Cylinder>(ShapeKind::cylinder, ShapeKind::cylinder);
  compare_with_general<Cylinder, Spherocylinder>(ShapeKind::cylinder, ShapeKind::spherocylinder);
}

TEST_CASE("cylinders next to touching that tests of their disks misjudge") {
  const auto verdict = [](double h, const Vec3& u, const Vec3& v, const Vec3& r) {
    return overlap(Cylinder{1, h, normalized(u)}, Cylinder{1, h, normalized(v)}, r);
  };
  CHECK(verdict(1, {0.428607, -0.254466, 0.866916}, {-0.890828, -0.321235, -0.321299},
                {1.950255, -1.653134, 1.065143}) == Verdict::overlapping);
  CHECK(verdict(1, {0.550595, 0.298415, -0.779611}, {0.264453, -0.158299, -0.951318},
                {0.876497, 1.011033, -2.052850}) == Verdict::separated);
  CHECK(verdict(100, {-0.927551, 0.013689, 0.373445}, {-0.554136, 0.020764, 0.832167},
                {-160.235735, 4.267626, 125.541985}) == Verdict::separated);
  CHECK(verdict(5, {-0.864532, -0.489271, 0.114883}, {-0.130246, -0.843392, -0.521273},
                {2.661783, 5.157300, 4.124896}) == Verdict::overlapping);
}

TEST_CASE("the sign of an axis means nothing, and a longer or thicker cylinder overlaps no less") {
  Zoo zoo(7);
  for (int k = 0; k < 2000; ++k) {
    const Pair p = zoo.pair(ShapeKind::cylinder, ShapeKind::cylinder, PairClass::near);
    Cylinder a = std::get<Cylinder>(p.a);
    const Verdict verdict = overlap(a, p.b, p.r);
    a.axis = -a.axis;
    CHECK(overlap(a, p.b, p.r) == verdict);
    a.half_length *= 1.1;
    a.radius *= 1.1;
    if (verdict == Verdict::overlapping) CHECK(overlap(a, p.b, p.r) == Verdict::overlapping);
  }
}

TEST_CASE("parallel cylinders overlap by the lesser of side and end") {
  const Cylinder a{1, 2, {0, 0, 1}}, b{0.5, 3, {0, 0, -1}};
  CHECK(gap(Body(a), Body(b), {}).value == Approx(-1.5));
  CHECK(gap(Body(a), Body(b), {0, 0, 4.9}).value == Approx(-0.1));
  CHECK(gap(Body(a), Body(b), {1.4, 0, 4.0}).value == Approx(-0.1));
  CHECK(gap(Body(a), Body(b), {1.8, 0, 5.4}).value == Approx(0.5));
}
