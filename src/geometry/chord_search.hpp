#pragma once

/// @file
/// The greatest g over all directions, proven, where local search cannot tell one maximum from
/// another.
///
/// With both supports replaced by quadratic minorants (support_chords.hpp), -g is bounded from
/// below by a quadratic function of d, whose least value on the whole sphere is known
/// (quadratic_on_sphere.hpp). Boxes of the two parameters are split, the worst first, until none
/// promises more than what was found. Directions that tie, even along a whole curve, share one box,
/// so that some tens of boxes do where caps on the sphere would need millions.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

#include "geometry/support_chords.hpp"

namespace packstone {

/// A is the first core, B the second. `Judge` keeps the best direction:
///
///     double g() const;                   greatest g known
///     const Vec3& direction() const;      where
///     void look(const Vec3& d);           may improve both
///     bool covers(const Vec3& d, double distance);
///                                         is g proven no greater there (within the tolerance)?
template <class A, class B>
class ChordSearch {
 public:
  ChordSearch(const SupportChords<A>& a, const SupportChords<B>& b, const Vec3& r)
      : a_(a), b_(b), r_(r), size_(a.size() + b.size()) {}

  /// For rods with nearly parallel axes.
  void set_parallel_sides(const ParallelSides& sides) { sides_ = sides; }

  /// An upper bound on g, rounding included: `tolerance` [L] above judge.g(), unless the budget
  /// ends.
  template <class Judge>
  double upper_bound(Judge& judge, double tolerance) {
    double proven = -std::numeric_limits<double>::infinity();
    std::size_t count = 0;
    const auto add = [&](Box box) {
      measure(box, judge, tolerance);
      const double limit = judge.g() + tolerance;
      if (box.bound > limit && rules_out(box, judge)) {
        proven = std::max(proven, limit);
      } else if (box.bound <= limit || count == kCapacity) {
        proven = std::max(proven, box.bound + box.roundoff);
      } else {
        heap_[count++] = box;
        std::push_heap(heap_.begin(), heap_.begin() + count);
      }
    };
    add({.of = {a_.range(), b_.range()}});
    for (int split = 0; count > 0; ++split) {
      std::pop_heap(heap_.begin(), heap_.begin() + count);
      const Box top = heap_[--count];
      const int k = loosest(top);
      if (top.bound <= judge.g() + tolerance || split == kBudget || k < 0) {
        return std::max(proven, top.bound + top.roundoff);
      }
      Box lower = top, upper = top;
      lower.of[k].high = upper.of[k].low = split_point(top, k);
      add(lower);
      add(upper);
    }
    return proven;
  }

 private:
  static constexpr std::size_t kCapacity = 512;
  static constexpr int kBudget = 2000;

  struct Box {
    std::array<Interval, 2> of;
    double bound = std::numeric_limits<double>::infinity();  // on g, as evaluated
    double roundoff = 0.0;
    Vec3 at{};  // where the bound is attained
    double stiffness = 0.0;
    std::array<double, 2> loose{};  // how far each minorant is off there

    friend bool operator<(const Box& x, const Box& y) { return x.bound < y.bound; }
  };

  bool holds(const Box& box, const Vec3& d) const {
    const double a = a_.parameter(d), b = b_.parameter(d);
    return box.of[0].low <= a && a <= box.of[0].high && box.of[1].low <= b && b <= box.of[1].high;
  }

  // Bounds g over the box. Planes under kinks may let the minimum stray out of the box: penalties
  // bring it back, at a price.
  template <class Judge>
  void measure(Box& box, Judge& judge, double tolerance) const {
    const Vec3 tight = holds(box, judge.direction()) ? judge.direction() : box.at;
    std::array<double, 2> hold{};
    box.bound = std::numeric_limits<double>::infinity();
    for (const double weight : {0.1, 1.0, 10.0, 100.0}) {
      const Box trial = measured(box, tight, hold);
      if (trial.bound < box.bound) box = trial;
      if (box.bound <= judge.g() + tolerance) return;
      judge.look(trial.at);
      const int a = a_.strays(box.of[0], trial.at), b = b_.strays(box.of[1], trial.at);
      if (a == 0 && b == 0) return;
      if (a != 0) hold[0] = a * weight * size_;
      if (b != 0) hold[1] = b * weight * size_;
    }
  }

  Box measured(const Box& box, const Vec3& tight, const std::array<double, 2>& hold) const {
    const SidePlane* planes = side_planes(box);
    const SphereQuadratic offset{{}, r_, 0.0};
    const SphereQuadratic a =
        a_.minorant(box.of[0], {offset, tight, hold[0], planes ? &planes[0] : nullptr});
    const SphereQuadratic b =
        b_.minorant(box.of[1], {offset + a, tight, hold[1], planes ? &planes[1] : nullptr});
    const LeastOnSphere least = least_on_sphere(offset + a + b);
    return {
        .of = box.of,
        .bound = -least.bound,
        .roundoff = least.roundoff + 4 * kUnitRoundoff * size_,
        .at = least.at,
        .stiffness = least.stiffness,
        .loose = {a_.support(least.at) - a.at(least.at), b_.support(least.at) - b.at(least.at)}};
  }

  const SidePlane* side_planes([[maybe_unused]] const Box& box) const {
    if constexpr (std::is_base_of_v<RodChords, SupportChords<A>>) {
      if (!sides_) return nullptr;
      const bool both = a_.at_side(box.of[0]) && b_.at_side(box.of[1]);
      return both ? sides_->together : sides_->alone;
    }
    return nullptr;
  }

  // By equation (2) of quadratic_on_sphere.hpp, all that can beat the best direction is near `at`.
  template <class Judge>
  bool rules_out(const Box& box, Judge& judge) const {
    const double excess = box.bound + box.roundoff - judge.g();
    return judge.covers(box.at, std::sqrt(2.0 * excess / box.stiffness));
  }

  // The one whose minorant is off by more, of those that can be split; -1: none.
  int loosest(const Box& box) const {
    const bool a = can_split(a_, box.of[0]), b = can_split(b_, box.of[1]);
    if (a && b) return box.loose[0] > box.loose[1] ? 0 : 1;
    return a ? 0 : b ? 1 : -1;
  }
  template <class Chords>
  bool can_split(const Chords& chords, const Interval& i) const {
    // Parallel sides are as tight as they get.
    if constexpr (std::is_base_of_v<RodChords, Chords>) {
      if (sides_ && chords.at_side(i) && i.high <= RodChords::kNarrowest) return false;
    }
    return chords.can_split(i);
  }

  // Where the bound is attained, so that both halves are tight there, but not next to an end.
  double split_point(const Box& box, int k) const {
    const Interval& i = box.of[k];
    const double edge = 0.15 * (i.high - i.low);
    const double there = k == 0 ? a_.parameter(box.at) : b_.parameter(box.at);
    return std::clamp(there, i.low + edge, i.high - edge);
  }

  SupportChords<A> a_;
  SupportChords<B> b_;
  Vec3 r_;
  double size_;
  std::optional<ParallelSides> sides_;
  std::array<Box, kCapacity> heap_;
};

}  // namespace packstone
