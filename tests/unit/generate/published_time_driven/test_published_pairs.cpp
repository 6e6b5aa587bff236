// Figures 15 to 29 of the paper: what becomes of typical pairs.

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <variant>

#include "packstone/generate/published_time_driven.hpp"
#include "packstone/geometry/contact.hpp"
#include "published_pairs.hpp"

namespace packstone {
namespace {

using Types = std::set<PublishedContact>;

constexpr Vec3 kMiddle{10, 10, 10};
const Cylinder kRod{1.0, 3.0, {0, 0, 1}};

// A pair before and after.
struct Outcome {
  Body a, b;
  Vec3 r;
  TimeDrivenResult result;

  Outcome(const Body& first, const Body& second, const Vec3& offset)
      : a(first), b(second), r(offset) {
    Packing packing;
    packing.cell.size = {20, 20, 20};
    packing.groups = {"all"};
    packing.inclusions = {{kMiddle, a}, {kMiddle + r, b}};
    result = published_time_driven_relax(packing);
  }
  explicit Outcome(int figure) : Outcome(scenes::published_pair(figure)) {}
  explicit Outcome(const scenes::PublishedPair& pair) : Outcome(pair.a, pair.b, pair.r_ab) {}

  [[nodiscard]] Vec3 moved(std::size_t k) const {
    return result.packing.inclusions[k].center - (k == 0 ? kMiddle : kMiddle + r);
  }
  // From the first axis to the last, as a rotation vector with its sine for a length.
  [[nodiscard]] Vec3 turn(std::size_t k) const {
    return cross(std::get<Cylinder>(k == 0 ? a : b).axis,
                 std::get<Cylinder>(result.packing.inclusions[k].body).axis);
  }
  [[nodiscard]] double last_gap() const {
    const auto& [first, second] =
        std::pair(result.packing.inclusions[0], result.packing.inclusions[1]);
    return gap(first.body, second.body, second.center - first.center).value;
  }
  // The method is content, and the bodies are apart up to its threshold.
  [[nodiscard]] bool apart() const {
    return result.stop == TimeDrivenStop::relaxed && last_gap() > -1e-5;
  }
};

bool opposite(const Vec3& a, const Vec3& b) { return norm(a + b) < 1e-9; }

Types types_of(const Body& a, const Body& b, const Vec3& r) {
  Types types;
  for (const auto& force : published_forces(a, b, r)) types.insert(force.type);
  return types;
}

Types types_of(int figure) {
  const scenes::PublishedPair& pair = scenes::published_pair(figure);
  return types_of(pair.a, pair.b, pair.r_ab);
}

TEST_CASE("figure 15: two spheres part along the line of their centers") {
  const Outcome pair(15);
  CHECK(pair.apart());
  CHECK(opposite(pair.moved(0), pair.moved(1)));
  CHECK(norm(cross(pair.moved(1), pair.r)) < 1e-9);
  CHECK(dot(pair.moved(1), pair.r) > 0.2);
}

TEST_CASE("figure 16: a sphere halfway along a cylinder pushes it aside and does not turn it") {
  CHECK(types_of(16) == Types{PublishedContact::sc2});
  const Outcome pair(16);
  CHECK(pair.apart());
  CHECK(opposite(pair.moved(0), pair.moved(1)));
  CHECK(pair.moved(1).x > 0.2);
  CHECK(norm(pair.turn(0)) < 1e-9);
}

TEST_CASE("figure 17: a sphere near the end of a cylinder turns this end away") {
  const Outcome pair(17);
  CHECK(pair.apart());
  CHECK(pair.moved(0).x < 0.0);
  CHECK(pair.moved(1).x > 0.0);
  // About -y: the upper end goes to -x, from where the sphere is.
  CHECK(pair.turn(0).y < -0.01);
}

TEST_CASE("figure 18: a sphere on the axis leaves through the base, by sc2 and then sc3") {
  CHECK(types_of(18) == Types{PublishedContact::sc2});
  CHECK(types_of(kRod, Sphere{1.0}, {0, 0, 3.5}) == Types{PublishedContact::sc3});
  const Outcome pair(18);
  CHECK(pair.apart());
  CHECK(opposite(pair.moved(0), pair.moved(1)));
  CHECK(pair.moved(1).z > 0.5);
  CHECK(std::hypot(pair.moved(1).x, pair.moved(1).y) < 1e-9);
  CHECK(norm(pair.turn(0)) < 1e-9);
}

TEST_CASE("figure 19: a sphere on the base, off the axis, leaves along it") {
  CHECK(types_of(19) == Types{PublishedContact::sc3});
  const Outcome pair(19);
  CHECK(pair.apart());
  CHECK(pair.moved(1).z > 0.2);
  // The end that is pushed down on the side of the sphere goes there.
  CHECK(pair.turn(0).y > 0.0);
}

TEST_CASE("figure 20: a sphere on the rim of the base leaves slantwise") {
  CHECK(types_of(20) == Types{PublishedContact::sc4});
  const Outcome pair(20);
  CHECK(pair.apart());
  CHECK(pair.moved(1).x > 0.02);
  CHECK(pair.moved(1).z > 0.02);
  CHECK(norm(pair.turn(0)) > 1e-3);
}

TEST_CASE("figure 21: two cylinders that cross at their middles part along their normal") {
  CHECK(types_of(21) == Types{PublishedContact::cc1});
  const Outcome pair(21);
  CHECK(pair.apart());
  CHECK(opposite(pair.moved(0), pair.moved(1)));
  CHECK(pair.moved(1).y > 0.2);
  CHECK(norm(pair.turn(0)) + norm(pair.turn(1)) < 1e-9);
}

TEST_CASE("figure 22: of two cylinders the one that is crossed off its middle turns") {
  const Outcome pair(22);
  CHECK(pair.apart());
  CHECK(pair.moved(1).y > 0.0);
  // About x: the upper end goes to -y.
  CHECK(pair.turn(0).x > 0.01);
  CHECK(norm(pair.turn(1)) < 1e-9);
}

TEST_CASE("figure 23: crossed off both middles, both turn") {
  const Outcome pair(23);
  CHECK(pair.apart());
  CHECK(pair.turn(0).x > 0.01);
  CHECK(norm(pair.turn(1)) == Approx(norm(pair.turn(0))).epsilon(0.1));
  // The end of the second that lies over the first goes to +y.
  CHECK(pair.turn(1).z < -0.01);
}

TEST_CASE(
    "figure 24: with axes in one plane a base that enters a face pushes it away in the plane") {
  CHECK(types_of(24).contains(PublishedContact::cd1));
  const Outcome pair(24);
  CHECK(pair.apart());
  CHECK(pair.moved(0).x < -0.05);
  CHECK(pair.moved(1).x > 0.05);
  for (const std::size_t k : {0U, 1U}) {
    CHECK(std::abs(pair.moved(k).y) < 1e-9);
    CHECK(std::hypot(pair.turn(k).x, pair.turn(k).z) < 1e-9);
  }
}

TEST_CASE("figure 25: with parallel axes cc1, cd2 and then cd1 act together, sideways") {
  CHECK(types_of(25) == Types{PublishedContact::cc1, PublishedContact::cd2});
  CHECK(types_of(kRod, kRod, {1.2, 0, 2}) == Types{PublishedContact::cc1, PublishedContact::cd1});
  const Outcome pair(25);
  CHECK(pair.apart());
  CHECK(pair.moved(0).x < -0.3);
  CHECK(pair.moved(1).x > 0.3);
}

TEST_CASE("figures 26 and 27: a base that enters a face beside its middle pushes and turns it") {
  for (const int figure : {26, 27}) {
    CHECK(types_of(figure) == Types{PublishedContact::cd1});
    const Outcome pair(figure);
    CHECK(pair.apart());
    CHECK(pair.moved(0).x < -0.02);
    CHECK(pair.moved(1).x > 0.02);
    CHECK(norm(pair.turn(0)) > 1e-3);
    CHECK(norm(pair.turn(1)) > 1e-3);
  }
}

TEST_CASE("figure 28: two bases whose rims cross part") {
  const Types types = types_of(28);
  CHECK((types.contains(PublishedContact::d1) || types.contains(PublishedContact::d2)));
  const Outcome pair(28);
  CHECK(pair.apart());
  CHECK(dot(pair.moved(1), pair.r) > 0.0);
  CHECK(dot(pair.moved(0), pair.r) < 0.0);
}

TEST_CASE("figure 29: cylinders whose axes cross part in their plane, by cc1, cd2 and cd1") {
  CHECK(types_of(29) == Types{PublishedContact::cc1});
  const Outcome pair(29);
  CHECK(pair.apart());
  CHECK(pair.moved(1).x > 0.5);
  CHECK(pair.moved(0).x < -0.5);
  CHECK(std::abs(pair.moved(0).y) < 1e-6);
}

// Nearly at right angles: the axis all but lies in the plane of the base, so that the rim point
// that Algorithm 3 looks at goes off to the side, and with it the overlap.
TEST_CASE("where Algorithm 3 looks beside the overlap, a pair stays as deep as it is") {
  const Cylinder crossing{1.0, 3.0, normalized(Vec3{-0.046, -0.999, -0.011})};
  const Outcome pair(kRod, crossing, {1.195, 3.141, 0.45});
  CHECK(pair.result.stop == TimeDrivenStop::relaxed);
  CHECK(pair.result.start_energy == 0.0);
  CHECK(pair.result.steps == 0);
  CHECK(pair.result.overlaps == 1);
  CHECK(pair.result.deepest == Approx(0.8).epsilon(0.01));
  CHECK(pair.last_gap() == Approx(-0.8).epsilon(0.01));
}

}  // namespace
}  // namespace packstone
