// The scripting language of Gmsh: C. Geuzaine, J.-F. Remacle, Int. J. Numer. Meth. Eng. 79 (2009)
// 1309-1331, and its reference manual, "Gmsh scripting language".

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "io/export/csv_text.hpp"
#include "io/tessellation/formats.hpp"
#include "io/tessellation/unit_cell_map.hpp"

namespace packstone {
namespace {

// Elements per diameter of a mean cell.
constexpr double kElements = 4.0;

// Gmsh counts from 1.
std::string tag(std::size_t index) { return std::to_string(index + 1); }

std::string signed_tag(const MapStep& step) {
  std::string text(step.backward ? "-" : "");
  return text += tag(step.edge);
}

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return "{" + text + "}";
}

void write_points_and_lines(ByteWriter& out, const UnitCellMap& map) {
  for (std::size_t n = 0; n < map.nodes.size(); ++n) {
    out.text("Point(" + tag(n) + ") = {" + shortest(map.nodes[n].x) + ", " +
             shortest(map.nodes[n].y) + ", 0, element};\n");
  }
  for (std::size_t e = 0; e < map.edges.size(); ++e) {
    out.text("Line(" + tag(e) + ") = {" + tag(map.edges[e].from) + ", " + tag(map.edges[e].to) +
             "};\n");
  }
}

void write_surfaces(ByteWriter& out, const UnitCellMap& map) {
  std::size_t loops = 0;
  for (std::size_t f = 0; f < map.faces.size(); ++f) {
    std::vector<std::string> of_face;
    for (const auto& loop : map.faces[f].loops) {
      std::vector<std::string> steps;
      steps.reserve(loop.size());
      for (const MapStep& step : loop) steps.push_back(signed_tag(step));
      out.text("Curve Loop(" + tag(loops) + ") = " + list(steps) + ";\n");
      of_face.push_back(tag(loops++));
    }
    out.text("Plane Surface(" + tag(f) + ") = " + list(of_face) + ";\n");
  }
}

void write_periodic(ByteWriter& out, const UnitCellMap& map, const Cell& box) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::string shift =
        axis == 0 ? list({shortest(box.size.x), "0", "0"}) : list({"0", shortest(box.size.y), "0"});
    std::vector<std::string> low, high;
    for (const MapPair& pair : map.pairs[axis]) {
      low.push_back(tag(pair.low));
      high.push_back(tag(pair.high));
      out.text("Periodic Curve {" + high.back() + "} = {" + low.back() + "} Translate " + shift +
               ";\n");
    }
    if (low.empty()) continue;
    const std::string name(1, "xy"[axis]);
    out.text("Physical Curve(\"" + name + "-\") = " + list(low) + ";\n");
    out.text("Physical Curve(\"" + name + "+\") = " + list(high) + ";\n");
  }
}

void write_physical_surfaces(ByteWriter& out, const UnitCellMap& map) {
  std::map<std::int32_t, std::vector<std::string>> surfaces;
  for (std::size_t f = 0; f < map.faces.size(); ++f) {
    surfaces[map.faces[f].cell].push_back(tag(f));
  }
  for (const auto& [cell, of_cell] : surfaces) {
    const std::string number = std::to_string(cell);
    out.text("Physical Surface(\"inclusion " + number + "\", " + std::to_string(cell + 1) +
             ") = " + list(of_cell) + ";\n");
  }
}

}  // namespace

void write_cells_geo(ByteWriter& out, const Tessellation& tessellation, const Packing&) {
  const UnitCellMap map = unit_cell_map(tessellation);
  const double mean = volume(tessellation.box) / static_cast<double>(tessellation.cells.size());
  out.text("// Cells of a tessellation, cut at the faces of the box, for Gmsh.\n");
  out.text("element = " + shortest(std::sqrt(mean) / kElements) + ";  // size of the elements\n");
  write_points_and_lines(out, map);
  write_surfaces(out, map);
  write_periodic(out, map, tessellation.box);
  write_physical_surfaces(out, map);
}

}  // namespace packstone
