#pragma once

/// @file
/// The published algorithm in the plainest words: all pairs, all circles, no search structure.
/// Walls on all sides.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/geometry/inscribed_balls.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::printed_oracle {

struct Standing {
  std::vector<InscribedBall> circles;
  Vec2 center;
  Vec2 half;

  [[nodiscard]] double height() const { return center.y + half.y; }
};

class Printed {
 public:
  Printed(const Cell& cell, double spacing, double top_layer, double largest)
      : cell_(cell), spacing_(spacing), depth_(top_layer * largest) {}

  std::optional<Vec2> place(const Body& body) {
    Standing shape{inscribed_balls(body, spacing_), {}, {}};
    for (const InscribedBall& ball : shape.circles) {
      shape.half.x = std::max(shape.half.x, ball.center.x + ball.radius);
      shape.half.y = std::max(shape.half.y, ball.center.y + ball.radius);
    }
    std::optional<Vec2> center = row_open_ ? in_row(shape) : std::nullopt;
    row_open_ = row_open_ && center;
    if (!center) center = on_pair(shape);
    if (!center) return std::nullopt;
    shape.center = *center;
    bodies_.push_back(shape);
    return center;
  }

 private:
  static constexpr double kGap = 1e-12;

  [[nodiscard]] bool overlaps(const Standing& a, const Standing& b, const Vec2& at) const {
    for (const InscribedBall& p : a.circles) {
      for (const InscribedBall& q : b.circles) {
        const Vec2 d = at + flatten(q.center) - a.center - flatten(p.center);
        if (norm(d) < p.radius + q.radius - kGap) return true;
      }
    }
    return false;
  }

  [[nodiscard]] std::optional<Vec2> in_row(const Standing& shape) const {
    double x = shape.half.x;
    for (const Standing& body : bodies_) {
      for (const InscribedBall& p : body.circles) {
        for (const InscribedBall& q : shape.circles) {
          const double r = p.radius + q.radius;
          const double rise = shape.half.y + q.center.y - body.center.y - p.center.y;
          if (std::abs(rise) >= r) continue;
          const double run = std::sqrt(r * r - rise * rise);
          x = std::max(x, body.center.x + p.center.x + run - q.center.x);
        }
      }
    }
    if (x + shape.half.x > cell_.size.x) return std::nullopt;
    return Vec2{x, shape.half.y};
  }

  [[nodiscard]] std::vector<const Standing*> by_height() const {
    std::vector<const Standing*> list;
    for (const Standing& body : bodies_) list.push_back(&body);
    std::sort(list.begin(), list.end(),
              [](const Standing* a, const Standing* b) { return a->height() < b->height(); });
    return list;
  }

  [[nodiscard]] std::optional<Vec2> on_pair(const Standing& shape) const {
    const auto list = by_height();
    for (const Standing* first : list) {
      if (list.back()->height() - first->height() >= depth_) continue;
      for (const Standing* second : list) {
        const Vec2 d = second->center - first->center;
        if (first == second) continue;
        if (std::abs(d.x) > first->half.x + 2.0 * shape.half.x + second->half.x) continue;
        if (std::abs(d.y) > first->half.y + 2.0 * shape.half.y + second->half.y) continue;
        if (const auto center = first_free(shape, *first, *second)) return center;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Vec2> first_free(const Standing& shape, const Standing& first,
                                               const Standing& second) const {
    std::vector<Vec2> solutions;
    for (const InscribedBall& g : shape.circles) {
      for (const InscribedBall& f : shape.circles) {
        for (const InscribedBall& q : first.circles) {
          for (const InscribedBall& p : second.circles) {
            add_solutions(first.center + flatten(q.center) - flatten(g.center), q.radius + g.radius,
                          second.center + flatten(p.center) - flatten(f.center),
                          p.radius + f.radius, solutions);
          }
        }
      }
    }
    std::sort(solutions.begin(), solutions.end(),
              [](const Vec2& a, const Vec2& b) { return a.y < b.y; });
    for (const Vec2& at : solutions) {
      if (is_free(shape, at)) return at;
    }
    return std::nullopt;
  }

  // Where two circles cross.
  static void add_solutions(const Vec2& a, double ra, const Vec2& b, double rb,
                            std::vector<Vec2>& solutions) {
    const Vec2 d = b - a;
    const double distance = norm(d);
    if (distance >= ra + rb || distance <= std::abs(ra - rb)) return;
    const double along = (distance * distance + ra * ra - rb * rb) / (2.0 * distance);
    const double aside = std::sqrt(ra * ra - along * along);
    const Vec2 e = d / distance;
    solutions.push_back(a + along * e + aside * Vec2{-e.y, e.x});
    solutions.push_back(a + along * e - aside * Vec2{-e.y, e.x});
  }

  [[nodiscard]] bool is_free(const Standing& shape, const Vec2& at) const {
    if (at.x < shape.half.x || at.x + shape.half.x > cell_.size.x) return false;
    if (at.y < shape.half.y || at.y + shape.half.y > cell_.size.y) return false;
    return std::none_of(bodies_.begin(), bodies_.end(),
                        [&](const Standing& body) { return overlaps(body, shape, at); });
  }

  Cell cell_;
  double spacing_;
  double depth_;
  std::vector<Standing> bodies_;
  bool row_open_ = true;
};

}  // namespace packstone::printed_oracle
