#pragma once

/// @file
/// Algorithm 6 for one pair: bounding spheres, neighborhoods, roots of eta_1.

#include <limits>
#include <optional>

#include "packstone/generate/published_event_driven.hpp"

namespace packstone::published {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// What is known about the next event of a pair, or of a body and a plane.
struct Forecast {
  bool known = false;
  bool event = false;    ///< An event was found, at `time`; otherwise there is none before `time`.
  double time = kNever;  ///< Since the start of the run.
};

/// Does it have to be looked for, if the next event known is at `next`?
inline bool needs_search(const Forecast& forecast, double next, const PublishedOptions& options) {
  if (!forecast.known) return true;
  return options.skipped_pairs == PublishedForm::corrected && !forecast.event &&
         forecast.time < next;
}

/// None before `time`; as printed, none ever.
inline Forecast none_before(double time, const PublishedOptions& options) {
  const bool printed = options.skipped_pairs == PublishedForm::printed;
  return {true, false, printed ? kNever : time};
}

/// Times of the run that bound a search.
struct Clock {
  double now = 0.0;
  double next = kNever;  ///< Of the events found so far.
  double end = kNever;   ///< Nothing is looked for after it.

  /// How far a search reaches.
  double horizon(const PublishedOptions& options) const {
    const bool printed = options.skipped_pairs == PublishedForm::printed;
    return (printed || end < next ? end : next) - now;
  }
};

/// While two bounding spheres share a point.
struct SphereContact {
  double from = 0.0;
  double to = kNever;
};

/// Equations (15) and (16), from now on; nothing if they never meet.
std::optional<SphereContact> sphere_contact(const MovingEllipsoid& a, const MovingEllipsoid& b);

/// Lines 5 to 35 of Algorithm 6.
Forecast collision_forecast(const MovingEllipsoid& a, const MovingEllipsoid& b, const Clock& clock,
                            const PublishedOptions& options, PublishedCounts& counts);

}  // namespace packstone::published
