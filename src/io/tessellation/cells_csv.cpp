#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "io/export/csv_text.hpp"
#include "io/tessellation/cell_parts.hpp"
#include "io/tessellation/formats.hpp"

namespace packstone {
namespace {

constexpr const char* kFlatTitles =
    "inclusion,group,center_x,center_y,area,ordered_area,perimeter,centroid_x,centroid_y,"
    "second_moment_xx,second_moment_yy,second_moment_xy,semi_axis_a,semi_axis_b,aspect,angle,"
    "neighbors,parts\n";
constexpr const char* kSolidTitles =
    "inclusion,group,center_x,center_y,center_z,volume,ordered_volume,surface,centroid_x,"
    "centroid_y,centroid_z,second_moment_xx,second_moment_yy,second_moment_zz,second_moment_yz,"
    "second_moment_xz,second_moment_xy,semi_axis_a,semi_axis_b,semi_axis_c,aspect,axis_a_x,"
    "axis_a_y,axis_a_z,axis_c_x,axis_c_y,axis_c_z,neighbors,parts\n";

// From x to the longer axis, counterclockwise, in (-pi/2, pi/2].
double angle_of(const Vec3& axis) {
  const double angle = std::atan2(axis.y, axis.x);
  if (angle > 0.5 * std::numbers::pi) return angle - std::numbers::pi;
  return angle <= -0.5 * std::numbers::pi ? angle + std::numbers::pi : angle;
}

/// A line of the table, field by field.
class Line {
 public:
  explicit Line(std::string first) : text_(std::move(first)) {}

  void add(const std::string& field) { text_ += "," + field; }
  void add(double value) { add(shortest(value)); }
  void add(const Vec3& v, int dimension) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) add(v[a]);
  }
  /// Fields that an empty cell has no value for.
  void skip(int fields) { text_.append(static_cast<std::size_t>(fields), ','); }
  [[nodiscard]] std::string ended() const { return text_ + "\n"; }

 private:
  std::string text_;
};

void add_moments(Line& line, const SymMat3& m, int dimension) {
  line.add(m.xx);
  line.add(m.yy);
  if (dimension == 3) {
    line.add(m.zz);
    line.add(m.yz);
    line.add(m.xz);
  }
  line.add(m.xy);
}

void add_shape(Line& line, const CellShape& shape, int dimension) {
  line.add(shape.boundary);
  line.add(shape.centroid, dimension);
  add_moments(line, shape.second_moment, dimension);
  line.add(shape.semi_axes, dimension);
  line.add(shape.aspect);
  if (dimension == 2) {
    line.add(angle_of(shape.axes.col_x));
  } else {
    line.add(shape.axes.col_x, 3);
    line.add(shape.axes.col_z, 3);
  }
}

}  // namespace

void write_cells_csv(ByteWriter& out, const Tessellation& tessellation, const Packing& packing) {
  const int dimension = tessellation.box.dimension;
  const std::vector<CellShape> shapes = cell_shapes(tessellation);
  const std::vector<double> ordered = ordered_measures(packing);
  const std::vector<int> neighbors = neighbor_counts(tessellation);
  out.text(dimension == 2 ? kFlatTitles : kSolidTitles);
  for (std::size_t c = 0; c < shapes.size(); ++c) {
    const TessellationCell& cell = tessellation.cells[c];
    Line line(std::to_string(c));
    line.add(csv_text(packing.groups[static_cast<std::size_t>(cell.group)]));
    line.add(cell.center, dimension);
    line.add(shapes[c].measure);
    line.add(ordered[c]);
    if (shapes[c].measure > 0.0) {
      add_shape(line, shapes[c], dimension);
    } else {
      line.skip(dimension == 2 ? 10 : 20);
    }
    line.add(std::to_string(neighbors[c]));
    line.add(std::to_string(cell.parts));
    out.text(line.ended());
  }
}

}  // namespace packstone
