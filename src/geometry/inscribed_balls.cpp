#include "packstone/geometry/inscribed_balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/overloaded.hpp"

namespace packstone {
namespace {

using std::numbers::pi;
using Balls = std::vector<InscribedBall>;

// A medial axis shorter than this part of the largest ball is a point: the union gains no more.
constexpr double kPoint = 1e-9;

// Where the balls on the way to the rim of a cylinder end, over the largest one.
constexpr double kLeastAtRim = 0.25;

void check_spacing(double spacing) {
  if (spacing >= kLeastBallSpacing && spacing <= kMostBallSpacing) return;
  throw InvalidArgument("spacing is " + std::to_string(spacing) +
                        "; allowed are numbers in [0.01, 1]");
}

// x_N: half the medial axis of an ellipse with half axes a >= b.
double half_medial(double a, double b) { return (a - b) * (a + b) / a; }

// Equation (1), and its two-dimensional form (3): r of a ball that is at the shares u, v of the
// medial half axes.
double medial_radius(const Vec3& s, double u, double v) {
  const double x = u * half_medial(s.x, s.z) / s.x, y = v * half_medial(s.y, s.z) / s.y;
  // x_N / a is 1 - c^2 / a^2, so that x^2 / (a^2 - c^2) is u^2 (1 - c^2 / a^2).
  return s.z * std::sqrt(std::max(0.0, 1.0 - u * x - v * y));
}

// Equation (2): shares x_i / x_N of the right half, 0 and 1 among them; `step` is x_1 / x_N.
std::vector<double> medial_shares(double step) {
  std::vector<double> shares = {0.0};
  while (shares.back() < 1.0) {
    const double x = shares.back();
    shares.push_back(std::min(x + step * std::sqrt((1.0 - x) * (1.0 + x)), 1.0));
  }
  return shares;
}

// Semi-axes a >= b >= c and the directions they have in the cell frame.
struct Axes {
  Vec3 semi;
  std::array<Vec3, 3> along;
};

Balls on_medial_line(const Axes& of, double spacing) {
  const double reach = half_medial(of.semi.x, of.semi.z);
  if (reach <= kPoint * of.semi.z) return {{Vec3{}, of.semi.z}};
  const std::vector<double> shares = medial_shares(spacing * of.semi.z / reach);
  Balls balls;
  const auto add = [&](double u) {
    balls.push_back({u * reach * of.along[0], medial_radius(of.semi, u, 0.0)});
  };
  for (std::size_t i = shares.size(); i-- > 1;) add(-shares[i]);
  for (const double u : shares) add(u);
  return balls;
}

// Covers a quarter of the medial ellipse by points that keep a distance to each other and to their
// own mirror images: a sphere of curvature r needs its neighbors at spacing sqrt(c r), where the
// valley between them is as deep as between the largest ones.
class MedialCover {
 public:
  MedialCover(const Vec3& semi, double spacing)
      : semi_(semi),
        reach_{half_medial(semi.x, semi.z), half_medial(semi.y, semi.z), 0.0},
        spacing_(spacing) {
    cover_rim();
    cover_inside();
  }

  // Points of the quarter as shares of the half axes.
  [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }

 private:
  // Of the spacing of a line, as the points farthest from all of them are to be as near in a plane.
  static constexpr double kKeptApart = 0.6;

  [[nodiscard]] double spacing_at(const Vec2& p) const {
    return kKeptApart * spacing_ * std::sqrt(semi_.z * medial_radius(semi_, p.x, p.y));
  }
  [[nodiscard]] double distance(const Vec2& p, const Vec2& q) const {
    return std::hypot(reach_.x * (p.x - q.x), reach_.y * (p.y - q.y));
  }
  // A point on an axis is its own mirror image there, one near it would crowd it.
  [[nodiscard]] bool keeps_apart(const Vec2& p) const {
    const double least = spacing_at(p);
    if (p.x > 0.0 && 2.0 * reach_.x * p.x < least) return false;
    if (p.y > 0.0 && 2.0 * reach_.y * p.y < least) return false;
    return std::none_of(points_.begin(), points_.end(),
                        [&](const Vec2& q) { return distance(p, q) < least; });
  }
  void offer(const Vec2& p) {
    if (keeps_apart(p)) points_.push_back(p);
  }
  // Fine enough that what the candidates leave open is small.
  [[nodiscard]] int candidates() const {
    const double least = spacing_ * semi_.z * std::sqrt(semi_.z / semi_.x);
    return static_cast<int>(std::ceil(2.0 * pi * reach_.x / least)) + 1;
  }
  void cover_rim() {
    points_ = {{1.0, 0.0}};
    offer({0.0, 1.0});
    const int count = candidates();
    for (int i = 1; i < count; ++i) {
      const double angle = 0.5 * pi * i / count;
      offer({std::cos(angle), std::sin(angle)});
    }
  }
  void cover_inside() {
    offer({0.0, 0.0});
    const std::vector<double> rows = medial_shares(0.25 * spacing_ * semi_.z / reach_.y);
    const std::vector<double> columns = medial_shares(0.25 * spacing_ * semi_.z / reach_.x);
    for (const double v : rows) {
      const double half_row = std::sqrt((1.0 - v) * (1.0 + v));
      for (const double u : columns) offer({half_row * u, v});
    }
  }

