#pragma once

/// @file
/// Algorithms 8 and 10: which planes x_k = m L bodies reach next, and their images.

#include <array>
#include <cstddef>
#include <vector>

#include "generate/published_event_driven/contact_search.hpp"
#include "packstone/core/cell.hpp"

namespace packstone::published {

/// Periods along x, y, z.
using Shift = std::array<int, 3>;

/// Does the body cut or touch the plane x[axis] = plane? Within 1e-9 of the paper's function, so
/// that it does at the root at which it was found to.
bool meets_plane(const MovingEllipsoid& moving, std::size_t axis, double plane);

/// Algorithm 10, the body among them: the shifts by which it or an image of it stands in the cell,
/// or reaches across the planes of its faces.
std::vector<Shift> image_shifts(const Cell& cell, const MovingEllipsoid& moving);

/// The forecasts of Algorithm 8, kept while velocities stay.
class FaceForecasts {
 public:
  explicit FaceForecasts(std::size_t bodies) : faces_(bodies) {}

  /// The velocities of this body have changed.
  void forget(std::size_t body) { faces_[body] = {}; }

  /// When the next body reaches a plane that it does not meet now, or clock.next if that is before.
  double next(const Cell& cell, const std::vector<MovingEllipsoid>& bodies, Clock clock,
              const PublishedOptions& options);

 private:
  /// The nearest plane on one side that the body does not meet.
  struct Face {
    int plane = 0;
    Forecast forecast;
  };

  std::vector<std::array<std::array<Face, 2>, 3>> faces_;
};

}  // namespace packstone::published
