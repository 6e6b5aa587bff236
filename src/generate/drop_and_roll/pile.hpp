#pragma once

/// @file
/// The balls that stand, and how one more comes to rest on them.

#include <cstdint>
#include <optional>
#include <vector>

#include "generate/drop_and_roll/rolling.hpp"
#include "generate/drop_and_roll/skyline.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"
#include "packstone/structure/standing.hpp"

namespace packstone::rolling {

/// Balls in a cell, found by place.
class Pile {
 public:
  /// @param min_gap  That any two keep [L].
  Pile(const Cell& cell, double min_gap);

  /// How many balls will stand; lays the search out for so many.
  void expect(std::int64_t count) { grid_.reserve(count); }

  [[nodiscard]] std::int64_t size() const { return grid_.size(); }

  /// Adds a ball, its center inside the cell.
  void add(const Vec3& center, double radius);

  /// Lets a ball of `radius` go above `column`, whose vertical coordinate is not looked at.
  /// @return  where it rests, wrapped into the cell; nothing where that is above the ceiling, or
  ///          where it has not come to rest within kMostSteps.
  [[nodiscard]] std::optional<Vec3> drop(const Vec3& column, double radius) const;

  /// The box in which the center of a ball of `radius` may stand.
  [[nodiscard]] CenterBox centers(double radius) const {
    return centers_inside_walls(cell_, {radius, radius, cell_.dimension == 2 ? 0.0 : radius});
  }

  /// Far more than any ball takes: some 2 to 20.
  static constexpr int kMostSteps = 2000;

 private:
  struct Ball {
    Vec3 center;
    double radius;
  };
  // A ball on its way.
  struct Traveler {
    double radius;
    CenterBox box;  // For its center.
    Vec3 p;
    Contacts contacts;
  };
  enum class Step { moved, rests };

  [[nodiscard]] double reach(double radius, const Ball& other) const {
    return (radius + other.radius + min_gap_) * (1.0 + kContactGap) + margin_;
  }
  // What still counts as contact: a quarter of what contacts stay open.
  [[nodiscard]] double touch(double reach) const { return 0.25 * (kContactGap * reach + margin_); }
  [[nodiscard]] double height_on(const Contact& contact, const Vec3& p) const;
  [[nodiscard]] Step fall(Traveler& ball) const;
  [[nodiscard]] std::optional<Contact> first_below(const Traveler& ball, double depth) const;
  [[nodiscard]] Step roll(Traveler& ball) const;
  struct Stretch;
  struct Hit;
  [[nodiscard]] Hit first_hit(const Traveler& ball, const Arc& arc) const;
  void meet_walls(const Traveler& ball, const Arc& arc, Hit& hit) const;
  void meet_balls(const Traveler& ball, const Arc& arc, const Stretch& stretch, Hit& hit) const;
  [[nodiscard]] Stretch stretch_from(const Arc& arc, const Angle& from, double length) const;

  // Contacts stay open by this part of their reach.
  static constexpr double kContactGap = 1e-12;

  Cell cell_;
  std::size_t up_axis_;
  Vec3 up_;
  double min_gap_;
  double margin_;  // And by this besides, for the rounding of coordinates [L].
  double search_;  // Boxes of bodies in contact come at least as near [L].
  HierarchicalGrid grid_;
  Skyline skyline_;
  std::vector<Ball> balls_;
};

}  // namespace packstone::rolling
