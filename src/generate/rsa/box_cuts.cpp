#include "generate/rsa/box_cuts.hpp"

#include <algorithm>

namespace packstone::rsa {
namespace {

// Part of squared lengths by which half-spaces are taken wider: far above the rounding of the few
// operations that lead to them [-].
constexpr double kMargin = 1e-13;

}  // namespace

Cut cut_by(const Outline& body, const Vec3& p, double range, double blur_sq) noexcept {
  Cut cut{p, 0.0, 0.0};
  if (body.half_length > 0.0) {
    const double along = dot(body.axis, p);
    const double past_end = std::max(0.0, std::abs(along) - body.half_length);
    Vec3 radial = p - along * body.axis;
    if (body.ends == Outline::Ends::flat) {
      const double side_sq = norm_sq(radial);
      const bool beside = side_sq > body.radius * body.radius;
      radial = (beside ? 1.0 - body.radius / std::sqrt(side_sq) : 0.0) * radial;
    }
    cut.away = radial + std::copysign(past_end, along) * body.axis;
  }
  cut.distance_sq = norm_sq(cut.away);
  cut.least =
      0.5 * (range * range - cut.distance_sq - blur_sq) - kMargin * (range * range + norm_sq(p));
  return cut;
}

BoxCuts::Meeting BoxCuts::look_at(const Outline& body, const Vec3& p, double range) noexcept {
  const Cut cut = cut_by(body, p, range, blur_sq_);
  const double most = reach(cut);
  if (cut.least > most) return Meeting::covers;
  // The distance, which is convex, changes at least as along its gradient: by most / distance at
  // the most.
  const double past = cut.distance_sq - most;
  if (past > 0.0 && past * past > (1.0 + 1e-9) * range * range * cut.distance_sq) {
    return Meeting::nowhere;
  }
  if (cut.least > -most) add(cut);
  return cut.distance_sq < range * range ? Meeting::middle : Meeting::near;
}

// Where three of the planes meet, or faces of the cube.
struct BoxCuts::Vertex {
  std::array<Plane, 3> planes;
  std::array<bool, 3> is_face{true, true, true};
  std::array<Vec3, 3> edges;     // edges[k] leaves plane k, into its half-space, along the others.
  std::array<double, 3> prices;  // >= 0: the objective is the sum of prices[k] planes[k].normal.
  Vec3 y;

  // The corner of the cube along `toward`.
  explicit Vertex(const Vec3& toward) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges[k] = Vec3{0, 0, 0};
      edges[k][k] = toward[k] > 0.0 ? -1.0 : 1.0;
      planes[k] = {edges[k].x, edges[k].y, edges[k].z, -1.0, -1.0};
      prices[k] = std::abs(toward[k]);
      y[k] = -edges[k][k];
    }
  }

  // How fast each edge enters the half-space.
  [[nodiscard]] std::array<double, 3> rates(const Plane& plane) const {
    const Vec3 normal = plane.normal();
    return {dot(normal, edges[0]), dot(normal, edges[1]), dot(normal, edges[2])};
  }

  // Moves along edge `leave` to where it meets the plane.
  void go(std::size_t leave, const std::array<double, 3>& rate, const Plane& plane, bool face) {
    const double per_rate = 1.0 / rate[leave];
    const Vec3 edge = per_rate * edges[leave];
    const double price = per_rate * prices[leave];
    y = y + (plane.least - dot(plane.normal(), y)) * edge;
    for (std::size_t k = 0; k < 3; ++k) {
      edges[k] = edges[k] - rate[k] * edge;
      prices[k] -= rate[k] * price;
    }
    edges[leave] = edge;
    prices[leave] = price;
    planes[leave] = plane;
    is_face[leave] = face;
  }
};

// False where none is: y lies in the cube and in all half-spaces, but for rounding.
bool BoxCuts::most_violated(const Vec3& y, Plane& plane, bool& is_face) const noexcept {
  std::size_t worst = count_;
  double most = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const double missing = cuts_[i].asked - dot(cuts_[i].normal(), y);
    if (missing > most) {
      most = missing;
      worst = i;
    }
  }
  is_face = worst == count_;
  if (!is_face) {
    plane = cuts_[worst];
    return true;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(y[k]) <= 1.0 + kTolerance) continue;
    Vec3 normal{0, 0, 0};
    normal[k] = y[k] > 0.0 ? -1.0 : 1.0;
    plane = {normal.x, normal.y, normal.z, -1.0, -1.0};
    return true;
  }
  return false;
}

bool BoxCuts::leave_nothing() const noexcept {
  if (leaves_middle_) return false;
  constexpr int most_steps = 16;
  Vec3 toward{0, 0, 0};
  for (std::size_t i = 0; i < count_; ++i) {
    if (cuts_[i].least > 0.0) toward = toward + cuts_[i].normal();
  }
  Vertex vertex(toward);
  for (int step = 0; step < most_steps; ++step) {
    Plane enter;
    bool face = false;
    if (!most_violated(vertex.y, enter, face)) return false;
    const std::array<double, 3> rate = vertex.rates(enter);
    std::size_t leave = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      if (rate[k] <= 0.0) continue;
      if (leave == 3 || vertex.prices[k] * rate[leave] < vertex.prices[leave] * rate[k]) leave = k;
    }
    if (leave < 3) {
      vertex.go(leave, rate, enter, face);
      continue;
    }
    // No edge leads there: the weights are 1 and the rates' negatives.
    Vec3 sum = face ? Vec3{0, 0, 0} : enter.normal();
    double least = face ? 0.0 : enter.least;
    double size = std::abs(least) + norm1(sum);
    for (std::size_t k = 0; k < 3; ++k) {
      if (vertex.is_face[k]) continue;
      const Plane& plane = vertex.planes[k];
      sum = sum - rate[k] * plane.normal();
      least -= rate[k] * plane.least;
      size -= rate[k] * (std::abs(plane.least) + norm1(plane.normal()));
    }
    return least > norm1(sum) + kMargin * size;
  }
  return false;
}

}  // namespace packstone::rsa
