#pragma once

/// @file
/// Algorithm 6 for all pairs, images included.

#include <cstddef>
#include <vector>

#include "generate/published_event_driven/contact_search.hpp"
#include "generate/published_event_driven/faces.hpp"
#include "packstone/core/cell.hpp"

namespace packstone::published {

/// The body moved by whole periods.
MovingEllipsoid shifted(const Cell& cell, MovingEllipsoid moving, const Shift& shift);

/// Bodies a and b, b shifted, and when they collide.
struct Collision {
  double time = kNever;
  std::size_t a = 0;
  std::size_t b = 0;
  Shift shift{};
};

/// The forecasts of Algorithm 6, kept while velocities and images stay.
class PairForecasts {
 public:
  explicit PairForecasts(std::size_t bodies) : bodies_(bodies), pairs_(bodies * bodies) {}

  /// The velocities of this body have changed.
  void forget(std::size_t body);

  /// The next collision. `clock.next` is not used.
  Collision next(const Cell& cell, const std::vector<MovingEllipsoid>& bodies, Clock clock,
                 const PublishedOptions& options, PublishedCounts& counts);

 private:
  /// A body and an image of another one.
  struct ImagePair {
    Shift shift{};
    Forecast forecast;
  };
  using ImagePairs = std::vector<ImagePair>;

  ImagePairs& pairs_of(std::size_t a, std::size_t b) { return pairs_[a * bodies_ + b]; }

  std::size_t bodies_;
  std::vector<ImagePairs> pairs_;
};

}  // namespace packstone::published
