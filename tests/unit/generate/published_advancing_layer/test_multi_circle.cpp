#include "generate/published_advancing_layer/multi_circle.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

namespace packstone::published_layer {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGap = 1e-10;

bool lies_on(const ContactArc& arc, const Vec2& p) {
  const Vec2 d = p - arc.center;
  return std::abs(norm(d) - arc.reach) < 1e-9 && dot(d, arc.middle) >= arc.reach * arc.cos_half;
}

double depth_of(const MultiCircle& fixed, const MultiCircle& moving, const Vec2& p,
                const CirclePair& pair) {
  const Circle& a = fixed.circles()[pair.fixed];
  const Circle& b = moving.circles()[pair.moving];
  return a.radius + b.radius - norm(p + b.offset - a.offset);
}

const std::vector<MultiCircle>& zoo() {
  static const std::vector<MultiCircle> shapes{
      MultiCircle(0.7),
      MultiCircle(Disk{1.2}, 0.5),
      MultiCircle(Ellipse{{1.5, 1.0}, 0.3}, 1.0),
      MultiCircle(Ellipse{{2.0, 1.0}, -1.2}, 0.5),
      MultiCircle(Ellipse{{4.0, 1.0}, 2.9}, 0.5),
      MultiCircle(Ellipse{{0.8, 1.6}, 0.4}, 0.25),
  };
  return shapes;
}

}  // namespace

TEST_CASE("MultiCircle: the normals of the outline cover all directions") {
  for (const MultiCircle& shape : zoo()) {
    for (double t = -kPi; t < kPi; t += 0.01) {
      CHECK(std::any_of(shape.outline().begin(), shape.outline().end(), [&](const OutlineArc& arc) {
        return std::abs(std::remainder(t - arc.middle, 2.0 * kPi)) <= arc.half + 1e-12;
      }));
    }
  }
}

TEST_CASE("MultiCircle: rectangle, smallest circle and longer axis are those of the ellipse") {
  const MultiCircle shape(Ellipse{{2.0, 1.0}, 0.0}, 0.1);
  CHECK(shape.half().x == Approx(2.0).epsilon(1e-12));
  CHECK(shape.half().y == Approx(1.0).epsilon(1e-12));
  CHECK(shape.smallest_radius() == Approx(0.5).epsilon(1e-12));
  CHECK(shape.semi_axis() == Approx(2.0).epsilon(1e-12));
  CHECK(shape.central().radius == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("contact_arcs holds every position in contact that overlaps nowhere") {
  int found = 0;
  for (const MultiCircle& fixed : zoo()) {
    for (const MultiCircle& moving : zoo()) {
      std::vector<ContactArc> arcs;
      contact_arcs(fixed, moving, kGap, arcs);
      for (const Circle& a : fixed.circles()) {
        for (const Circle& b : moving.circles()) {
          for (double t = 0.0; t < 2.0 * kPi; t += 0.05) {
            const double reach = a.radius + b.radius + kGap;
            const Vec2 p = a.offset - b.offset + reach * Vec2{std::cos(t), std::sin(t)};
            if (circles_overlap(fixed, moving, p, kGap)) continue;
            ++found;
            CHECK(std::any_of(arcs.begin(), arcs.end(),
                              [&](const ContactArc& arc) { return lies_on(arc, p); }));
          }
        }
      }
    }
  }
  CHECK(found > 3000);
}

TEST_CASE("deepest_pair ends where no neighbor along either axis is deeper") {
  for (const MultiCircle& fixed : zoo()) {
    for (const MultiCircle& moving : zoo()) {
      for (double t = 0.0; t < 2.0 * kPi; t += 0.3) {
        const Vec2 p = 1.5 * Vec2{std::cos(t), std::sin(t)};
        const CirclePair pair = deepest_pair(fixed, moving, p, {0, 0});
        const double depth = depth_of(fixed, moving, p, pair);
        CHECK(depth >= depth_of(fixed, moving, p, {0, 0}));
        for (std::size_t i = 0; i < fixed.circles().size(); ++i) {
          CHECK(depth >= depth_of(fixed, moving, p, {i, pair.moving}));
        }
        for (std::size_t j = 0; j < moving.circles().size(); ++j) {
          CHECK(depth >= depth_of(fixed, moving, p, {pair.fixed, j}));
        }
      }
    }
  }
}

}  // namespace packstone::published_layer
