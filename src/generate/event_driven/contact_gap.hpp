#pragma once

/// @file
/// Which gaps count as contact.

namespace packstone::event_driven {

/// Over the circumscribed radii of both bodies [-]: what the search of Perram and Wertheim resolves
/// with room to spare, and what the general one does next to edges.
inline constexpr double kSmoothContactGap = 2e-12;
inline constexpr double kGeneralContactGap = 2e-7;
/// Over the longest edge of the cell [-], whose coordinates have rounding of 1e-16 of it.
inline constexpr double kCoordinateGap = 2e-14;
/// Searches aim at this part of the gap that counts as contact, so that rounding cannot turn it
/// into an overlap.
inline constexpr double kAimedPart = 0.25;

}  // namespace packstone::event_driven
