#pragma once

/// @file
/// When do two moving bodies touch? A search that never steps over a contact.
///
/// From the present instant a plane between the bodies proves them apart for a while
/// (plane_bound.hpp); at the end of that while another plane is found, and so on, until the plane
/// holds to the horizon, or the gap is down to kContactGap while it closes: that is a contact. A
/// gap within kContactGap that opens is the usual state of a pair that has just collided.

#include <cstdint>

#include "generate/event_driven/bodies.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"

namespace packstone::event_driven {

/// Whom a body may meet: another one, an image of another or of itself, or a wall.
struct Partner {
  std::int32_t body = 0;  ///< Negative for walls, see wall().
  Vec3 shift;             ///< Of its image, in the coordinates of the run [L].
};

/// The wall across `axis`, at 0 or (`high`) at the far end of the cell.
[[nodiscard]] constexpr std::int32_t wall(int axis, bool high) {
  return -1 - 2 * axis - (high ? 1 : 0);
}
[[nodiscard]] constexpr bool is_wall(std::int32_t body) { return body < 0; }

/// What a search has found.
enum class Finding {
  none,        ///< No contact before the horizon, for certain.
  contact,     ///< They touch at `time`.
  look_again,  ///< None before `time`, for certain; nothing is known of what follows.
};
struct Found {
  Finding finding = Finding::none;
  double time = 0.0;
};

/// A contact as the law of collision needs it.
struct Contact {
  Vec3 normal;                ///< Unit, from the body to its partner.
  Vec3 arm_a;                 ///< From the center of the body to the contact [L].
  Vec3 arm_b;                 ///< From that of the partner.
  Vec3 between;               ///< From center to center [L].
  double growth_speed = 0.0;  ///< At which the surfaces grow toward each other [L/T].
  double approach = 0.0;      ///< Of the surfaces, growth included [L/T]; > 0: the gap closes.
};

/// What is known of two bodies of revolution when a search begins.
struct Suspicion {
  double l = 0.5;      ///< Perram and Wertheim's, of a plane between them.
  double clear = 0.0;  ///< They stay apart for that long, for certain [T].
};

/// What searches have cost and seen.
struct SearchCount {
  std::int64_t searches = 0;
  std::int64_t steps = 0;
  double least_gap = 0.0;  ///< The most negative gap that a search has begun from [L].
};

/// Searches among bodies that stay where they are stored.
class ContactSearch {
 public:
  ContactSearch(const Bodies& bodies, const Cell& cell);

  /// The first contact of body i with a partner after t and before `horizon`. Clocks of both are
  /// not after t. `normal`: a plane between them to begin with where one is known, otherwise
  /// 0; the last one found afterwards.
  Found first_contact(std::int32_t i, const Partner& partner, double t, double horizon,
                      Vec3& normal);

  /// The same for two bodies of revolution, balls among them, without min_gap.
  Found first_contact_of_revolution(std::int32_t i, const Partner& partner, double t,
                                    double horizon, const Suspicion& suspicion);

  /// The contact of two that touch at t.
  [[nodiscard]] Contact contact(std::int32_t i, const Partner& partner, double t,
                                const Vec3& normal) const;

  /// The same for two bodies of revolution without min_gap; `l`: Perram and Wertheim's of a plane
  /// between them.
  [[nodiscard]] Contact contact_of_revolution(std::int32_t i, const Partner& partner, double t,
                                              double l) const;

  /// Gap at t, as the best plane shows it, proven but for rounding [L].
  [[nodiscard]] double gap(std::int32_t i, const Partner& partner, double t) const;

  [[nodiscard]] const SearchCount& count() const { return count_; }

  /// Gaps below this count as contact [L].
  [[nodiscard]] double contact_gap(std::int32_t i, const Partner& partner, double t) const;

 private:
  struct Instant;
  struct Turning;
  class PairOfRevolution;
  class AnyPair;
  template <class Pair>
  Found march(Pair& pair, double time, double horizon, double contact_gap);
  Instant instant(std::int32_t i, const Partner& partner, double t) const;
  Found first_contact_of_balls(std::int32_t i, const Partner& partner, double t, double horizon);

  const Bodies& bodies_;
  Cell cell_;
  double coordinate_gap_;  // What coordinates can tell apart, with room [L].
  SearchCount count_;
};

}  // namespace packstone::event_driven
