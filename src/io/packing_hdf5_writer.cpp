#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/inclusion_record.hpp"
#include "io/packing_hdf5.hpp"
#include "io/storable.hpp"
#include "packstone/core/error.hpp"

namespace packstone {
namespace {

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

Hdf5Handle enumeration(const std::vector<std::string>& words) {
  Hdf5Handle type(H5Tenum_create(H5T_STD_I8LE), H5Tclose, "a new enumeration");
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = static_cast<std::int8_t>(i);
    check_hdf5(H5Tenum_insert(type, words[i].c_str(), &value), words[i]);
  }
  return type;
}

void write_attributes(hid_t root) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "a new dataspace");
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "a new type");
  check_hdf5(H5Tset_size(type, kPackingFormat.size()), "format");
  check_hdf5(H5Tset_strpad(type, H5T_STR_NULLPAD), "format");
  check_hdf5(H5Tset_cset(type, H5T_CSET_UTF8), "format");
  const Hdf5Handle format(H5Acreate2(root, "format", type, space, H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose, "format");
  check_hdf5(H5Awrite(format, type, kPackingFormat.data()), "format");
  const Hdf5Handle version(
      H5Acreate2(root, "version", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      "version");
  check_hdf5(H5Awrite(version, H5T_NATIVE_INT, &kPackingVersion), "version");
}

void write_cell(hid_t root, const Cell& cell) {
  Hdf5Folder folder(root, "cell");
  std::vector<double> size;
  std::vector<std::int32_t> periodic;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    size.push_back(cell.size[axis]);
    periodic.push_back(cell.periodic[axis] ? 1 : 0);
  }
  folder.column("size", size);
  folder.column("periodic", periodic, enumeration({"FALSE", "TRUE"}));
}

/// Which of the shapes stand in the packing.
std::array<bool, kShapeKinds> shapes_present(const Packing& packing) {
  std::array<bool, kShapeKinds> present{};
  for (const Inclusion& inclusion : packing.inclusions) present[inclusion.body.index()] = true;
  return present;
}

// The center is there even when no inclusion is: an empty table still says its width.
std::size_t column_width(NumberField field, const Packing& packing) {
  if (field == NumberField::center) return static_cast<std::size_t>(packing.cell.dimension);
  const auto present = shapes_present(packing);
  int width = 0;
  for (std::size_t shape = 0; shape < kShapeKinds; ++shape) {
    if (present[shape]) width = std::max(width, arity(field, static_cast<ShapeKind>(shape)));
  }
  return static_cast<std::size_t>(width);
}

void write_number_column(Hdf5Folder& folder, NumberField field, std::size_t width,
                         const Packing& packing) {
  std::vector<double> values;
  values.reserve(width * packing.inclusions.size());
  InclusionRecord record;
  for (const Inclusion& inclusion : packing.inclusions) {
    record.set(inclusion);
    const bool has = arity(field, kind(inclusion.body)) > 0;
    for (std::size_t i = 0; i < width; ++i) values.push_back(has ? record[field][i] : kAbsent);
  }
  folder.column(std::string(name(field)).c_str(), values, width == 1 ? 0 : width);
}

void write_inclusions(hid_t root, const Packing& packing) {
  Hdf5Folder folder(root, "inclusions");
  std::vector<std::int32_t> groups;
  std::vector<std::int32_t> shapes;
  for (const Inclusion& inclusion : packing.inclusions) {
    groups.push_back(inclusion.group);
    shapes.push_back(static_cast<std::int32_t>(inclusion.body.index()));
  }
  folder.column("group", groups, H5T_STD_I32LE);
  folder.column("shape", shapes, enumeration(shape_words()));
  for (std::size_t i = 0; i < kNumberFields; ++i) {
    const auto field = static_cast<NumberField>(i);
    const std::size_t width = column_width(field, packing);
    if (width > 0) write_number_column(folder, field, width, packing);
  }
}

void write_certificate(hid_t root, const Certificate& c) {
  Hdf5Folder folder(root, "certificate");
  folder.scalar("count", c.count);
  folder.scalar("fraction", c.fraction);
  folder.scalar("min_gap", c.min_gap);
  folder.scalar("smallest_gap", c.smallest_gap);
  folder.scalar("smallest_gap_error", c.smallest_gap_error);
  folder.column("worst_pair", std::vector<std::int64_t>(c.worst_pair.begin(), c.worst_pair.end()));
  folder.column("worst_image",
                std::vector<std::int64_t>(c.worst_image.begin(), c.worst_image.end()));
  folder.scalar("overlaps", c.overlaps);
  folder.scalar("gaps_below", c.gaps_below);
  folder.scalar("outside_walls", c.outside_walls);
  folder.scalar("pairs_checked", c.pairs_checked);
  std::vector<std::string> names;
  std::vector<std::int64_t> counts;
  std::vector<double> fractions;
  for (const GroupCensus& group : c.groups) {
    names.push_back(group.name);
    counts.push_back(group.count);
    fractions.push_back(group.fraction);
  }
  Hdf5Folder census(folder.id(), "groups");
  census.column("name", names);
  census.column("count", counts);
  census.column("fraction", fractions);
}

void write_provenance(hid_t root, const Provenance& p) {
  Hdf5Folder folder(root, "provenance");
  if (!p.recipe_json.empty()) folder.scalar("recipe", p.recipe_json);
  folder.scalar("seed", p.seed);
  folder.scalar("method", p.method);
  folder.scalar("version", p.version);
  folder.scalar("stop", p.stop);
  folder.scalar("seconds", p.seconds);
}

// Metadata from library version 1.8 on carries checksums, so that a damaged file is noticed.
Hdf5Handle create_file(const std::filesystem::path& path) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "new properties");
  check_hdf5(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST), "file version");
  const Hdf5Handle creation = timeless(H5P_FILE_CREATE);
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "cannot be created"};
}

}  // namespace

void write_hdf5_here(const std::filesystem::path& path, const Packing& packing) {
  Hdf5Handle file = create_file(path);
  {
    Hdf5Folder root(file, "");
    write_attributes(root.id());
    write_cell(root.id(), packing.cell);
    root.column("groups", packing.groups);
    write_inclusions(root.id(), packing);
    if (packing.certificate) write_certificate(root.id(), *packing.certificate);
    if (packing.provenance) write_provenance(root.id(), *packing.provenance);
  }
  file.close("writing failed");
}

void write_packing_hdf5(const std::filesystem::path& path, const Packing& packing) {
  check_storable(packing);
  AtomicFile target(path);
  if (!target.replaces()) throw FileError(path.string() + ": is not a regular file");
  try {
    const Hdf5Session session;
    write_hdf5_here(target.temporary(), packing);
  } catch (const InvalidArgument& problem) {
    throw FileError(path.string() + ": " + problem.what());
  }
  target.commit();
}

}  // namespace packstone
