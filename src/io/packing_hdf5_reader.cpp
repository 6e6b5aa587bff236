#include <cmath>
#include <limits>

#include "io/hdf5_document.hpp"
#include "io/hdf5_file.hpp"
#include "io/inclusion_record.hpp"
#include "io/isolated.hpp"
#include "io/packing_hdf5.hpp"
#include "io/storable.hpp"
#include "packstone/core/error.hpp"

namespace packstone {
namespace {

Cell read_cell(Hdf5Fields fields) {
  const std::vector<double> size = fields.numbers("size");
  std::vector<bool> periodic;
  for (const std::int64_t flag : fields.word_column("periodic", {"FALSE", "TRUE"})) {
    if (flag != 0 && flag != 1) throw InvalidArgument("cell.periodic: must be true or false");
    periodic.push_back(flag == 1);
  }
  fields.finish();
  return stored_cell(size, periodic);
}

std::vector<ShapeKind> read_shapes(Hdf5Fields& fields) {
  std::vector<ShapeKind> shapes;
  for (const std::int64_t code : fields.word_column("shape", shape_words())) {
    if (code < 0 || code >= static_cast<std::int64_t>(kShapeKinds)) {
      throw InvalidArgument("inclusion " + std::to_string(shapes.size()) + ": unknown shape " +
                            std::to_string(code));
    }
    shapes.push_back(static_cast<ShapeKind>(code));
  }
  return shapes;
}

/// A column of numbers; empty when the packing has no such field.
struct NumberColumn {
  NumberField field;
  std::size_t width = 0;
  std::vector<double> values;
};

NumberColumn read_number_column(Hdf5Fields& fields, NumberField field, int dimension,
                                const std::vector<ShapeKind>& shapes) {
  NumberColumn column{field, 0, {}};
  if (field == NumberField::center) column.width = static_cast<std::size_t>(dimension);
  for (const ShapeKind shape : shapes) {
    column.width = std::max(column.width, static_cast<std::size_t>(arity(field, shape)));
  }
  if (column.width == 0) return column;
  column.values = fields.number_column(std::string(name(field)), shapes.size(), column.width);
  return column;
}

// A number where the shape has no such field would be lost without a word.
void fill(InclusionRecord& record, const NumberColumn& column, std::size_t row, ShapeKind shape) {
  const auto wanted = static_cast<std::size_t>(arity(column.field, shape));
  for (std::size_t i = 0; i < column.width; ++i) {
    const double value = column.values[row * column.width + i];
    record[column.field][i] = value;
    if (i < wanted || std::isnan(value)) continue;
    throw InvalidArgument("inclusion " + std::to_string(row) + ": field '" +
                          std::string(name(column.field)) + "' does not belong to a " +
                          std::string(name(shape)) + " and must be NaN");
  }
}

std::vector<Inclusion> read_inclusions(Hdf5Fields fields, int dimension) {
  const std::vector<ShapeKind> shapes = read_shapes(fields);
  const std::vector<std::int64_t> groups = fields.integer_column("group", shapes.size());
  std::vector<NumberColumn> columns;
  for (std::size_t i = 0; i < kNumberFields; ++i) {
    columns.push_back(read_number_column(fields, static_cast<NumberField>(i), dimension, shapes));
  }
  fields.finish();
  std::vector<Inclusion> inclusions;
  inclusions.reserve(shapes.size());
  InclusionRecord record;
  for (std::size_t row = 0; row < shapes.size(); ++row) {
    for (const NumberColumn& column : columns) fill(record, column, row, shapes[row]);
    // What is out of range becomes -1, which no group has: the check of the packing refuses it.
    const bool in_range = groups[row] >= 0 && groups[row] <= std::numeric_limits<int>::max();
    inclusions.push_back({record.center(dimension), record.body(shapes[row]),
                          in_range ? static_cast<int>(groups[row]) : -1});
  }
  return inclusions;
}

std::vector<GroupCensus> read_census(Hdf5Fields fields) {
  const std::vector<std::string> names = fields.texts("name");
  const std::vector<std::int64_t> counts = fields.integer_column("count", names.size());
  const std::vector<double> fractions = fields.number_column("fraction", names.size(), 1);
  fields.finish();
  std::vector<GroupCensus> census;
  for (std::size_t i = 0; i < names.size(); ++i) {
    census.push_back({names[i], counts[i], fractions[i]});
  }
  return census;
}

Certificate read_certificate(Hdf5Fields fields) {
  Certificate c;
  c.count = fields.integer("count");
  c.fraction = fields.number("fraction");
  c.groups = read_census(fields.folder("groups"));
  c.min_gap = fields.number("min_gap");
  c.smallest_gap = fields.number("smallest_gap");
  c.smallest_gap_error = fields.number("smallest_gap_error");
  const std::vector<std::int64_t> pair = fields.integer_column("worst_pair", 2);
  std::copy(pair.begin(), pair.end(), c.worst_pair.begin());
  const std::vector<std::int64_t> image = fields.integer_column("worst_image", 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    c.worst_image[axis] = static_cast<int>(image[axis]);
    if (c.worst_image[axis] == image[axis]) continue;
    throw InvalidArgument("certificate/worst_image = " + std::to_string(image[axis]) +
                          " is out of range");
  }
  c.overlaps = fields.integer("overlaps");
  c.gaps_below = fields.integer("gaps_below");
  c.outside_walls = fields.integer("outside_walls");
  c.pairs_checked = fields.integer("pairs_checked");
  fields.finish();
  return c;
}

Provenance read_provenance(Hdf5Fields fields) {
  Provenance p;
  if (fields.has("recipe")) p.recipe_json = fields.text("recipe");
  p.seed = fields.unsigned_integer("seed");
  p.method = fields.text("method");
  p.version = fields.text("version");
  p.stop = fields.text("stop");
  p.seconds = fields.number("seconds");
  fields.finish();
  return p;
}

Packing read_file(const std::filesystem::path& path) {
  return read_hdf5_here(path, kPackingFormat,
                        [](Hdf5Fields& fields) { return read_packing_members(fields); });
}

// Another process reads the file and writes it anew; that is what is read here.
Packing read_isolated(const std::filesystem::path& path) {
  const ScratchFile copy;
  const Hdf5Session session;
  // Far more than reading takes: some 0.2 us a body of 100 bytes.
  constexpr double kBytesPerSecond = 1e6;
  const double limit =
      20.0 + static_cast<double>(std::filesystem::file_size(path)) / kBytesPerSecond;
  run_isolated(limit, [&] {
    const Packing packing = read_file(path);
    check_storable(packing);
    write_hdf5_here(copy.path(), kPackingFormat,
                    [&](hid_t root) { write_packing_members(root, packing); });
  });
  return read_file(copy.path());
}

}  // namespace

Packing read_packing_members(Hdf5Fields& fields) {
  Packing packing;
  packing.cell = read_cell(fields.folder("cell"));
  packing.groups = fields.texts("groups");
  packing.inclusions = read_inclusions(fields.folder("inclusions"), packing.cell.dimension);
  if (fields.has("certificate"))
    packing.certificate = read_certificate(fields.folder("certificate"));
  if (fields.has("provenance")) packing.provenance = read_provenance(fields.folder("provenance"));
  return packing;
}

Packing read_packing_hdf5_here(const std::filesystem::path& path) {
  return naming_file(path, [&] {
    const Hdf5Session session;
    Packing packing = read_file(path);
    check_storable(packing);
    return packing;
  });
}

Packing read_packing_hdf5(const std::filesystem::path& path) {
  if (has_checksums(path)) return read_packing_hdf5_here(path);
  return naming_file(path, [&] {
    Packing packing = read_isolated(path);
    check_storable(packing);
    return packing;
  });
}

}  // namespace packstone
