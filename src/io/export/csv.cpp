#include <utility>

#include "io/export/csv_text.hpp"
#include "io/export/formats.hpp"
#include "io/export/placements.hpp"
#include "io/inclusion_record.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone {
namespace {

/// A column of numbers: which entry of which field.
struct Column {
  const char* title;
  NumberField field;
  std::size_t entry;
};

std::vector<Column> columns(int dimension) {
  using enum NumberField;
  if (dimension == 2) {
    return {{"center_x", center, 0}, {"center_y", center, 1}, {"radius", radius, 0},
            {"axes_a", axes, 0},     {"axes_b", axes, 1},     {"angle", angle, 0}};
  }
  return {{"center_x", center, 0},
          {"center_y", center, 1},
          {"center_z", center, 2},
          {"radius", radius, 0},
          {"half_length", half_length, 0},
          {"axis_x", axis, 0},
          {"axis_y", axis, 1},
          {"axis_z", axis, 2},
          {"axes_a", axes, 0},
          {"axes_b", axes, 1},
          {"axes_c", axes, 2},
          {"quaternion_w", quaternion, 0},
          {"quaternion_x", quaternion, 1},
          {"quaternion_y", quaternion, 2},
          {"quaternion_z", quaternion, 3}};
}

std::string heading(const std::vector<Column>& table, int dimension, bool images) {
  std::string line = dimension == 2 ? "inclusion,group,shape,area" : "inclusion,group,shape,volume";
  for (const Column& column : table) line += std::string(",") + column.title;
  if (images) line += dimension == 2 ? ",image_x,image_y,cuts" : ",image_x,image_y,image_z,cuts";
  return line + "\n";
}

// "x- y+": through the faces at x = 0 and at y = size.
std::string faces_text(const CellFaces& faces) {
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const auto& [cut, side] :
         {std::pair(faces.low[axis], '-'), std::pair(faces.high[axis], '+')}) {
      if (!cut) continue;
      if (!text.empty()) text += ' ';
      text += {"xyz"[axis], side};
    }
  }
  return text;
}

// The shift in periods along each axis and the faces that are cut, each after a comma.
std::string image_columns(const Placement& placement, int dimension) {
  std::string text;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
    text += ",";
    text += std::to_string(placement.image[axis]);
  }
  return text + "," + faces_text(placement.cuts);
}

}  // namespace

void write_csv(ByteWriter& out, const Packing& packing, const ExportOptions& options) {
  const int dimension = packing.cell.dimension;
  const std::vector<Column> table = columns(dimension);
  std::vector<std::string> groups;
  for (const std::string& group : packing.groups) groups.push_back(csv_text(group));
  out.text(heading(table, dimension, options.images));
  InclusionRecord record;
  for (const Placement& placement : placements(packing, options.images)) {
    Inclusion inclusion = packing.inclusions[placement.inclusion];
    inclusion.center = placement.center;
    record.set(inclusion);
    const ShapeKind shape = kind(inclusion.body);
    std::string line = std::to_string(placement.inclusion) + "," +
                       groups[static_cast<std::size_t>(inclusion.group)] + "," +
                       std::string(name(shape)) + "," + shortest(volume(inclusion.body));
    for (const Column& column : table) {
      line += ",";
      if (arity(column.field, shape) > 0) line += shortest(record[column.field][column.entry]);
    }
    if (options.images) line += image_columns(placement, dimension);
    out.text(line + "\n");
  }
}

}  // namespace packstone
