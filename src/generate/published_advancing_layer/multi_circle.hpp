#pragma once

/// @file
/// A body in the plane as circles, and where two such bodies may touch.

#include <vector>

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone::published_layer {

/// A circle of a body.
struct Circle {
  Vec2 offset{};  ///< From the center of the body [L].
  double radius = 0.0;
};

/// A part of the outline of a body, on one of its circles. The normals of all parts together turn
/// once; at the valleys between circles those of two parts overlap.
struct OutlineArc {
  std::size_t circle = 0;
  double middle = 0.0;  ///< Direction of the middle normal [rad], in (-pi, pi].
  double half = 0.0;    ///< Largest angle of a normal to it [rad].
};

/// A disk or an ellipse, turned, as circles on its longer axis.
class MultiCircle {
 public:
  /// @param spacing  Of inscribed_balls().
  MultiCircle(const Body& body, double spacing);
  /// A disk.
  explicit MultiCircle(double radius);

  [[nodiscard]] const std::vector<Circle>& circles() const { return circles_; }
  [[nodiscard]] const std::vector<OutlineArc>& outline() const { return outline_; }
  /// The one in the middle, the largest.
  [[nodiscard]] const Circle& central() const { return circles_[circles_.size() / 2]; }
  /// Half edges of the rectangle about all circles: the rectangular cell of the paper [L].
  [[nodiscard]] const Vec2& half() const { return half_; }
  [[nodiscard]] double smallest_radius() const { return circles_.front().radius; }
  /// Half the longer axis of the body [L].
  [[nodiscard]] double semi_axis() const { return semi_axis_; }

 private:
  void set_half();
  void set_outline(double axis);

  std::vector<Circle> circles_;
  std::vector<OutlineArc> outline_;
  Vec2 half_;
  double semi_axis_;
};

/// A part of the curve on which the center of one body moves about another that it touches: about a
/// center, relative to that of the other body.
struct ContactArc {
  Vec2 center;
  double reach = 0.0;      ///< Radius: that of both circles and the gap that contacts keep [L].
  Vec2 middle;             ///< Unit.
  double cos_half = -1.0;  ///< Of the largest angle to it.
};

/// All parts of that curve, and some that lie within it, by circles that are not the nearest ones.
/// @param contact_gap  That circles in contact keep [L].
/// @param arcs         What they are written to.
void contact_arcs(const MultiCircle& fixed, const MultiCircle& moving, double contact_gap,
                  std::vector<ContactArc>& arcs);

/// A circle of one body and one of another.
struct CirclePair {
  std::size_t fixed = 0;
  std::size_t moving = 0;
};

/// The pair that bars the center of the moving body from `p`, relative to that of the fixed one,
/// most deeply, whose circles, there, overlap most, or one nearly as deep: goes from `start` to
/// neighbors along either axis as long as these are deeper. Depth is concave along both.
[[nodiscard]] CirclePair deepest_pair(const MultiCircle& fixed, const MultiCircle& moving,
                                      const Vec2& p, CirclePair start);

/// Does a circle of one come nearer to one of the other than contacts do? `r`: from the center of a
/// to that of b.
[[nodiscard]] bool circles_overlap(const MultiCircle& a, const MultiCircle& b, const Vec2& r,
                                   double contact_gap);

}  // namespace packstone::published_layer
