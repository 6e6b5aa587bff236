#include "recipe/read_inclusions.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "recipe/read_distribution.hpp"
#include "recipe/read_orientation.hpp"

namespace packstone::recipe {
namespace {

using Keys = std::vector<std::string_view>;

const Keys kSizeKeys{"size",        "radius",    "diameter", "length",
                     "half_length", "semi_axes", "volume",   "area"};

constexpr ShapeKind kShapes[] = {ShapeKind::sphere,   ShapeKind::ellipsoid,
                                 ShapeKind::cylinder, ShapeKind::spherocylinder,
                                 ShapeKind::disk,     ShapeKind::ellipse};

Keys known_keys() {
  Keys keys{"name", "shape", "count", "fraction", "aspect", "orientation"};
  keys.insert(keys.end(), kSizeKeys.begin(), kSizeKeys.end());
  return keys;
}

// The size keys that `shape` can have.
Keys size_keys_of(ShapeKind shape) {
  Keys keys;
  if (is_round(shape)) keys = {"radius", "diameter"};
  if (is_rod(shape)) keys = {"diameter", "length", "radius", "half_length"};
  if (keys.empty()) keys = {"semi_axes"};
  keys.push_back(dimension(shape) == 2 ? "area" : "volume");
  keys.push_back("size");
  return keys;
}

bool holds(const Keys& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::optional<ShapeKind> read_shape(const TableView& table, int dimension_of_cell,
                                    Complaints& complaints) {
  std::vector<std::pair<std::string_view, ShapeKind>> choices;
  std::string listed;
  for (const ShapeKind shape : kShapes) {
    if (dimension_of_cell != 0 && dimension(shape) != dimension_of_cell) continue;
    choices.emplace_back(packstone::name(shape), shape);
    listed += (listed.empty() ? "\"" : ", \"") + std::string(packstone::name(shape)) + "\"";
  }
  const Entry entry = table["shape"];
  const auto word = entry ? entry.node->value_exact<std::string>() : std::nullopt;
  for (const ShapeKind shape : kShapes) {
    if (word != packstone::name(shape) || dimension_of_cell == 0) continue;
    if (dimension(shape) == dimension_of_cell) continue;
    complaints.not_allowed(entry, "one of " + listed + " in a " +
                                      std::to_string(dimension_of_cell) +
                                      "D cell (cell.size has as many numbers)");
    return std::nullopt;
  }
  if (entry) return read_choice<ShapeKind>(entry, choices, complaints);
  complaints.missing(&table.node(), joined(table.name(), "shape"), "one of " + listed);
  return std::nullopt;
}

// What is ordered of one group; reads into `group` and complains where it is too little or too
// much.
class GroupReader {
 public:
  GroupReader(const TableView& table, InclusionGroup& group, Complaints& complaints)
      : table_(table), group_(group), complaints_(complaints) {}

  void read() {
    read_order();
    read_sizes();
    read_aspect();
    read_turn();
  }

 private:
  void read_order() {
    if (const Entry count = table_["count"]) {
      if (const auto value = read_integer(count, 1, complaints_)) group_.count = *value;
    }
    if (const Entry fraction = table_["fraction"]) {
      const auto value = read_number(fraction, fraction_number(), complaints_);
      if (value) group_.fraction = *value;
    }
  }

  void read_sizes() {
    const Keys own = size_keys_of(group_.shape);
    Keys given;
    for (const std::string_view key : kSizeKeys) {
      if (!table_[key]) continue;
      if (holds(own, key)) {
        given.push_back(key);
      } else {
        complaints_.add(table_[key].node, joined(table_.name(), key) + " does not belong to " +
                                              article() + "; its size keys are " + list_of(own));
        misplaced_ = true;
      }
    }
    // A key that is present but wrong counts as given, so that one mistake makes one message.
    const bool count = static_cast<bool>(table_["count"]);
    const bool fraction = static_cast<bool>(table_["fraction"]);
    if (count && fraction) return read_relative_size(given);
    if (given.empty()) return too_little(count, fraction, own);
    read_absolute_size(given);
  }

  void too_little(bool count, bool fraction, const Keys& own) {
    if (misplaced_) return;
    const std::string found = count      ? "only count is given"
                              : fraction ? "only fraction is given"
                                         : "none is given";
    complaints_.add(&table_.node(), table_.name() + " needs two of count, fraction and a size (" +
                                        list_of(own) + "); " + found);
  }

  void read_relative_size(const Keys& given) {
    for (const std::string_view key : given) {
      if (key == "size") continue;
      complaints_.add(table_[key].node,
                      joined(table_.name(), key) +
                          " is too much: count and fraction already fix the size; drop one of the "
                          "three");
    }
    if (holds(given, "size")) read_law("size", SizeMeasure::relative, 1.0);
  }

  void read_absolute_size(const Keys& given) {
    if (given.size() == 2 && is_rod(group_.shape) && radial(given) && axial(given)) {
      return read_rod_dimensions(*radial(given), *axial(given));
    }
    if (given.size() > 1) {
      complaints_.add(table_[given[1]].node, joined(table_.name(), given[1]) + " is too much: " +
                                                 std::string(given[0]) + " already gives the size");
      return;
    }
    const std::string_view key = given.front();
    if (key == "semi_axes") return read_semi_axes();
    if (key == "size") return read_law(key, SizeMeasure::equivalent, 1.0);
    if (key == "volume" || key == "area") return read_law(key, SizeMeasure::volume, 1.0);
    if (key == "radius") return read_law(key, SizeMeasure::radius, 1.0);
    if (key == "diameter") return read_law(key, SizeMeasure::radius, 0.5);
    if (key == "half_length") return read_law(key, SizeMeasure::half_length, 1.0);
    read_law(key, SizeMeasure::half_length, 0.5);
  }

  static std::optional<std::string_view> radial(const Keys& given) {
    return first_of(given, "diameter", "radius");
  }
  static std::optional<std::string_view> axial(const Keys& given) {
    return first_of(given, "length", "half_length");
  }
  static std::optional<std::string_view> first_of(const Keys& given, std::string_view a,
                                                  std::string_view b) {
    if (holds(given, a)) return a;
    if (holds(given, b)) return b;
    return std::nullopt;
  }

  void read_law(std::string_view key, SizeMeasure measure, double factor) {
    auto law = read_distribution(table_[key], Values::positive, Weightable::yes, complaints_);
    if (!law) return;
    group_.measure = measure;
    group_.size = factor == 1.0 ? std::move(*law) : scaled(std::move(*law), factor);
  }

  void read_rod_dimensions(std::string_view across, std::string_view along) {
    fixed_ = true;
    const Range plain{
        "a number > 0; a length beside it may be a distribution, for a distribution of diameters "
        "give one of them and aspect",
        0.0, std::numeric_limits<double>::infinity(), true, false};
    const auto width = read_number(table_[across], plain, complaints_);
    auto length = read_distribution(table_[along], Values::positive, weightable(), complaints_);
    if (!width || !length) return;
    const double radius = across == "diameter" ? 0.5 * *width : *width;
    const double half = along == "length" ? 0.5 : 1.0;
    if (const auto* const constant = std::get_if<ConstantLaw>(&length->law)) {
      group_.dimensions = Vec3{radius, half * constant->value, 0.0};
      return;
    }
    group_.measure = SizeMeasure::radius;
    group_.size.law = ConstantLaw{radius};
    group_.aspect = scaled(std::move(*length), half / radius);
    if (is_usable(group_.aspect)) return;
    complaints_.not_allowed(table_[along], "a law whose values over the diameter are finite");
  }

  // Of cylinders of one diameter alone the volume is in proportion to the length.
  [[nodiscard]] Weightable weightable() const {
    return group_.shape == ShapeKind::cylinder ? Weightable::yes : Weightable::no;
  }

  static bool is_usable(const Distribution& aspect) {
    try {
      check_distribution(aspect, "aspect");
      const Support support = support_of(aspect, 1);
      return support.min > 0.0 && std::isfinite(support.max);
    } catch (const InvalidArgument&) {
      return false;
    }
  }

  void read_semi_axes() {
    fixed_ = true;
    const std::size_t count = group_.shape == ShapeKind::ellipse ? 2 : 3;
    const auto axes = read_numbers(table_["semi_axes"], {count}, positive_number(), complaints_);
    if (axes) group_.dimensions = Vec3{(*axes)[0], (*axes)[1], count == 3 ? (*axes)[2] : 0.0};
  }

  void read_aspect() {
    const Entry aspect = table_["aspect"];
    const std::string meaning = is_rod(group_.shape)                 ? "its length / diameter"
                                : group_.shape == ShapeKind::ellipse ? "its a/b"
                                                                     : "its [a/b, a/c]";
    if (is_round(group_.shape) || fixed_) {
      if (!aspect) return;
      complaints_.add(aspect.node,
                      aspect.name + " is too much: " +
                          (fixed_ ? "the size keys already give it" : article() + " has none"));
      return;
    }
    if (!aspect) {
      complaints_.add(&table_.node(), table_.name() + ".aspect is missing; " + article() +
                                          " needs " + meaning + ", a number > 0 or a distribution");
      return;
    }
    if (group_.shape == ShapeKind::ellipsoid && aspect.node->is_array()) {
      return read_aspect_pair(aspect);
    }
    const bool one_diameter = group_.measure == SizeMeasure::radius && is_constant(group_.size);
    auto law = read_distribution(aspect, Values::positive,
                                 one_diameter ? weightable() : Weightable::no, complaints_);
    if (!law) return;
    group_.aspect = *law;
    group_.spheroid = group_.shape == ShapeKind::ellipsoid;
  }

  void read_aspect_pair(const Entry& aspect) {
    if (aspect.node->as_array()->size() != 2) {
      return complaints_.not_allowed(aspect, "a number, a distribution, or a pair [a/b, a/c]");
    }
    auto first = read_distribution(item(aspect, 0), Values::positive, Weightable::no, complaints_);
    auto second = read_distribution(item(aspect, 1), Values::positive, Weightable::no, complaints_);
    if (first) group_.aspect = std::move(*first);
    if (second) group_.aspect_second = std::move(*second);
  }

  void read_turn() {
    const Entry orientation = table_["orientation"];
    if (!orientation) return;
    if (is_round(group_.shape)) {
      complaints_.add(orientation.node, orientation.name + " is too much: " + article() +
                                            " looks the same from all sides");
      return;
    }
    auto law = read_orientation(orientation, dimension(group_.shape), complaints_);
    if (law) group_.orientation = std::move(*law);
  }

  [[nodiscard]] std::string article() const {
    const std::string word(packstone::name(group_.shape));
    return (word.front() == 'e' ? "an " : "a ") + word;
  }

  const TableView& table_;
  InclusionGroup& group_;
  Complaints& complaints_;
  bool fixed_ = false;      // the size keys fix the aspect too
  bool misplaced_ = false;  // a size key of another shape stands here
};

}  // namespace

std::optional<InclusionGroup> read_inclusions(const Entry& entry, int dimension,
                                              Complaints& complaints) {
  if (!entry.node->is_table()) {
    complaints.not_allowed(entry, "a table [[inclusions]]");
    return std::nullopt;
  }
  const std::size_t before = complaints.count();
  const TableView table(*entry.node->as_table(), entry.name, known_keys(), complaints);
  InclusionGroup group;
  if (const Entry name = table["name"]) {
    group.name = name.node->value_exact<std::string>().value_or("");
    if (group.name.empty()) complaints.not_allowed(name, "a text that is not empty");
  }
  const auto shape = read_shape(table, dimension, complaints);
  if (!shape) return std::nullopt;
  group.shape = *shape;
  GroupReader(table, group, complaints).read();
  if (complaints.count() != before) return std::nullopt;
  return group;
}

void note_places(const Entry& entry, const Complaints& complaints,
                 std::map<std::string, std::string>& places) {
  const toml::table& table = *entry.node->as_table();
  places[entry.name] = complaints.place(entry.node) + ": " + entry.name;
  for (const auto& [key, value] : table) {
    const bool is_size = holds(kSizeKeys, key.str());
    // The last size key: of a rod's two the length, which is what is mostly too large.
    places[joined(entry.name, is_size ? "size" : key.str())] =
        complaints.place(&value) + ": " + quoted({&value, joined(entry.name, key.str())});
  }
}

}  // namespace packstone::recipe
