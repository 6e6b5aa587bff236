#include "generate/event_driven/plane_search.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "generate/event_driven/contact_gap.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "support/each_pair.hpp"
#include "support/oracle.hpp"
#include "support/posed_pair.hpp"

namespace packstone::event_driven {
namespace {

using zoo::gap_along;
using zoo::posed_pair;
using zoo::PosedPair;

Vec3 random_normal(const Body& body, zoo::Zoo& zoo) {
  return zoo.log_uniform(0.01, 100) * zoo.direction(dimension(kind(body)));
}

bool smooth(const PosedPair& p) { return is_ellipsoid(p.a.form) && is_ellipsoid(p.b.form); }

}  // namespace

TEST_CASE("the support of a posed body is that of the body") {
  zoo::Zoo zoo(1);
  for (int k = 0; k < 6; ++k) {
    for (int trial = 0; trial < 200; ++trial) {
      const Body body = zoo.body(static_cast<ShapeKind>(k), 1.0);
      const double factor = zoo.log_uniform(1e-3, 10.0);
      const PosedBody posed = posed_pair({body, body, {}}, factor).a;
      const Vec3 n = random_normal(body, zoo);
      const auto truth = oracle::support(scaled(body, factor), n);
      // Rounding of the largest of the terms, see kSupportRoundoff.
      const long double slack = 4e-15L * factor * circum_radius(body) * norm(n);
      CHECK(std::abs(support(posed, n) - truth) <= slack);
    }
  }
}

TEST_CASE("the best plane between bodies that nearly touch shows the gap") {
  zoo::for_each_pair(3, 30, [](const zoo::Pair& drawn, zoo::PairClass, int k) {
    const double reach = zoo::size_of(drawn);
    const double wanted = k < 10 ? 1e-12 : k < 20 ? 1e-9 : 1e-7;
    const zoo::Pair pair = zoo::moved_apart(drawn, wanted * reach);
    const Gap truth = gap(pair.a, pair.b, pair.r);
    if (truth.value > 2.0 * wanted * reach) return;
    const PosedPair p = posed_pair(pair);
    const Vec3 normal = find_plane(p.a, p.b, pair.r, 0.0, {}, Effort::touch);
    const double shown = gap_along(p, pair.r, normal);
    REQUIRE(shown <= truth.value + truth.error + 1e-14 * reach);
    // Between ellipsoids it is the plane that separates them scaled by most, which the one of the
    // gap becomes as the gap goes to 0. Next to edges it is found well enough to see a contact.
    const double off = smooth(p) ? 0.9 * wanted + 1e-12 : 0.5 * kGeneralContactGap;
    REQUIRE(shown >= truth.value - truth.error - off * reach);
  });
}

TEST_CASE("one step from any plane makes a plane that separates no more than there is") {
  zoo::Zoo zoo(4);
  zoo::for_each_pair(4, 20, [&](const zoo::Pair& drawn, zoo::PairClass, int) {
    const zoo::Pair pair = zoo::moved_apart(drawn, 1e-3 * zoo::size_of(drawn));
    const PosedPair p = posed_pair(pair);
    const Gap truth = gap(pair.a, pair.b, pair.r);
    Vec3 known;
    for (int step = 0; step < 6; ++step) {
      known = find_plane(p.a, p.b, pair.r, 0.0, known, Effort::step);
      REQUIRE(norm_sq(known) > 0.0);
      const double shown = gap_along(p, pair.r, known);
      REQUIRE(shown <= truth.value + truth.error + 1e-14 * (zoo::size_of(pair) + norm(pair.r)));
    }
  });
}

TEST_CASE("a few steps of the plane prove bodies apart that are a thousandth of their size apart") {
  int apart = 0, pairs = 0;
  zoo::for_each_pair(5, 20, [&](const zoo::Pair& drawn, zoo::PairClass, int) {
    const zoo::Pair pair = zoo::moved_apart(drawn, 1e-3 * zoo::size_of(drawn));
    const PosedPair p = posed_pair(pair);
    Vec3 known;
    for (int step = 0; step < 8; ++step) {
      known = find_plane(p.a, p.b, pair.r, 0.0, known, Effort::step);
    }
    ++pairs;
    apart += gap_along(p, pair.r, known) > 0.0;
  });
  CHECK(apart >= 0.99 * pairs);
}

TEST_CASE("the bound on the gap is never above the gap, and the gap itself of balls") {
  zoo::for_each_pair(6, 60, [](const zoo::Pair& pair, zoo::PairClass pair_class, int) {
    if (norm_sq(pair.r) == 0.0) return;
    const PosedPair p = posed_pair(pair);
    const Gap truth = gap(pair.a, pair.b, pair.r);
    const double bound = gap_bound(p.a, p.b, pair.r);
    const double slack = truth.error + 1e-14 * (zoo::size_of(pair) + norm(pair.r));
    CHECK(bound <= truth.value + slack);
    if (is_round(kind(pair.a)) && is_round(kind(pair.b))) CHECK(bound >= truth.value - slack);
    if (pair_class == zoo::PairClass::far) CHECK(bound >= 0.0);
  });
}

}  // namespace packstone::event_driven
