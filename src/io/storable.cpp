#include "io/storable.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_set>

#include "packstone/core/error.hpp"

namespace packstone {
namespace {

void check_groups(const std::vector<std::string>& groups) {
  std::unordered_set<std::string_view> names;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string field = "groups[" + std::to_string(i) + "]";
    check_text(field, groups[i]);
    if (!names.insert(groups[i]).second) {
      throw InvalidArgument(field + " = '" + groups[i] + "' stands twice");
    }
  }
}

void check_range(const std::string& field, double value, double low, const char* allowed) {
  if (value >= low && std::isfinite(value)) return;
  throw InvalidArgument(field + " = " + std::to_string(value) + ", allowed are " + allowed);
}

void check_count(const std::string& field, std::int64_t value, std::int64_t low = 0) {
  if (value >= low) return;
  throw InvalidArgument(field + " = " + std::to_string(value) +
                        ", allowed are integers >= " + std::to_string(low));
}

constexpr const char* kNotNegative = "finite numbers >= 0";

void check_certificate(const Certificate& c) {
  check_count("certificate.count", c.count);
  check_range("certificate.fraction", c.fraction, 0.0, kNotNegative);
  for (std::size_t i = 0; i < c.groups.size(); ++i) {
    const std::string field = "certificate.groups[" + std::to_string(i) + "]";
    check_text(field + ".name", c.groups[i].name);
    check_count(field + ".count", c.groups[i].count);
    check_range(field + ".fraction", c.groups[i].fraction, 0.0, kNotNegative);
  }
  check_range("certificate.min_gap", c.min_gap, 0.0, kNotNegative);
  if (std::isnan(c.smallest_gap) || c.smallest_gap == -INFINITY) {
    throw InvalidArgument("certificate.smallest_gap = " + std::to_string(c.smallest_gap) +
                          ", allowed are finite numbers and +infinity");
  }
  if (!(c.smallest_gap_error >= 0.0)) {
    throw InvalidArgument(
        "certificate.smallest_gap_error = " + std::to_string(c.smallest_gap_error) +
        ", allowed are numbers >= 0 and +infinity");
  }
  check_count("certificate.worst_pair[0]", c.worst_pair[0], -1);
  check_count("certificate.worst_pair[1]", c.worst_pair[1], -1);
  check_count("certificate.overlaps", c.overlaps);
  check_count("certificate.gaps_below", c.gaps_below);
  check_count("certificate.outside_walls", c.outside_walls);
  check_count("certificate.pairs_checked", c.pairs_checked);
}

void check_provenance(const Provenance& p) {
  check_text("provenance.method", p.method);
  check_text("provenance.version", p.version);
  check_text("provenance.stop", p.stop);
  check_range("provenance.seconds", p.seconds, 0.0, kNotNegative);
  if (p.recipe_json.empty()) return;
  check_text("provenance.recipe", p.recipe_json);
  if (!nlohmann::json::parse(p.recipe_json, nullptr, false).is_object()) {
    throw InvalidArgument("provenance.recipe is not a JSON object");
  }
}

}  // namespace

// JSON text is UTF-8, and HDF5 ends its text at the first zero byte.
void check_text(const std::string& field, const std::string& text) {
  if (text.find('\0') != std::string::npos) {
    throw InvalidArgument(field + " holds a zero byte");
  }
  try {
    static_cast<void>(nlohmann::json(text).dump());
  } catch (const nlohmann::json::exception&) {
    throw InvalidArgument(field + " is not UTF-8 text");
  }
}

void check_format(std::string_view format, const FileFormat& expected) {
  if (format == expected.word) return;
  throw InvalidArgument("format is '" + std::string(format) + "', not a " +
                        std::string(expected.what) + " ('" + std::string(expected.word) + "')");
}

void check_version(std::int64_t version, const FileFormat& expected) {
  if (version == expected.version) return;
  throw InvalidArgument("version " + std::to_string(version) +
                        " is unknown; this program reads version " +
                        std::to_string(expected.version));
}

Cell stored_cell(const std::vector<double>& size, const std::vector<bool>& periodic) {
  if (size.size() != 2 && size.size() != 3) {
    throw InvalidArgument("cell.size: must have 2 or 3 numbers");
  }
  if (periodic.size() != size.size()) {
    throw InvalidArgument("cell.periodic: must have as many flags as cell.size has numbers");
  }
  Cell cell{static_cast<int>(size.size()), {0, 0, 0}, {false, false, false}};
  for (std::size_t axis = 0; axis < size.size(); ++axis) {
    cell.size[axis] = size[axis];
    cell.periodic[axis] = periodic[axis];
  }
  return cell;
}

void check_storable(const Packing& packing) {
  check_groups(packing.groups);
  check_well_formed(packing);
  if (packing.certificate) check_certificate(*packing.certificate);
  if (packing.provenance) check_provenance(*packing.provenance);
}

}  // namespace packstone
