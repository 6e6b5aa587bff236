#pragma once

/// @file
/// Where a disk may stand that touches a given one: the free gaps between blocked arcs.
///
/// The center of a disk of radius R that touches the disk i lies on the circle of radius r_i + R
/// about c_i. Whatever else stands blocks one arc of it: of a disk or a wall in the direction n the
/// arc e . n > c, e the unit vector from c_i,
///
///     disk k:  c = (rho^2 + d^2 - s^2) / (2 rho d)    rho = r_i + R,  s = r_k + R,  d = |c_k -
///     c_i| wall:    c = (distance of c_i to the wall - R) / rho (1)
///
/// The ends of the gaps between the arcs are all positions in which the disk touches i and
/// something else, and overlaps nothing: no pair of disks need be tried, and no position checked.
/// (The pairs of disks are those of D. N. Ilin, M. Bernacki, MATEC Web Conf. 80 (2016) 02004,
/// section 2.2.)

#include <cmath>
#include <vector>

#include "packstone/core/vec.hpp"

namespace packstone::advancing_layer {

/// The arcs around one disk.
class ContactArcs {
 public:
  void clear() { arcs_.clear(); }

  /// Blocks e . n > c, n unit. Returns false where nothing is left.
  bool block(const Vec3& n, double c) {
    if (c >= 1.0) return true;
    if (c <= -1.0) return false;
    const double s = std::sqrt(1.0 - c * c);
    const Vec2 from{c * n.x + s * n.y, c * n.y - s * n.x};
    const Vec2 to{c * n.x - s * n.y, c * n.y + s * n.x};
    arcs_.push_back({turn(from), turn(to), from, to});
    return true;
  }

  /// Calls visit(e) for the ends of all gaps, if wanted(e).
  template <class Wanted, class Visit>
  void visit_ends(Wanted&& wanted, Visit&& visit) {
    const auto look = [&](const Vec2& end) {
      if (wanted(lift(end))) visit(lift(end));
    };
    sort();
    double covered = 0.0;
    const Arc* last = nullptr;  // The arc that covers farthest.
    for (const Arc& arc : arcs_) {
      if (arc.to >= arc.from || arc.to < covered) continue;
      covered = arc.to;
      last = &arc;
    }
    for (const Arc& arc : arcs_) {
      if (arc.from > covered) {
        if (last != nullptr) look(last->end);
        look(arc.begin);
      }
      const double to = arc.to < arc.from ? kWholeTurn : arc.to;
      if (to < covered) continue;
      covered = to;
      last = &arc;
    }
    if (covered < kWholeTurn && last != nullptr) look(last->end);
  }

 private:
  static constexpr double kWholeTurn = 4.0;

  struct Arc {
    double from, to;  // Counterclockwise, as turn(); to < from across the x axis.
    Vec2 begin, end;
  };

  // Grows with the angle from the x axis, from 0 to 4; a division in place of an arc tangent.
  static double turn(const Vec2& e) {
    const double part = e.x / (std::abs(e.x) + std::abs(e.y));
    return e.y >= 0.0 ? 1.0 - part : 3.0 + part;
  }

  // By insertion: there are some ten.
  void sort() {
    for (std::size_t k = 1; k < arcs_.size(); ++k) {
      const Arc arc = arcs_[k];
      std::size_t at = k;
      for (; at > 0 && arcs_[at - 1].from > arc.from; --at) arcs_[at] = arcs_[at - 1];
      arcs_[at] = arc;
    }
  }

  std::vector<Arc> arcs_;
};

}  // namespace packstone::advancing_layer
