#pragma once

/// @file
/// Where a ball may stand that touches a given one: the corners of what blocked caps leave.
///
/// As contact_arcs.hpp one dimension higher: the center lies on the sphere of radius rho about c_i,
/// and whatever else stands blocks the cap e . n > c, equation (1) there. Where the rims of two
/// caps meet, the ball touches three bodies; it overlaps nothing if no other cap holds that point.
/// With g = n_j . n_k
///
///     e = a n_j + b n_k +- h n_j x n_k
///     a = (c_j - g c_k) / (1 - g^2)    b = (c_k - g c_j) / (1 - g^2)
///     h^2 = (1 - a c_j - b c_k) / (1 - g^2)                                                  (1)

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "packstone/core/vec.hpp"

namespace packstone::advancing_layer {

/// The caps on one sphere.
class ContactCaps {
 public:
  void clear() { caps_.clear(); }

  /// Blocks e . n > c, n unit. Returns false where nothing is left.
  bool block(const Vec3& n, double c) {
    if (c >= 1.0) return true;
    if (c <= -1.0) return false;
    caps_.push_back({n, c, std::sqrt(1.0 - c * c)});
    return true;
  }

  /// Calls visit(e) for all free corners, if wanted(e), which is asked before it is known
  /// whether the corner is free.
  template <class Wanted, class Visit>
  void visit_ends(Wanted&& wanted, Visit&& visit) {
    drop_covered();
    for (std::size_t j = 1; j < caps_.size(); ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        visit_corners(j, k, wanted, visit);
      }
    }
  }

 private:
  struct Cap {
    Vec3 n;
    double c;  // Cosine and sine of half its opening.
    double s;
  };

  // Keeps the caps that no wider one covers, wide ones first: they hold most corners.
  void drop_covered() {
    std::sort(caps_.begin(), caps_.end(), [](const Cap& a, const Cap& b) { return a.c < b.c; });
    std::size_t kept = 0;
    for (const Cap& cap : caps_) {
      const bool covered = std::any_of(
          caps_.begin(), caps_.begin() + static_cast<std::ptrdiff_t>(kept),
          [&](const Cap& wide) { return dot(cap.n, wide.n) > cap.c * wide.c + cap.s * wide.s; });
      if (!covered) caps_[kept++] = cap;
    }
    caps_.resize(kept);
  }

  template <class Wanted, class Visit>
  void visit_corners(std::size_t j, std::size_t k, Wanted& wanted, Visit& visit) const {
    const Cap& a = caps_[j];
    const Cap& b = caps_[k];
    // Rims that are nearly parallel meet nowhere, or nowhere that could be told.
    constexpr double kParallel = 1e-10;
    const double g = dot(a.n, b.n);
    const double apart = 1.0 - g * g;
    if (!(apart > kParallel)) return;
    const double of_a = (a.c - g * b.c) / apart;
    const double of_b = (b.c - g * a.c) / apart;
    const double h_sq = (1.0 - of_a * a.c - of_b * b.c) / apart;
    if (!(h_sq > 0.0)) return;
    const Vec3 middle = of_a * a.n + of_b * b.n;
    const Vec3 across = std::sqrt(h_sq) * cross(a.n, b.n);
    for (const Vec3& e : {middle + across, middle - across}) {
      if (wanted(e) && is_free(e, j, k)) visit(e);
    }
  }

  [[nodiscard]] bool is_free(const Vec3& e, std::size_t j, std::size_t k) const {
    for (std::size_t other = 0; other < caps_.size(); ++other) {
      if (dot(e, caps_[other].n) > caps_[other].c && other != j && other != k) return false;
    }
    return true;
  }

  std::vector<Cap> caps_;
};

}  // namespace packstone::advancing_layer
