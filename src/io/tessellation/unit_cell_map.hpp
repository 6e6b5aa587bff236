#pragma once

/// @file
/// A tessellation of the plane cut at the faces of the box: what a mesh of the unit cell is made
/// of.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "packstone/structure/tessellation.hpp"

namespace packstone {

/// A straight edge of the map.
struct MapEdge {
  std::size_t from = 0;  ///< Index into UnitCellMap::nodes.
  std::size_t to = 0;
};

/// An edge as a loop passes it.
struct MapStep {
  std::size_t edge = 0;
  bool backward = false;
};

/// A part of a cell inside the box.
struct MapFace {
  std::int32_t cell = 0;
  double area = 0.0;                        ///< [L^2]
  std::vector<std::vector<MapStep>> loops;  ///< Outline counterclockwise, then holes clockwise.
};

/// Two edges on opposite faces of the box, which one period makes one; both run the same way.
struct MapPair {
  std::size_t low = 0;   ///< Index into UnitCellMap::edges.
  std::size_t high = 0;  ///< The same edge one period further.
};

/// The box, divided without gap or overlap by faces that share edges and nodes. Nodes on opposite
/// faces of the box match exactly.
struct UnitCellMap {
  std::vector<Vec3> nodes;  ///< [L], in the closed box.
  std::vector<MapEdge> edges;
  std::vector<MapFace> faces;
  std::array<std::vector<MapPair>, 2> pairs;  ///< Per axis; empty where it is not periodic.
};

/// Cuts the cells at the faces of the box. What lies within 1e-9 of the box of a face is put there.
///
/// @pre  The tessellation is well formed and of dimension 2.
[[nodiscard]] UnitCellMap unit_cell_map(const Tessellation& tessellation);

}  // namespace packstone
