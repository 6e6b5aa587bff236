#include "geometry/sections.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/unit_disk_polygon.hpp"

namespace packstone {
namespace {

// Sections across an axis along which a cylinder is at least this steep are well conditioned; one
// axis of three always is.
constexpr double kSteep = 0.57;

// Equation (1): the sections across axis k; their coordinates are those along i and j.
struct Sections {
  std::size_t i = 0, j = 1, k = 2;
  Vec2 drift;
  double l_11 = 1.0, l_21 = 0.0, l_22 = 1.0;
  double inverse_reach = 0.0;

  [[nodiscard]] Vec2 flat(const Vec3& v) const { return {v[i], v[j]}; }
  // L^-1 v.
  [[nodiscard]] Vec2 solve(const Vec2& v) const {
    const double y = v.x / l_11;
    return {y, (v.y - l_21 * y) / l_22};
  }
  // |L^T n|: half width of the ellipse along n at sigma = 1.
  [[nodiscard]] double half_width(const Vec2& n) const {
    return std::hypot(l_11 * n.x + l_21 * n.y, l_22 * n.y);
  }
  [[nodiscard]] double sigma_sq(double z) const {
    const double tau = z * inverse_reach;
    return (1.0 - tau) * (1.0 + tau);
  }
};

Sections across(std::size_t k) {
  Sections s;
  s.k = k;
  s.i = (k + 1) % 3;
  s.j = (k + 2) % 3;
  return s;
}

// By orthogonal steps on the rows, which lose the aspect in digits and not its square.
Sections ellipsoid_sections(const std::array<Vec3, 3>& rows, std::size_t k) {
  Sections s = across(k);
  const double reach_sq = norm_sq(rows[k]);
  s.inverse_reach = 1.0 / std::sqrt(reach_sq);
  s.drift = {dot(rows[s.i], rows[k]) / reach_sq, dot(rows[s.j], rows[k]) / reach_sq};
  const Vec3 row_i = rows[s.i] - s.drift.x * rows[k];
  const Vec3 row_j = rows[s.j] - s.drift.y * rows[k];
  s.l_11 = norm(row_i);
  s.l_21 = dot(row_j, row_i) / s.l_11;
  s.l_22 = norm(row_j - s.l_21 / s.l_11 * row_i);
  return s;
}

Sections cylinder_sections(const Vec3& axis, double radius, std::size_t k) {
  Sections s = across(k);
  s.drift = {axis[s.i] / axis[k], axis[s.j] / axis[k]};
  s.l_11 = radius * std::hypot(1.0, s.drift.x);
  s.l_21 = radius * radius * s.drift.x * s.drift.y / s.l_11;
  s.l_22 = radius * radius / (std::abs(axis[k]) * s.l_11);
  return s;
}

// normal.p <= offset - slope z bounds the section at height z.
struct Line {
  Vec2 normal;
  double offset = 0.0;
  double slope = 0.0;
};

// Heights at which the integrand is not smooth, ends included.
class Breaks {
 public:
  Breaks(double from, double to) : from_(from), to_(to) {}

  void add(double z) {
    if (z > from_ && z < to_) heights_[count_++] = z;
  }
  // The roots of a z^2 + 2 b z + c.
  void add_roots(double a, double b, double c) {
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) return;
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    if (a != 0.0) add(q / a);
    if (q != 0.0) add(c / q);
  }
  // Calls piece(from, to) for each stretch between neighbors.
  template <class Piece>
  void for_pieces(const Piece& piece) {
    std::sort(heights_.begin(), heights_.begin() + static_cast<std::ptrdiff_t>(count_));
    double from = from_;
    for (std::size_t i = 0; i < count_; ++i) {
      if (heights_[i] > from) piece(from, heights_[i]);
      from = heights_[i];
    }
    piece(from, to_);
  }

 private:
  double from_, to_;
  // Six lines touch twice each, their 15 pairs cross the ellipse twice, 20 triples meet once.
  std::array<double, 12 + 30 + 20> heights_{};
  std::size_t count_ = 0;
};

// A body sliced across one axis, in a box.
class Slices {
 public:
  Slices(const SlicedBody& body, const Vec3& lo, const Vec3& hi, std::size_t k)
      : sections_(body.radius > 0.0 ? cylinder_sections(body.axis, body.radius, k)
                                    : ellipsoid_sections(body.rows, k)) {
    const Vec3& half = body.half_extents;
    from_ = std::max(lo[k], -half[k]);
    to_ = std::min(hi[k], half[k]);
    for (std::size_t e = 0; e < body.end_count; ++e) {
      const HalfSpace& end = body.ends[e];
      add_line({sections_.flat(end.normal), end.offset, end.normal[k]});
    }
    end_count_ = line_count_;
    add_sides(half, lo, hi);
  }

  [[nodiscard]] double volume() const {
    if (from_ >= to_) return 0.0;
    double sum = 0.0;
    breaks().for_pieces([&](double from, double to) { sum += integral(from, to); });
    return sum;
  }

 private:
  void add_line(const Line& line) { lines_[line_count_++] = line; }

