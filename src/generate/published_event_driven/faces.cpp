#include "generate/published_event_driven/faces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "generate/published_event_driven/root_search.hpp"
#include "packstone/core/mat.hpp"

namespace packstone::published {
namespace {

int period_of(const Cell& cell, const Vec3& center, std::size_t axis) {
  return static_cast<int>(std::floor(center[axis] / cell.size[axis]));
}

std::vector<int> shifts_along(const Cell& cell, const MovingEllipsoid& moving, std::size_t axis) {
  const int home = period_of(cell, moving.center, axis);
  std::vector<int> shifts{-home};
  if (meets_plane(moving, axis, home * cell.size[axis])) shifts.push_back(1 - home);
  if (meets_plane(moving, axis, (home + 1) * cell.size[axis])) shifts.push_back(-1 - home);
  return shifts;
}

/// The first plane from the center on, upward or downward, that the body does not meet.
int watched_plane(const Cell& cell, const MovingEllipsoid& moving, std::size_t axis, bool upward) {
  const int step = upward ? 1 : -1;
  int plane = period_of(cell, moving.center, axis) + (upward ? 1 : 0);
  while (meets_plane(moving, axis, plane * cell.size[axis])) plane += step;
  return plane;
}

Forecast face_forecast(const MovingEllipsoid& moving, std::size_t axis, double plane,
                       const Clock& clock, const PublishedOptions& options) {
  const double horizon = clock.horizon(options);
  const std::optional<double> found = published_face_time(moving, axis, plane, horizon, options);
  return found ? Forecast{true, true, clock.now + *found}
               : none_before(clock.now + horizon, options);
}

}  // namespace

bool meets_plane(const MovingEllipsoid& moving, std::size_t axis, double plane) {
  constexpr double kReached = 1e-9;
  return published_face_function(moving, axis, plane) <= kReached;
}

std::vector<Shift> image_shifts(const Cell& cell, const MovingEllipsoid& moving) {
  std::vector<Shift> shifts;
  for (const int x : shifts_along(cell, moving, 0)) {
    for (const int y : shifts_along(cell, moving, 1)) {
      for (const int z : shifts_along(cell, moving, 2)) shifts.push_back({x, y, z});
    }
  }
  return shifts;
}

double FaceForecasts::next(const Cell& cell, const std::vector<MovingEllipsoid>& bodies,
                           Clock clock, const PublishedOptions& options) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool upward : {false, true}) {
        const int plane = watched_plane(cell, bodies[i], axis, upward);
        Face& face = faces_[i][axis][upward ? 1 : 0];
        if (face.plane != plane) face = {plane, {}};
        if (needs_search(face.forecast, clock.next, options)) {
          face.forecast = face_forecast(bodies[i], axis, plane * cell.size[axis], clock, options);
        }
        if (face.forecast.event) clock.next = std::min(clock.next, face.forecast.time);
      }
    }
  }
  return clock.next;
}

}  // namespace packstone::published

namespace packstone {

double published_face_function(const MovingEllipsoid& moving, std::size_t axis,
                               double plane) noexcept {
  const Vec3 inverse_sq = unscale({1, 1, 1}, scale(moving.semi_axes, moving.semi_axes));
  const SymMat3 b = rotated_diagonal(to_matrix(moving.orientation), inverse_sq);
  const std::size_t l = axis == 0 ? 1 : 0, m = axis == 2 ? 1 : 2;
  Vec3 p;  // Equation (19b), from the center: there d = 0 and F = -1 in equation (17).
  p[axis] = plane - moving.center[axis];
  const Vec3 b_p = b * p;
  const double d_l = 2.0 * b_p[l], d_m = 2.0 * b_p[m], f = dot(p, b_p) - 1.0;  // Equation (21b)
  const Vec3 diagonal{b.xx, b.yy, b.zz}, mixed{b.yz, b.xz, b.xy};
  const double b_ll = diagonal[l], b_mm = diagonal[m], b_lm = mixed[axis];
  const double quadratic = b_mm * d_l * d_l - 2.0 * b_lm * d_l * d_m + b_ll * d_m * d_m;
  return f - 0.25 * quadratic / (b_ll * b_mm - b_lm * b_lm);  // Equation (23)
}

std::optional<double> published_face_time(const MovingEllipsoid& moving, std::size_t axis,
                                          double plane, double horizon,
                                          const PublishedOptions& options) {
  const double ahead = plane - moving.center[axis];
  const double speed = std::copysign(1.0, ahead) * moving.velocity[axis];
  const Vec3& e = moving.semi_axes;
  const Vec3& growth = moving.growth;
  const double clear = std::abs(ahead) - std::max({e.x, e.y, e.z});
  const double closing = speed + std::max({growth.x, growth.y, growth.z});
  if (clear > 0.0 && !(closing > 0.0)) return std::nullopt;
  const double from = clear > 0.0 ? clear / closing : 0.0;
  if (!(from < horizon)) return std::nullopt;
  const auto face = [&](double dt) {
    return published_face_function(published_moved(moving, dt), axis, plane);
  };
  return published::first_root(face, {from, horizon, options.samples, PublishedForm::corrected},
                               [](double) { return true; });
}

}  // namespace packstone
