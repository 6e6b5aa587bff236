#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/inclusion_record.hpp"
#include "io/json_fields.hpp"
#include "io/storable.hpp"
#include "packstone/core/error.hpp"
#include "packstone/io/packing_file.hpp"

namespace packstone {
namespace {

std::string in_quotes(std::string_view text) { return std::string("'").append(text) + "'"; }

/// Reads one inclusion after the other from parser events, without a tree in between: a million of
/// them pass here.
class InclusionReader {
 public:
  void open_object() {
    if (inside_) refuse_value();
    inside_ = true;
    seen_.fill(0);
    group_.reset();
    shape_.reset();
  }

  void close_object() {
    if (!group_) refuse("field 'group' is missing");
    if (!shape_) refuse("field 'shape' is missing");
    for (std::size_t i = 0; i < kNumberFields; ++i) check_field(static_cast<NumberField>(i));
    inclusions_.push_back({record_.center(dimension(*shape_)), record_.body(*shape_), *group_});
    inside_ = false;
  }

  void key(const std::string& name_in_file) {
    key_ = find_key(name_in_file);
    if (key_ == kUnknownKey) {
      refuse("unknown field " + in_quotes(name_in_file) +
             "; known are group, shape, center, radius, half_length, axis, axes, quaternion, "
             "angle");
    }
    const bool again = key_ == kGroupKey   ? group_.has_value()
                       : key_ == kShapeKey ? shape_.has_value()
                                           : seen_[static_cast<std::size_t>(key_)] > 0;
    if (again) refuse("field " + in_quotes(name_in_file) + " stands twice");
  }

  void open_array() {
    if (!inside_ || in_array_ || key_ >= kGroupKey || !is_array(field())) refuse_value();
    in_array_ = true;
  }

  void close_array() {
    in_array_ = false;
    if (count() == 0) refuse(field_name() + " is empty");
  }

  void scalar(const Json& value) {
    if (!inside_) refuse_value();
    if (key_ >= kGroupKey) return read_word(value);
    if (!value.is_number() || in_array_ != is_array(field())) refuse_value();
    if (count() == InclusionRecord::kMaxNumbers) refuse(field_name() + " has too many numbers");
    record_[field()][static_cast<std::size_t>(count()++)] = value.get<double>();
  }

  /// Inside an inclusion, rather than between two.
  [[nodiscard]] bool inside() const { return inside_; }
  [[nodiscard]] bool in_array() const { return in_array_; }
  /// "inclusion 7": the one now being read.
  [[nodiscard]] std::string place() const {
    return "inclusion " + std::to_string(inclusions_.size());
  }

  [[nodiscard]] std::vector<Inclusion> take_inclusions() { return std::move(inclusions_); }
  /// By first appearance, which is how the inclusions number them.
  [[nodiscard]] const std::vector<std::string>& groups() const { return groups_; }

 private:
  // Keys below these are values of NumberField.
  static constexpr int kGroupKey = static_cast<int>(kNumberFields);
  static constexpr int kShapeKey = kGroupKey + 1;
  static constexpr int kUnknownKey = kGroupKey + 2;

  static int find_key(std::string_view key) {
    if (key == "group") return kGroupKey;
    if (key == "shape") return kShapeKey;
    for (int i = 0; i < kGroupKey; ++i) {
      if (key == name(static_cast<NumberField>(i))) return i;
    }
    return kUnknownKey;
  }

  void check_field(NumberField number_field) const {
    const int found = seen_[static_cast<std::size_t>(number_field)];
    const int wanted = arity(number_field, *shape_);
    if (found == wanted) return;
    const std::string field_text(name(number_field));
    const std::string shape_text(name(*shape_));
    if (wanted == 0)
      refuse("field " + in_quotes(field_text) + " does not belong to a " + shape_text);
    if (found == 0)
      refuse("field " + in_quotes(field_text) + " of a " + shape_text + " is missing");
    refuse(field_text + " of a " + shape_text + " must have " + std::to_string(wanted) +
           " numbers, found " + std::to_string(found));
  }

  void read_word(const Json& value) {
    if (!value.is_string()) refuse_value();
    const auto& word = value.get_ref<const std::string&>();
    if (key_ == kGroupKey) {
      group_ = group_index(word);
      return;
    }
    for (std::size_t i = 0; i < kShapeKinds; ++i) {
      if (word == name(static_cast<ShapeKind>(i))) shape_ = static_cast<ShapeKind>(i);
    }
    if (!shape_) {
      refuse("unknown shape " + in_quotes(word) +
             "; known are sphere, ellipsoid, cylinder, spherocylinder, disk, ellipse");
    }
  }

