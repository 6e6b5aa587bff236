#pragma once

/// @file
/// The bodies that stand, and where the published algorithm places one more.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "generate/published_advancing_layer/contact_curves.hpp"
#include "generate/published_advancing_layer/multi_circle.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/generate/published_advancing_layer.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"

namespace packstone::published_layer {

/// Both ends of an arc, and where the tangents there meet. A circle that holds these holds the arc.
struct Triangle {
  std::array<Vec2, 3> corners;

  [[nodiscard]] Vec2 middle() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }
};

/// What was looked at.
struct Tried {
  std::int64_t pairs = 0;
  std::int64_t positions = 0;
};

/// The Height list, with the first row and the search of pairs.
class Layer {
 public:
  Layer(const Cell& cell, const PublishedLayerOptions& options);

  /// How many bodies will stand; lays the search out for so many.
  void expect(std::int64_t count) { grid_.reserve(count); }

  /// Places a body, in the first row until one does not fit there, then by pairs.
  /// @param largest  a_max of equation (1) [L].
  /// @return         its center, inside the cell; nothing if no pair accepts it.
  [[nodiscard]] std::optional<Vec2> place(const MultiCircle& shape, double largest);

  [[nodiscard]] const Tried& tried() const { return tried_; }
  [[nodiscard]] std::int64_t first_row() const { return first_row_; }

 private:
  struct Placed {
    MultiCircle shape;
    Vec2 center;
    // No disk of this radius or more finds room at the outline [L].
    double no_room_from = std::numeric_limits<double>::infinity();
  };
  // An entry of the Height list.
  struct Listed {
    double height;
    std::int32_t id;
  };
  // One image of a body near the first partner.
  struct Near {
    double height;
    std::int32_t id;
    Vec2 center;
  };

  void add(const MultiCircle& shape, const Vec2& center);
  [[nodiscard]] std::optional<Vec2> place_in_row(const MultiCircle& shape);
  [[nodiscard]] double row_abscissa(const MultiCircle& shape, double y) const;
  [[nodiscard]] std::optional<Vec2> place_by_pairs(const MultiCircle& shape, double largest);
  [[nodiscard]] std::optional<Vec2> place_on(std::int32_t first, ContactCurves& curves,
                                             Tried& tried) const;
  void remember_no_room(std::int32_t first, const MultiCircle& shape);
  [[nodiscard]] std::vector<Near> candidates(const Placed& first, const Vec2& half) const;
  [[nodiscard]] std::vector<ContactArc> open_arcs(std::int32_t first, const std::vector<Near>& near,
                                                  ContactCurves& curves) const;
  [[nodiscard]] bool covers(const Near& other, const MultiCircle& moving, const Triangle& triangle,
                            CirclePair& pair) const;
  [[nodiscard]] std::vector<Vec2> solutions_with(const Near& second,
                                                 const std::vector<ContactArc>& arcs,
                                                 ContactCurves& curves) const;
  [[nodiscard]] std::optional<Vec2> first_free(std::vector<Vec2> solutions,
                                               const MultiCircle& shape,
                                               const std::vector<Near>& near, Tried& tried) const;
  [[nodiscard]] bool is_inside(const Vec2& center, const Vec2& half) const;
  [[nodiscard]] bool is_free(const MultiCircle& shape, const Vec2& center,
                             const std::vector<Near>& near) const;

  Cell cell_;
  PublishedLayerOptions options_;
  double contact_gap_;
  HierarchicalGrid grid_;
  std::vector<Placed> bodies_;
  std::vector<Listed> heights_;  // Ascending.
  ContactCurves curves_;         // Of the body to place.
  ContactCurves disk_curves_;    // Of the disk that looks for room.
  bool row_is_open_ = true;
  std::int64_t first_row_ = 0;
  Tried tried_;
};

}  // namespace packstone::published_layer
