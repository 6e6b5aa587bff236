#include "generate/published_event_driven/collisions.hpp"

#include <algorithm>

namespace packstone::published {
namespace {

Shift difference(const Shift& b, const Shift& a) { return {b[0] - a[0], b[1] - a[1], b[2] - a[2]}; }

/// One of each two images that stand to each other as shifted by this much; what was known of it
/// before is kept, and nothing is of a new image.
template <class ImagePairs>
ImagePairs present_pairs(const std::vector<Shift>& shifts_a, const std::vector<Shift>& shifts_b,
                         const ImagePairs& known) {
  ImagePairs present;
  for (const Shift& shift_a : shifts_a) {
    for (const Shift& shift_b : shifts_b) {
      const Shift shift = difference(shift_b, shift_a);
      const auto same = [&](const auto& pair) { return pair.shift == shift; };
      if (std::any_of(present.begin(), present.end(), same)) continue;
      const auto found = std::find_if(known.begin(), known.end(), same);
      if (found != known.end()) {
        present.push_back(*found);
      } else {
        present.push_back({shift, {}});
      }
    }
  }
  return present;
}

}  // namespace

MovingEllipsoid shifted(const Cell& cell, MovingEllipsoid moving, const Shift& shift) {
  moving.center += image_shift(cell, shift);
  return moving;
}

void PairForecasts::forget(std::size_t body) {
  for (std::size_t other = 0; other < bodies_; ++other) {
    for (ImagePair& pair : pairs_of(std::min(body, other), std::max(body, other))) {
      pair.forecast = {};
    }
  }
}

Collision PairForecasts::next(const Cell& cell, const std::vector<MovingEllipsoid>& bodies,
                              Clock clock, const PublishedOptions& options,
                              PublishedCounts& counts) {
  std::vector<std::vector<Shift>> shifts;
  shifts.reserve(bodies.size());
  for (const MovingEllipsoid& moving : bodies) shifts.push_back(image_shifts(cell, moving));
  Collision first;
  for (std::size_t a = 0; a < bodies_; ++a) {
    for (std::size_t b = a + 1; b < bodies_; ++b) {
      ImagePairs& pairs = pairs_of(a, b);
      pairs = present_pairs(shifts[a], shifts[b], pairs);
      for (auto& [shift, forecast] : pairs) {
        clock.next = first.time;
        if (needs_search(forecast, clock.next, options)) {
          forecast = collision_forecast(bodies[a], shifted(cell, bodies[b], shift), clock, options,
                                        counts);
        }
        if (forecast.event && forecast.time < first.time) first = {forecast.time, a, b, shift};
      }
    }
  }
  return first;
}

}  // namespace packstone::published