  int group_index(const std::string& group) {
    const auto [entry, is_new] = index_.try_emplace(group, static_cast<int>(groups_.size()));
    if (is_new) groups_.push_back(group);
    return entry->second;
  }

  [[nodiscard]] NumberField field() const { return static_cast<NumberField>(key_); }
  [[nodiscard]] std::string field_name() const {
    return key_ == kGroupKey ? "group" : key_ == kShapeKey ? "shape" : std::string(name(field()));
  }
  int& count() { return seen_[static_cast<std::size_t>(key_)]; }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InvalidArgument(place() + ": " + problem);
  }
  [[noreturn]] void refuse_value() const {
    if (!inside_) refuse("must be an object");
    refuse(field_name() + " must be " +
           (key_ >= kGroupKey   ? "text"
            : is_array(field()) ? "an array of numbers"
                                : "a number"));
  }

  bool inside_ = false;
  bool in_array_ = false;
  int key_ = kUnknownKey;
  std::array<int, kNumberFields> seen_{};  ///< Numbers read, by field.
  std::optional<int> group_;
  std::optional<ShapeKind> shape_;
  InclusionRecord record_;
  std::vector<Inclusion> inclusions_;
  std::vector<std::string> groups_;
  std::unordered_map<std::string, int> index_;
};

/// The events of the parser: inclusions go to the InclusionReader, all else into a tree.
class PackingEvents {
 public:
  bool null() { return scalar(nullptr); }
  bool boolean(bool value) { return scalar(value); }
  bool number_integer(std::int64_t value) { return scalar(value); }
  bool number_unsigned(std::uint64_t value) { return scalar(value); }
  bool number_float(double value, const std::string&) { return scalar(value); }
  bool string(std::string& value) { return scalar(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }  // JSON text has none

  bool key(std::string& name_in_file) {
    if (in_inclusions_) {
      inclusions.key(name_in_file);
    } else {
      tree.key(std::move(name_in_file));
    }
    return true;
  }

  bool start_object(std::size_t) {
    if (in_inclusions_) {
      inclusions.open_object();
    } else {
      tree.open(Json::object());
    }
    return true;
  }

  bool end_object() {
    if (in_inclusions_) {
      inclusions.close_object();
    } else {
      tree.close();
    }
    return true;
  }

  bool start_array(std::size_t) {
    if (in_inclusions_) {
      inclusions.open_array();
      return true;
    }
    in_inclusions_ = tree.depth() == 1 && tree.current_key() == "inclusions";
    tree.open(Json::array());
    return true;
  }

  bool end_array() {
    if (in_inclusions_ && inclusions.in_array()) {
      inclusions.close_array();
      return true;
    }
    in_inclusions_ = false;
    tree.close();
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& problem) {
    syntax_error = problem.what();
    if (in_inclusions_) syntax_error += " (in " + inclusions.place() + ")";
    return false;
  }

  InclusionReader inclusions;
  JsonTreeBuilder tree;
  std::string syntax_error;

 private:
  bool scalar(Json value) {
    if (in_inclusions_) {
      inclusions.scalar(value);
      return true;
    }
    // At once, before the rest of a foreign file gives misleading complaints.
    if (tree.depth() == 1 && tree.current_key() == "format") {
      check_format(as_text(value, "format"), kPackingFormat);
    }
    if (tree.depth() == 1 && tree.current_key() == "version") {
      check_version(as_integer(value, "version"), kPackingFormat);
    }
    tree.scalar(std::move(value));
    return true;
  }

  bool in_inclusions_ = false;
};

// "[json.exception.parse_error.101] parse error at line 3, column 5: ..." without its first words.
std::string without_prefix(const std::string& message) {
  const auto start = message.find("line ");
  if (start != std::string::npos) return message.substr(start);
  const auto bracket = message.find("] ");
  return bracket == std::string::npos ? message : message.substr(bracket + 2);
}

Cell read_cell(const Json& json) {
  JsonFields fields(json, "cell");
  std::vector<double> size;
  std::vector<bool> periodic;
  for (const Json& one : fields.array("size")) size.push_back(as_number(one, "cell.size"));
  for (const Json& one : fields.array("periodic")) {
    periodic.push_back(as_flag(one, "cell.periodic"));
  }
  fields.finish();
  return stored_cell(size, periodic);
}

std::vector<GroupCensus> read_census(const Json& array) {
  std::vector<GroupCensus> census;
  for (const Json& entry : array) {
    JsonFields fields(entry, "certificate.groups[" + std::to_string(census.size()) + "]");
    census.push_back({fields.text("name"), fields.integer("count"), fields.number("fraction")});
    fields.finish();
  }
  return census;
}

template <class Integer, std::size_t n>
void read_integers(const Json& array, const std::string& where, std::array<Integer, n>& values) {
  const std::string expected = where + ": must have " + std::to_string(n) + " integers";
  if (array.size() != n) throw InvalidArgument(expected);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t value = as_integer(array[i], where);
    if (value < std::numeric_limits<Integer>::min() ||
        value > std::numeric_limits<Integer>::max()) {
      throw InvalidArgument(where + " = " + std::to_string(value) + " is out of range");
    }
    values[i] = static_cast<Integer>(value);
  }
}

Certificate read_certificate(const Json& json) {
  JsonFields fields(json, "certificate");
  Certificate c;
  c.count = fields.integer("count");
  c.fraction = fields.number("fraction");
  c.groups = read_census(fields.array("groups"));
  c.min_gap = fields.number("min_gap");
  c.smallest_gap = fields.number_or_infinity("smallest_gap");
  c.smallest_gap_error = fields.number_or_infinity("smallest_gap_error");
  read_integers(fields.array("worst_pair"), "certificate.worst_pair", c.worst_pair);
  read_integers(fields.array("worst_image"), "certificate.worst_image", c.worst_image);
  c.overlaps = fields.integer("overlaps");
  c.gaps_below = fields.integer("gaps_below");
  c.outside_walls = fields.integer("outside_walls");
  c.pairs_checked = fields.integer("pairs_checked");
  fields.finish();
  return c;
}

Provenance read_provenance(const Json& json) {
  JsonFields fields(json, "provenance");
  Provenance p;
  if (fields.has("recipe")) p.recipe_json = fields.object("recipe").dump();
  p.seed = fields.unsigned_integer("seed");
  p.method = fields.text("method");
  p.version = fields.text("version");
  p.stop = fields.text("stop");
  p.seconds = fields.number("seconds");
  fields.finish();
  return p;
}

// Inclusions were numbered by the first appearance of their group; the list of the file rules.
void apply_group_list(const Json& list, const std::vector<std::string>& seen, Packing& packing) {
  std::unordered_map<std::string, int> index;
  for (const Json& name_in_file : list) {
    const std::string where = "groups[" + std::to_string(packing.groups.size()) + "]";
    packing.groups.push_back(as_text(name_in_file, where));
    index.try_emplace(packing.groups.back(), static_cast<int>(packing.groups.size()) - 1);
  }
  std::vector<int> renumbered;
  for (const std::string& group : seen) {
    const auto found = index.find(group);
    renumbered.push_back(found == index.end() ? -1 : found->second);
  }
  for (std::size_t i = 0; i < packing.inclusions.size(); ++i) {
    int& group = packing.inclusions[i].group;
    const std::string& group_name = seen[static_cast<std::size_t>(group)];
    group = renumbered[static_cast<std::size_t>(group)];
    if (group >= 0) continue;
    throw InvalidArgument("inclusion " + std::to_string(i) + ": group " + in_quotes(group_name) +
                          " is not in the list 'groups' of the file");
  }
}

Packing assemble(PackingEvents& events) {
  JsonFields fields(events.tree.root(), "the packing");
  static_cast<void>(fields.text("format"));  // checked when they were met
  static_cast<void>(fields.integer("version"));
  Packing packing;
  packing.cell = read_cell(fields.object("cell"));
  static_cast<void>(fields.array("inclusions"));
  packing.inclusions = events.inclusions.take_inclusions();
  if (fields.has("groups")) {
    apply_group_list(fields.array("groups"), events.inclusions.groups(), packing);
  } else {
    packing.groups = events.inclusions.groups();
  }
  if (fields.has("certificate"))
    packing.certificate = read_certificate(fields.object("certificate"));
  if (fields.has("provenance")) packing.provenance = read_provenance(fields.object("provenance"));
  fields.finish();
  check_storable(packing);
  return packing;
}

}  // namespace

Packing packing_from_json(std::string_view text, const std::string& origin) {
  try {
    PackingEvents events;
    if (!Json::sax_parse(text.begin(), text.end(), &events)) {
      throw FileError(origin + ", " + without_prefix(events.syntax_error));
    }
    return assemble(events);
  } catch (const InvalidArgument& problem) {
    throw FileError(origin + ": " + problem.what());
  }
}

}  // namespace packstone
