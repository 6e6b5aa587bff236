#include <cerrno>
#include <cmath>
#include <fstream>
#include <limits>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>

#include "io/hdf5_file.hpp"
#include "io/inclusion_record.hpp"
#include "io/isolated.hpp"
#include "io/packing_hdf5.hpp"
#include "io/storable.hpp"
#include "packstone/core/error.hpp"

namespace packstone {
namespace {

Hdf5Handle open_attribute(hid_t root, const char* name) {
  if (H5Aexists(root, name) <= 0) {
    throw InvalidArgument(std::string("attribute '") + name + "' is missing: not a packing file");
  }
  return {H5Aopen(root, name, H5P_DEFAULT), H5Aclose, name};
}

void expect_single(const Hdf5Handle& attribute, const char* name) {
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, name);
  if (H5Sget_simple_extent_npoints(space) != 1) {
    throw InvalidArgument(std::string("attribute '") + name + "' must be a single value");
  }
}

std::string read_text_attribute(hid_t root, const char* name) {
  const Hdf5Handle attribute = open_attribute(root, name);
  expect_single(attribute, name);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, name);
  constexpr std::size_t kLongest = 4096;
  if (H5Tget_class(type) != H5T_STRING || H5Tget_size(type) > kLongest) {
    throw InvalidArgument(std::string("attribute '") + name + "' must be a short text");
  }
  refuse_variable_text(type, name);
  std::string text(H5Tget_size(type), '\0');
  check_hdf5(H5Aread(attribute, type, text.data()), name);
  return text.substr(0, text.find_last_not_of('\0') + 1);
}

void check_attributes(hid_t root) {
  check_format(read_text_attribute(root, "format"));
  const Hdf5Handle attribute = open_attribute(root, "version");
  expect_single(attribute, "version");
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, "version");
  if (H5Tget_class(type) != H5T_INTEGER) throw InvalidArgument("version: must be an integer");
  int version = 0;
  check_hdf5(H5Aread(attribute, H5T_NATIVE_INT, &version), "version");
  check_version(version);
}

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
  const std::uint64_t bytes = std::filesystem::file_size(path);
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
                        "cannot be read as HDF5");
  const Hdf5Handle root(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose, "/");
  check_attributes(root);
  Hdf5Fields fields(file, "", bytes);
  Packing packing;
  packing.cell = read_cell(fields.folder("cell"));
  packing.groups = fields.texts("groups");
  packing.inclusions = read_inclusions(fields.folder("inclusions"), packing.cell.dimension);
  if (fields.has("certificate"))
    packing.certificate = read_certificate(fields.folder("certificate"));
  if (fields.has("provenance")) packing.provenance = read_provenance(fields.folder("provenance"));
  fields.finish();
  return packing;
}

// Format 2 and 3 of the superblock came with checksums for all metadata. The signature stands at
// the start of the file, or after a block of the user's.
bool has_checksums(const std::filesystem::path& path) {
  constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
  char start[kSignature.size() + 1] = {};
  std::ifstream(path, std::ios::binary).read(start, sizeof start);
  return std::string_view(start, kSignature.size()) == kSignature && start[kSignature.size()] >= 2;
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
    write_hdf5_here(copy.path(), packing);
  });
  return read_file(copy.path());
}

// What `read` returns; its complaints name the file.
template <class Read>
Packing checked(const std::filesystem::path& path, Read read) {
  try {
    Packing packing = read();
    check_storable(packing);
    return packing;
  } catch (const InvalidArgument& problem) {
    throw FileError(path.string() + ": " + problem.what());
  } catch (const std::filesystem::filesystem_error& problem) {
    throw FileError(path.string() + ": cannot be read: " + problem.code().message());
  } catch (const std::bad_alloc&) {
    throw FileError(path.string() + ": holds more than fits into memory");
  }
}

}  // namespace

Packing read_packing_hdf5_here(const std::filesystem::path& path) {
  return checked(path, [&] {
    const Hdf5Session session;
    return read_file(path);
  });
}

Packing read_packing_hdf5(const std::filesystem::path& path) {
  if (has_checksums(path)) return read_packing_hdf5_here(path);
  return checked(path, [&] { return read_isolated(path); });
}

}  // namespace packstone
