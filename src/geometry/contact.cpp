#include "packstone/geometry/contact.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

#include "geometry/convex_contact.hpp"
#include "geometry/proof.hpp"
#include "packstone/geometry/cylinder_contact.hpp"
#include "packstone/geometry/ellipse_contact.hpp"
#include "packstone/geometry/ellipsoid_contact.hpp"
#include "packstone/geometry/sphere_contact.hpp"

// How a pair gets a kernel of its own: declare, in a header of its own in namespace packstone, any
// of
//
//     Decision decide(const X&, const Y&, const Vec3& r_ab, double min_gap) noexcept;
//     Gap gap(const X&, const Y&, const Vec3& r_ab) noexcept;
//     ContactScale contact_scale(const X&, const Y&, const Vec3& r_ab) noexcept;
//     double quick_gap_bound(const X&, const Y&, const Vec3& r_ab) noexcept;
//
// with X before Y in the order of Body, and include that header here. It is found by its exact
// signature; the swapped pair and all other pairs need nothing.

namespace packstone {
namespace {

template <class X, class Y>
concept HasDecide = requires {
  static_cast<Decision (*)(const X&, const Y&, const Vec3&, double) noexcept>(&packstone::decide);
};
template <class X, class Y>
concept HasGap = requires {
  static_cast<Gap (*)(const X&, const Y&, const Vec3&) noexcept>(&packstone::gap);
};
template <class X, class Y>
concept HasContactScale = requires {
  static_cast<ContactScale (*)(const X&, const Y&, const Vec3&) noexcept>(
      &packstone::contact_scale);
};
template <class X, class Y>
concept HasQuickGapBound = requires {
  static_cast<double (*)(const X&, const Y&, const Vec3&) noexcept>(&packstone::quick_gap_bound);
};

template <class X>
inline constexpr int kDimension = convex::kPlanar<X> ? 2 : 3;

template <class X>
inline constexpr std::size_t kIndex = Body(std::in_place_type<X>).index();

template <class X, class Y>
Decision decide_pair(const X& a, const Y& b, const Vec3& r, double min_gap) noexcept {
  if constexpr (kIndex < X >> kIndex<Y>) {
    Decision decision = decide_pair(b, a, -r, min_gap);
    const bool point = decision.verdict == Verdict::overlapping && min_gap == 0.0;
    decision.witness = point ? decision.witness + r : -decision.witness;
    if (point && !in_both(a, b, r, decision.witness)) decision.verdict = Verdict::undecided;
    return decision;
  } else if constexpr (HasDecide<X, Y>) {
    return decide(a, b, r, min_gap);
  } else {
    return convex::decide(a, b, r, min_gap);
  }
}

template <class X, class Y>
Gap gap_pair(const X& a, const Y& b, const Vec3& r) noexcept {
  if constexpr (kIndex < X >> kIndex<Y>) {
    const Gap swapped = gap_pair(b, a, -r);
    return {swapped.value, swapped.error, -swapped.normal, swapped.point_b + r,
            swapped.point_a + r};
  } else if constexpr (HasGap<X, Y>) {
    return gap(a, b, r);
  } else {
    return convex::gap(a, b, r);
  }
}

template <class X, class Y>
ContactScale contact_scale_pair(const X& a, const Y& b, const Vec3& r) noexcept {
  if constexpr (kIndex < X >> kIndex<Y>) {
    return contact_scale_pair(b, a, -r);
  } else if constexpr (HasContactScale<X, Y>) {
    return contact_scale(a, b, r);
  } else {
    return convex::contact_scale(a, b, r);
  }
}

template <class X, class Y>
double quick_gap_bound_pair(const X& a, const Y& b, const Vec3& r) noexcept {
  if constexpr (kIndex < X >> kIndex<Y>) {
    return quick_gap_bound_pair(b, a, -r);
  } else if constexpr (HasQuickGapBound<X, Y>) {
    return quick_gap_bound(a, b, r);
  } else {
    return convex::quick_gap_bound(a, b, r);
  }
}

// Calls `kernel` with the concrete bodies; pairs of two dimensions get `fallback`.
template <class Result, class Kernel>
Result visit_pair(const Body& a, const Body& b, const Result& fallback, Kernel&& kernel) {
  return std::visit(
      [&](const auto& x, const auto& y) -> Result {
        if constexpr (kDimension<std::decay_t<decltype(x)>> ==
                      kDimension<std::decay_t<decltype(y)>>) {
          return kernel(x, y);
        } else {
          return fallback;
        }
      },
      a, b);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

Decision decide(const Body& a, const Body& b, const Vec3& r_ab, double min_gap) noexcept {
  return visit_pair(a, b, Decision{},
                    [&](const auto& x, const auto& y) { return decide_pair(x, y, r_ab, min_gap); });
}

Verdict overlap(const Body& a, const Body& b, const Vec3& r_ab, double min_gap) noexcept {
  return decide(a, b, r_ab, min_gap).verdict;
}

Gap gap(const Body& a, const Body& b, const Vec3& r_ab) noexcept {
  return visit_pair(a, b, Gap{0.0, kInfinity, {}, {}, {}},
                    [&](const auto& x, const auto& y) { return gap_pair(x, y, r_ab); });
}

ContactScale contact_scale(const Body& a, const Body& b, const Vec3& r_ab) noexcept {
  return visit_pair(a, b, ContactScale{0.0, kInfinity},
                    [&](const auto& x, const auto& y) { return contact_scale_pair(x, y, r_ab); });
}

double proven_gap(const Body& a, const Body& b, const Vec3& r_ab, const Vec3& d) noexcept {
  return visit_pair(a, b, -kInfinity,
                    [&](const auto& x, const auto& y) { return proven_gap_along(x, y, r_ab, d); });
}

double quick_gap_bound(const Body& a, const Body& b, const Vec3& r_ab) noexcept {
  return visit_pair(a, b, -kInfinity,
                    [&](const auto& x, const auto& y) { return quick_gap_bound_pair(x, y, r_ab); });
}

}  // namespace packstone