  // What lies beyond the body bounds the polygon, but nothing changes there.
  void add_sides(const Vec3& half, const Vec3& lo, const Vec3& hi) {
    const auto side = [&](std::size_t axis, const Vec2& unit) {
      if (lo[axis] > -half[axis]) add_line({-unit, -lo[axis], 0.0});
      if (hi[axis] < half[axis]) add_line({unit, hi[axis], 0.0});
    };
    side(sections_.i, {1, 0});
    side(sections_.j, {0, 1});
    const std::size_t i = sections_.i, j = sections_.j;
    corner_lo_ = {std::max(lo[i], -half[i]), std::max(lo[j], -half[j])};
    corner_hi_ = {std::min(hi[i], half[i]), std::min(hi[j], half[j])};
  }

  // Area of the section at height z.
  [[nodiscard]] double area(double z) const {
    const double sigma_sq = sections_.sigma_sq(z);
    if (sigma_sq <= 0.0) return 0.0;
    SmallPolygon polygon = rectangle(corner_lo_, corner_hi_);
    for (std::size_t e = 0; e < end_count_; ++e) {
      const Line& line = lines_[e];
      polygon = clipped(polygon, line.normal, line.offset - line.slope * z);
    }
    const double scale = 1.0 / std::sqrt(sigma_sq);
    for (std::size_t c = 0; c < polygon.count; ++c) {
      polygon.corners[c] = scale * sections_.solve(polygon.corners[c] - z * sections_.drift);
    }
    return sigma_sq * sections_.l_11 * sections_.l_22 * area_in_unit_disk(polygon);
  }

  // Where a section begins to be cut, its area goes like the power 3/2 of the height: smooth in the
  // angle of a cosine.
  [[nodiscard]] double integral(double from, double to) const {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    return half * boost::math::quadrature::gauss<double, 20>::integrate(
                      [&](double angle) {
                        return area(middle - half * std::cos(angle)) * std::sin(angle);
                      },
                      0.0, std::numbers::pi);
  }

  [[nodiscard]] Breaks breaks() const {
    Breaks result(from_, to_);
    for (std::size_t a = 0; a < line_count_; ++a) {
      add_touching(lines_[a], result);
      for (std::size_t b = a + 1; b < line_count_; ++b) add_meeting(a, b, result);
    }
    return result;
  }

  // Where the ellipse touches the line: (a z - d)^2 = w^2 sigma(z)^2.
  void add_touching(const Line& line, Breaks& breaks) const {
    const double a = dot(line.normal, sections_.drift) + line.slope;
    const double w = sections_.half_width(line.normal);
    const double bend = w * sections_.inverse_reach;
    breaks.add_roots(a * a + bend * bend, -a * line.offset, (line.offset - w) * (line.offset + w));
  }

  // Where two lines meet on the ellipse, or on a third line.
  void add_meeting(std::size_t first, std::size_t second, Breaks& breaks) const {
    const Line& a = lines_[first];
    const Line& b = lines_[second];
    const double turn = cross(a.normal, b.normal);
    if (std::abs(turn) < std::numeric_limits<double>::epsilon()) return;
    const auto solve = [&](double x, double y) {
      return Vec2{(x * b.normal.y - y * a.normal.y) / turn,
                  (y * a.normal.x - x * b.normal.x) / turn};
    };
    const Vec2 at = solve(a.offset, b.offset), moves = solve(-a.slope, -b.slope);
    const Vec2 y = sections_.solve(at), dy = sections_.solve(moves - sections_.drift);
    const double inverse = sections_.inverse_reach;
    breaks.add_roots(norm_sq(dy) + inverse * inverse, dot(y, dy), norm_sq(y) - 1.0);
    for (std::size_t third = second + 1; third < line_count_; ++third) {
      const Line& c = lines_[third];
      const double nears = dot(c.normal, moves) + c.slope;
      if (nears != 0.0) breaks.add((c.offset - dot(c.normal, at)) / nears);
    }
  }

  Sections sections_;
  double from_ = 0.0, to_ = 0.0;
  Vec2 corner_lo_, corner_hi_;
  std::array<Line, 6> lines_;  // Ends of the body first, then sides of the box.
  std::size_t end_count_ = 0;
  std::size_t line_count_ = 0;
};

// The axis across which to slice: the box should cut the body along it rather than beside it.
std::size_t slicing_axis(const SlicedBody& body, const Vec3& lo, const Vec3& hi) {
  std::size_t best = 0;
  int most = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    if (body.radius > 0.0 && std::abs(body.axis[k]) < kSteep) continue;
    const int cuts = (lo[k] > -body.half_extents[k] ? 1 : 0) + (hi[k] < body.half_extents[k]);
    if (cuts > most) {
      most = cuts;
      best = k;
    }
  }
  return best;
}

}  // namespace

double sliced_volume(const SlicedBody& body, const Vec3& lo, const Vec3& hi) noexcept {
  for (std::size_t a = 0; a < 3; ++a) {
    if (lo[a] >= body.half_extents[a] || hi[a] <= -body.half_extents[a]) return 0.0;
  }
  return Slices(body, lo, hi, slicing_axis(body, lo, hi)).volume();
}

}  // namespace packstone
