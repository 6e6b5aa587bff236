#pragma once

/// @file
/// A body as the union of balls that it holds: multi-circles of an ellipse, multi-spheres of the
/// bodies in space. Where a method knows only balls, these stand for the body.
///
/// Each ball touches the surface from inside in at least two points: the centers lie on the medial
/// axis. For an ellipse, half axes a > b along x and y (D. N. Ilin, M. Bernacki, MATEC Web Conf. 80
/// (2016) 02004, equations 5, 6, 8 and 9), the ball with center x touches at the abscissa x_t,
///
///     x_t = x a^2 / (a^2 - b^2)       r^2 = b^2 (1 - x^2 / (a^2 - b^2))                    (1)
///
/// up to the circle of curvature at the tip, r_N = b^2 / a at x_N = a - b^2 / a. Their equation 7
/// takes the step from one circle to the next in proportion to y; with y the ordinate of the point
/// of contact it telescopes to
///
///     x_0 = 0     x_(i+1) = min(x_i + spacing b sqrt(1 - x_i^2 / x_N^2), x_N)              (2)
///
/// An ellipsoid of semi-axes a >= b >= c has the medial ellipse of half axes x_N = a - c^2 / a,
/// y_N = b - c^2 / b in the plane of a and b,
///
///     r^2 = c^2 (1 - x^2 / (a^2 - c^2) - y^2 / (b^2 - c^2))                                (3)
///
/// which is the line of (1) where b = c. A cylinder has its axis (a disk, if it is short) and a
/// cone from each end of it to the rim, along which the balls shrink.

#include <vector>

#include "packstone/core/vec.hpp"
#include "packstone/geometry/body.hpp"

namespace packstone {

/// A ball inside a body; in 2D a circle.
struct InscribedBall {
  Vec3 center;          ///< Relative to the center of the body, in the cell frame [L]; z = 0 in 2D.
  double radius = 0.0;  ///< [L] > 0.

  friend constexpr bool operator==(const InscribedBall&, const InscribedBall&) = default;
};

/// Least and greatest spacing of inscribed_balls() [-].
inline constexpr double kLeastBallSpacing = 0.01;
inline constexpr double kMostBallSpacing = 1.0;

/// Balls inside `body` whose union approximates it.
///
/// One for a sphere or a disk (also for an ellipse or ellipsoid that is one). Along a line they
/// come in order, from one end to the other. The union of an ellipse of aspect 2 lacks 6.6 % of
/// the area at spacing 1, 1.7 % at 0.5, 0.39 % at 0.25. Of a cylinder the balls at the rim end at
/// a quarter of the largest one.
///
/// Properties: inside the body to 1e-14 of its size; the set is symmetric about the center; scales
/// with the body.
/// Errors:     throws InvalidArgument if `spacing` is not in [kLeastBallSpacing,
///             kMostBallSpacing].
/// Cost:       some pi x_N / (spacing b) balls along a line, the square of the like for flat
///             bodies.
///
/// @param body     Any shape that check_body() accepts.
/// @param spacing  Distance of the first two balls over the radius of the largest [-].
[[nodiscard]] std::vector<InscribedBall> inscribed_balls(const Body& body, double spacing);

}  // namespace packstone
