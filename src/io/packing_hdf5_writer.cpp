#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "io/hdf5_document.hpp"
#include "io/hdf5_file.hpp"
#include "io/inclusion_record.hpp"
#include "io/packing_hdf5.hpp"
#include "io/storable.hpp"

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

}  // namespace

void write_packing_members(hid_t root, const Packing& packing) {
  write_cell(root, packing.cell);
  Hdf5Folder(root, "").column("groups", packing.groups);
  write_inclusions(root, packing);
  if (packing.certificate) write_certificate(root, *packing.certificate);
  if (packing.provenance) write_provenance(root, *packing.provenance);
}

void write_packing_hdf5(const std::filesystem::path& path, const Packing& packing) {
  check_storable(packing);
  write_hdf5(path, kPackingFormat, [&](hid_t root) { write_packing_members(root, packing); });
}

}  // namespace packstone