  Vec3 semi_;
  Vec3 reach_;
  double spacing_;
  std::vector<Vec2> points_;
};

Balls on_medial_ellipse(const Axes& of, double spacing) {
  const double reach_x = half_medial(of.semi.x, of.semi.z);
  const double reach_y = half_medial(of.semi.y, of.semi.z);
  const MedialCover cover(of.semi, spacing);
  Balls balls;
  for (const Vec2& p : cover.points()) {
    const double radius = medial_radius(of.semi, p.x, p.y);
    for (const double x : {p.x, -p.x}) {
      for (const double y : {p.y, -p.y}) {
        balls.push_back({x * reach_x * of.along[0] + y * reach_y * of.along[1], radius});
        if (p.y == 0.0) break;
      }
      if (p.x == 0.0) break;
    }
  }
  return balls;
}

Balls in_ellipsoid(const Ellipsoid& body, double spacing) {
  const Mat3 frame = to_matrix(body.orientation);
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return body.semi_axes[a] > body.semi_axes[b];
  });
  const std::array<Vec3, 3> columns = {frame.col_x, frame.col_y, frame.col_z};
  Axes of;
  for (std::size_t k = 0; k < 3; ++k) {
    of.semi[k] = body.semi_axes[order[k]];
    of.along[k] = columns[order[k]];
  }
  if (half_medial(of.semi.y, of.semi.z) <= kPoint * of.semi.z) return on_medial_line(of, spacing);
  return on_medial_ellipse(of, spacing);
}

Balls in_ellipse(const Ellipse& body, double spacing) {
  const Vec3 x{std::cos(body.angle), std::sin(body.angle), 0.0};
  const Vec3 y{-x.y, x.x, 0.0};
  const Vec2& s = body.semi_axes;
  if (s.x >= s.y) return on_medial_line({{s.x, s.y, s.y}, {x, y, {}}}, spacing);
  return on_medial_line({{s.y, s.x, s.x}, {y, x, {}}}, spacing);
}

// Equal balls whose centers divide [-half, half] along `axis` evenly.
Balls along_axis(const Vec3& axis, double half, double radius, double spacing) {
  const int steps = static_cast<int>(std::ceil(2.0 * half / (spacing * radius)));
  if (steps == 0) return {{Vec3{}, radius}};
  Balls balls;
  for (int i = 0; i <= steps; ++i) {
    balls.push_back({half * (2 * i - steps) / steps * axis, radius});
  }
  return balls;
}

// Balls of one ring about the axis of a cylinder, a multiple of four of them.
struct Ring {
  double height = 0.0;
  double around = 0.0;  // Radius of the circle of centers.
  double radius = 0.0;
};

void add_ring(Balls& balls, const Ring& ring, const Vec3& axis, double spacing) {
  const Vec3 u = any_perpendicular(axis);
  const Vec3 v = cross(axis, u);
  const int quarter = static_cast<int>(std::ceil(0.5 * pi * ring.around / (spacing * ring.radius)));
  for (int i = 0; i < 4 * quarter; ++i) {
    const double angle = 0.5 * pi * i / quarter;
    const Vec3 across = std::cos(angle) * u + std::sin(angle) * v;
    balls.push_back({ring.height * axis + ring.around * across, ring.radius});
  }
}

// The medial disk of a cylinder shorter than wide.
Balls on_medial_disk(const Cylinder& body, double spacing) {
  const double radius = body.half_length, reach = body.radius - body.half_length;
  Balls balls = {{Vec3{}, radius}};
  const int rings = static_cast<int>(std::ceil(reach / (spacing * radius)));
  for (int i = 1; i <= rings; ++i) {
    add_ring(balls, {0.0, reach * i / rings, radius}, body.axis, spacing);
  }
  return balls;
}

Balls in_cylinder(const Cylinder& body, double spacing) {
  const double largest = std::min(body.radius, body.half_length);
  Balls balls = body.half_length < body.radius
                    ? on_medial_disk(body, spacing)
                    : along_axis(body.axis, body.half_length - largest, largest, spacing);
  for (double r = largest / (1.0 + spacing); r >= kLeastAtRim * largest; r /= 1.0 + spacing) {
    for (const double side : {-1.0, 1.0}) {
      add_ring(balls, {side * (body.half_length - r), body.radius - r, r}, body.axis, spacing);
    }
  }
  return balls;
}

}  // namespace

std::vector<InscribedBall> inscribed_balls(const Body& body, double spacing) {
  check_spacing(spacing);
  return std::visit(Overloaded{[](const Sphere& b) -> Balls {
                                 return {{Vec3{}, b.radius}};
                               },
                               [=](const Ellipsoid& b) { return in_ellipsoid(b, spacing); },
                               [=](const Cylinder& b) { return in_cylinder(b, spacing); },
                               [=](const Spherocylinder& b) {
                                 return along_axis(b.axis, b.half_length, b.radius, spacing);
                               },
                               [](const Disk& b) -> Balls {
                                 return {{Vec3{}, b.radius}};
                               },
                               [=](const Ellipse& b) { return in_ellipse(b, spacing); }},
                    body);
}

}  // namespace packstone
