#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "io/storable.hpp"
#include "packstone/core/overloaded.hpp"
#include "packstone/io/packing_file.hpp"

namespace packstone {
namespace {

/// JSON text, appended piece by piece: the inclusions are many, and each stands on its own line.
class JsonText {
 public:
  JsonText& raw(std::string_view text) {
    text_ += text;
    return *this;
  }

  /// The shortest decimal that reads back as the same double.
  JsonText& number(double value) {
    if (value == 0.0) return raw(std::signbit(value) ? "-0.0" : "0");
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return raw({buffer, end});
  }
  /// Infinity, which JSON does not have, is null.
  JsonText& number_or_null(double value) { return std::isinf(value) ? raw("null") : number(value); }
  template <class Integer>
  JsonText& integer(Integer value) {
    return raw(std::to_string(value));
  }
  JsonText& string(const std::string& text) { return raw(nlohmann::json(text).dump()); }

  /// `items` between brackets, each by `write`.
  template <class Items, class Write>
  JsonText& list(const Items& items, Write write) {
    raw("[");
    const char* separator = "";
    for (const auto& item : items) {
      raw(separator);
      write(item);
      separator = ", ";
    }
    return raw("]");
  }
  JsonText& numbers(std::initializer_list<double> values) {
    return list(values, [this](double value) { number(value); });
  }
  JsonText& vector(const Vec3& v, int dimension) {
    return dimension == 2 ? numbers({v.x, v.y}) : numbers({v.x, v.y, v.z});
  }

  [[nodiscard]] std::string take() { return std::move(text_); }
  void reserve(std::size_t bytes) { text_.reserve(bytes); }

 private:
  std::string text_;
};

template <class Rod>
void write_rod(JsonText& out, const Rod& b) {
  out.raw(", \"radius\": ").number(b.radius).raw(", \"half_length\": ").number(b.half_length);
  out.raw(", \"axis\": ").vector(b.axis, 3);
}

void write_body(JsonText& out, const Body& body) {
  std::visit(Overloaded{[&](const Sphere& b) { out.raw(", \"radius\": ").number(b.radius); },
                        [&](const Ellipsoid& b) {
                          const Quaternion& q = b.orientation;
                          out.raw(", \"axes\": ").vector(b.semi_axes, 3);
                          out.raw(", \"quaternion\": ").numbers({q.w, q.x, q.y, q.z});
                        },
                        [&](const Cylinder& b) { write_rod(out, b); },
                        [&](const Spherocylinder& b) { write_rod(out, b); },
                        [&](const Disk& b) { out.raw(", \"radius\": ").number(b.radius); },
                        [&](const Ellipse& b) {
                          out.raw(", \"axes\": ").numbers({b.semi_axes.x, b.semi_axes.y});
                          out.raw(", \"angle\": ").number(b.angle);
                        }},
             body);
}

void write_cell(JsonText& out, const Cell& cell) {
  out.raw("  \"cell\": { \"size\": ").vector(cell.size, cell.dimension).raw(", \"periodic\": [");
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    out.raw(axis == 0 ? "" : ", ").raw(cell.periodic[axis] ? "true" : "false");
  }
  out.raw("] }");
}

void write_inclusions(JsonText& out, const Packing& packing) {
  std::vector<std::string> heads;
  for (const std::string& group : packing.groups) {
    heads.push_back("\n    { \"group\": " + nlohmann::json(group).dump() + ", \"shape\": \"");
  }
  out.raw("  \"inclusions\": [");
  const char* separator = "";
  for (const Inclusion& inclusion : packing.inclusions) {
    out.raw(separator).raw(heads[static_cast<std::size_t>(inclusion.group)]);
    out.raw(name(kind(inclusion.body))).raw("\", \"center\": ");
    out.vector(inclusion.center, packing.cell.dimension);
    write_body(out, inclusion.body);
    out.raw(" }");
    separator = ",";
  }
  out.raw(packing.inclusions.empty() ? "]" : "\n  ]");
}

void write_certificate(JsonText& out, const Certificate& c) {
  out.raw(",\n  \"certificate\": {\n    \"count\": ").integer(c.count);
  out.raw(",\n    \"fraction\": ").number(c.fraction);
  out.raw(",\n    \"groups\": ").list(c.groups, [&](const GroupCensus& group) {
    out.raw("\n      { \"name\": ").string(group.name);
    out.raw(", \"count\": ").integer(group.count);
    out.raw(", \"fraction\": ").number(group.fraction).raw(" }");
  });
  out.raw(",\n    \"min_gap\": ").number(c.min_gap);
  out.raw(",\n    \"smallest_gap\": ").number_or_null(c.smallest_gap);
  out.raw(",\n    \"smallest_gap_error\": ").number_or_null(c.smallest_gap_error);
  const auto integer = [&](auto value) { out.integer(value); };
  out.raw(",\n    \"worst_pair\": ").list(c.worst_pair, integer);
  out.raw(",\n    \"worst_image\": ").list(c.worst_image, integer);
  out.raw(",\n    \"overlaps\": ").integer(c.overlaps);
  out.raw(",\n    \"gaps_below\": ").integer(c.gaps_below);
  out.raw(",\n    \"outside_walls\": ").integer(c.outside_walls);
  out.raw(",\n    \"pairs_checked\": ").integer(c.pairs_checked).raw("\n  }");
}

void write_provenance(JsonText& out, const Provenance& p) {
  out.raw(",\n  \"provenance\": {\n");
  if (!p.recipe_json.empty()) {
    out.raw("    \"recipe\": ").raw(nlohmann::ordered_json::parse(p.recipe_json).dump());
    out.raw(",\n");
  }
  out.raw("    \"seed\": ").integer(p.seed).raw(",\n    \"method\": ").string(p.method);
  out.raw(",\n    \"version\": ").string(p.version).raw(",\n    \"stop\": ").string(p.stop);
  out.raw(",\n    \"seconds\": ").number(p.seconds).raw("\n  }");
}

}  // namespace

std::string packing_to_json(const Packing& packing) {
  check_storable(packing);
  JsonText out;
  constexpr std::size_t kTypicalLine = 240;
  out.reserve(4096 + kTypicalLine * packing.inclusions.size());
  out.raw("{\n  \"format\": \"").raw(kPackingFormat.word).raw("\",\n  \"version\": ");
  out.integer(kPackingFormat.version).raw(",\n");
  write_cell(out, packing.cell);
  out.raw(",\n  \"groups\": ").list(packing.groups, [&](const auto& name) { out.string(name); });
  out.raw(",\n");
  write_inclusions(out, packing);
  if (packing.certificate) write_certificate(out, *packing.certificate);
  if (packing.provenance) write_provenance(out, *packing.provenance);
  return out.raw("\n}\n").take();
}

}  // namespace packstone
