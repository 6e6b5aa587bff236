#pragma once

/// @file
/// A body on trial, and its trials that draw the center from all of the cell.

#include <algorithm>
#include <cstdint>

#include "generate/rsa/placed_bodies.hpp"
#include "generate/rsa/pose.hpp"
#include "generate/rsa/standing.hpp"
#include "generate/rsa/trial_numbers.hpp"

namespace packstone::rsa {

/// A body that is looking for its place.
struct BodyOnTrial {
  Candidate candidate;
  Turning turning = Turning::none;
  CenterBox domain;  ///< Where its center may be.

  BodyOnTrial() = default;
  /// @param placed  Among whom it looks.
  BodyOnTrial(const PlacedBodies& placed, const Body& body, Turning turning);

  /// A center anywhere; it may lie on the upper edge of the cell.
  [[nodiscard]] Vec3 draw_center(TrialNumbers::Row& numbers) const {
    const Vec3 &lo = domain.lo, &hi = domain.hi;
    const double u = numbers.uniform(), v = numbers.uniform(), w = numbers.uniform();
    return {std::min(lo.x + (hi.x - lo.x) * u, hi.x), std::min(lo.y + (hi.y - lo.y) * v, hi.y),
            std::min(lo.z + (hi.z - lo.z) * w, hi.z)};
  }

  /// The body as the trial turns it, which has drawn its center from `numbers` before.
  [[nodiscard]] Candidate draw_turned(const PlacedBodies& placed, TrialNumbers::Row& numbers) const;

  /// Does the body, turned by `numbers`, find room at `center`? Adds to `cost`, at most
  /// kMostCostInGrid where the grid is searched.
  [[nodiscard]] bool fits(const PlacedBodies& placed, const Vec3& center,
                          TrialNumbers::Row& numbers, std::int64_t& cost,
                          std::int32_t since = 0) const;

  /// The rest of fits(), where look_around() has found nothing.
  ///
  /// @param since  Where the grid is searched: leave out bodies of a lower number.
  [[nodiscard]] bool fits_closely(const PlacedBodies& placed, const Vec3& center,
                                  const PlacedBodies::View& view, TrialNumbers::Row& numbers,
                                  std::int64_t& cost, std::int32_t since = 0) const;

  static constexpr std::int64_t kMostCostInGrid = 2 * Cost::trial + Cost::search;
};

/// Trials of one body anywhere in the cell, numbered from 0. Trial k is the same whoever evaluates
/// it, whatever was tried before, and on whatever thread.
struct PlainTrials {
  BodyOnTrial body;
  TrialNumbers numbers;

  /// @param key   Of the random streams of this start.
  /// @param item  Number of the body in the order.
  PlainTrials(const BodyOnTrial& body_on_trial, std::uint64_t key, std::int64_t item)
      : body(body_on_trial), numbers(key, StreamId::rsa_center, static_cast<std::uint64_t>(item)) {}

  [[nodiscard]] Vec3 center(std::int64_t k) const {
    TrialNumbers::Row row = numbers.trial(k);
    return body.draw_center(row);
  }

  /// The numbers of trial k from which it turns the body.
  [[nodiscard]] TrialNumbers::Row behind_center(std::int64_t k) const {
    TrialNumbers::Row row = numbers.trial(k);
    static_cast<void>(body.draw_center(row));
    return row;
  }
};

}  // namespace packstone::rsa
