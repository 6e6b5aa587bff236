#pragma once

/// @file
/// Half-spaces that together hold all that is free of a box: is anything left?

#include <array>
#include <cmath>
#include <cstddef>

#include "generate/rsa/outline.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::rsa {

/// A half-space: the points x with dot(away, x) >= least.
struct Cut {
  Vec3 away;           ///< To the origin from the point of the set next to it [L].
  double distance_sq;  ///< Of the set from the origin [L^2].
  double least;        ///< [L^2]
};

/// The half-space that holds all points within `blur` of the origin to which a body keeps more than
/// a distance.
///
/// A point x is no farther from the set than from the point of the set that is nearest to the
/// origin, D(x) <= |away + x|. So D(x) > range asks for
///
///     2 dot(away, x) >= range^2 - |away|^2 - blur^2,
///
/// which for balls is sharp where |x| = blur.
///
/// @param body   Its ends not loose; the set is the cylinder, or the segment of a capsule.
/// @param p      The origin as seen from the center of the body.
/// @param range  The distance to keep from the set [L].
[[nodiscard]] Cut cut_by(const Outline& body, const Vec3& p, double range, double blur_sq) noexcept;

/// What free points of a box about the origin have in common.
class BoxCuts {
 public:
  /// @param half  Half edges of the box; 0 along an axis that does not count.
  explicit BoxCuts(const Vec3& half) noexcept : half_(half), blur_sq_(norm_sq(half)) {}

  /// The largest dot(cut.away, x) in the box.
  [[nodiscard]] double reach(const Cut& cut) const noexcept { return norm1(scaled(cut)); }

  /// How a body meets the box.
  enum class Meeting {
    covers,   ///< It comes within the range of every point.
    middle,   ///< Of the middle.
    near,     ///< Maybe of some point.
    nowhere,  ///< Of none.
  };

  /// Looks at a body and takes notice of where it leaves room. Arguments as of cut_by().
  Meeting look_at(const Outline& body, const Vec3& p, double range) noexcept;

  /// Adds a half-space that holds all free points. Those that come when kMost are there are
  /// ignored, which proves less.
  void add(const Cut& cut) noexcept {
    if (count_ == kMost) return;
    const Vec3 normal = scaled(cut);
    cuts_[count_++] = {normal.x, normal.y, normal.z, cut.least,
                       cut.least - kTolerance * norm1(normal)};
    if (cut.least > 0.0) leaves_middle_ = false;
  }

  /// Does the middle of the box lie in all half-spaces? Then leave_nothing() is quick to say no.
  [[nodiscard]] bool leave_middle() const noexcept { return leaves_middle_; }

  /// Is it proven that the half-spaces have no point of the box in common?
  ///
  /// For any weights w >= 0 a common point x has sum w_i dot(away_i, x) >= sum w_i least_i, so
  /// there is none if the right side exceeds the largest value of the left side in the box. The
  /// weights come from the dual simplex method; if it errs they prove nothing, but never something
  /// wrong.
  [[nodiscard]] bool leave_nothing() const noexcept;

 private:
  static constexpr std::size_t kMost = 24;
  // A point so little outside counts as inside, lest rounding sends the method round in circles.
  static constexpr double kTolerance = 1e-9;
  // In units of the half edges: the box is the cube [-1, 1]^3.
  struct Plane {
    double x, y, z;  // Its normal; no Vec3, as all would be set to zero for every box.
    double least;
    double asked;  // Less than that by what rounding may miss.
    [[nodiscard]] Vec3 normal() const noexcept { return {x, y, z}; }
  };
  struct Vertex;

  [[nodiscard]] static double norm1(const Vec3& v) noexcept {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
  }
  [[nodiscard]] Vec3 scaled(const Cut& cut) const noexcept {
    return {cut.away.x * half_.x, cut.away.y * half_.y, cut.away.z * half_.z};
  }

  [[nodiscard]] bool most_violated(const Vec3& y, Plane& plane, bool& is_face) const noexcept;

  Vec3 half_;
  double blur_sq_;
  std::array<Plane, kMost> cuts_;
  std::size_t count_ = 0;
  bool leaves_middle_ = true;
};

}  // namespace packstone::rsa
