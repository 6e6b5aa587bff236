#pragma once

/// @file
/// How a ball rolls: equations (1) to (3) of drop_and_roll.hpp. In the plane z is 0 throughout.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "packstone/core/vec.hpp"

namespace packstone::rolling {

/// What the ball touches: one that stands, or a wall.
struct Contact {
  static constexpr std::int32_t kWall = -1;

  std::int32_t body = kWall;  ///< Number of the ball that stands.
  Vec3 center{};              ///< Of its image [L]; of a wall any point of the plane of centers.
  double reach = 0.0;         ///< Distance of the centers [L]; of a wall 0.
  Vec3 normal{};              ///< Unit, toward the ball that rolls.

  friend bool operator==(const Contact&, const Contact&) = default;
};

/// The contacts at one place, no more than rest in space needs.
class Contacts {
 public:
  static constexpr std::size_t kMost = 3;

  void clear() { count_ = 0; }
  void add(const Contact& contact) {
    if (count_ < kMost) contacts_[count_++] = contact;
  }
  void remove(std::size_t k) {
    for (--count_; k < count_; ++k) contacts_[k] = contacts_[k + 1];
  }
  /// Is this ball, in this image, among them?
  [[nodiscard]] bool holds(std::int32_t body, const Vec3& center) const {
    for (std::size_t k = 0; k < count_; ++k) {
      if (contacts_[k].body == body && contacts_[k].center == center) return true;
    }
    return false;
  }
  /// Is the wall with this normal?
  [[nodiscard]] bool holds_wall(const Vec3& inward) const {
    for (std::size_t k = 0; k < count_; ++k) {
      if (contacts_[k].body == Contact::kWall && contacts_[k].normal == inward) return true;
    }
    return false;
  }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] Contact& operator[](std::size_t k) { return contacts_[k]; }
  [[nodiscard]] const Contact& operator[](std::size_t k) const { return contacts_[k]; }

 private:
  std::array<Contact, kMost> contacts_{};
  std::size_t count_ = 0;
};

/// Leaves those contacts that carry the ball, by equations (3); `up` is -g / |g|.
/// @return  true where the ball rests. Without contacts it falls.
[[nodiscard]] bool settle(Contacts& contacts, const Vec3& up);

/// A place on a circle, by its angle from the uphill direction.
struct Angle {
  double cos = 1.0;
  double sin = 0.0;
};

/// The circle of equation (1), from where the ball is now to where a contact lets go of it.
struct Arc {
  Vec3 middle;
  double radius = 0.0;
  Vec3 uphill;
  Vec3 across;
  Angle now;
  double last_cos = 0.0;  ///< Cosine of the angle at which the contact `leaves` lets go.
  std::size_t leaves = 0;

  /// Does it begin at the top, from where both ways lead down alike?
  [[nodiscard]] bool begins_at_top() const { return std::abs(now.sin) < 1e-9 && now.cos > 0.0; }
  /// The other way.
  [[nodiscard]] Arc mirrored() const {
    Arc other = *this;
    other.across = -across;
    other.now.sin = -now.sin;
    return other;
  }
  [[nodiscard]] Vec3 at(const Angle& angle) const {
    return middle + radius * (angle.cos * uphill + angle.sin * across);
  }
};

/// The arc along which the ball at `p` rolls on one contact, or on two; nothing where that is no
/// motion. At least one contact is a ball.
[[nodiscard]] std::optional<Arc> arc_on(const Contacts& contacts, const Vec3& p, const Vec3& up);

/// The part of a circle that something blocks: a cos t + b sin t > k.
struct Blocked {
  double a = 0.0;
  double b = 0.0;
  double k = 0.0;
  double slack = 0.0;  ///< What counts as touched already: as much below k. And as level: a rise by
                       ///< so much per radian.
};

/// By a ball about `center` that is not to come nearer than `reach`, equation (2); `touch` is the
/// distance that counts as contact [L].
[[nodiscard]] inline Blocked blocked_by_ball(const Arc& arc, const Vec3& center, double reach,
                                             double touch) {
  const Vec3 w = center - arc.middle;
  const double twice = 2.0 * arc.radius;
  return {twice * dot(w, arc.uphill), twice * dot(w, arc.across),
          arc.radius * arc.radius + norm_sq(w) - reach * reach, 2.0 * reach * touch};
}

/// By the plane through `point` with the unit normal `inward`.
[[nodiscard]] inline Blocked blocked_by_plane(const Arc& arc, const Vec3& point, const Vec3& inward,
                                              double touch) {
  return {-arc.radius * dot(inward, arc.uphill), -arc.radius * dot(inward, arc.across),
          dot(inward, arc.middle - point), touch};
}

/// Where the ball that comes along `arc` is blocked: at once, where it touches and moves in.
/// @return  nothing if not before the angle of cosine `last_cos`, at most pi.
[[nodiscard]] std::optional<Angle> entry(const Blocked& blocked, const Angle& now, double last_cos);

}  // namespace packstone::rolling
