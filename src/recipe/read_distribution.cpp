#include "recipe/read_distribution.hpp"

#include <cmath>
#include <filesystem>
#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/core/overloaded.hpp"
#include "recipe/size_table.hpp"

namespace packstone::recipe {
namespace {

constexpr const char* kForms =
    "a number, { uniform = [lo, hi] }, or { normal | lognormal | weibull | mixture | table = ... }";

// Reads the laws of one entry; remembers what holds for all parts of a mixture.
class LawReader {
 public:
  LawReader(Values values, Complaints& complaints) : values_(values), complaints_(complaints) {}

  // The law of a table that holds one law key, such as { uniform = [1, 2] }.
  std::optional<Distribution> read(const TableView& table) {
    const Entry law = only_law(table);
    if (!law) return std::nullopt;
    const std::string_view key = std::string_view(law.name).substr(law.name.rfind('.') + 1);
    if (key == "value") return read_constant(law);
    if (key == "uniform") return read_uniform(law);
    if (key == "mixture") return read_mixture(law);
    if (key == "table") return read_table(law);
    if (!law.node->is_table()) {
      complaints_.not_allowed(law, "a table such as { mean = 1, std = 0.1, min = 0.5, max = 2 }");
      return std::nullopt;
    }
    if (key == "normal") return read_normal(law);
    if (key == "lognormal") return read_lognormal(law);
    return read_weibull(law);
  }

  std::optional<Distribution> read_constant(const Entry& entry) {
    const auto value = read_number(entry, range(), complaints_);
    if (!value) return std::nullopt;
    return Distribution{ConstantLaw{*value}, Weighting::number};
  }

 private:
  Entry only_law(const TableView& table) {
    Entry found;
    int laws = 0;
    for (const std::string_view key :
         {"value", "uniform", "normal", "lognormal", "weibull", "mixture", "table"}) {
      if (const Entry entry = table[key]) {
        found = entry;
        ++laws;
      }
    }
    if (laws == 1) return found;
    if (laws == 0 && table.has_unknown_keys()) return {};  // a misspelled law, told already
    complaints_.not_allowed({&table.node(), table.name()}, std::string("one law: ") + kForms);
    return {};
  }

  [[nodiscard]] Range range() const {
    return values_ == Values::positive ? positive_number() : any_number();
  }

  std::optional<double> parameter(const TableView& table, std::string_view key,
                                  const Range& allowed) {
    const Entry entry = table[key];
    if (entry) return read_number(entry, allowed, complaints_);
    complaints_.missing(&table.node(), joined(table.name(), key), allowed.text);
    return std::nullopt;
  }

  // min and max into `law`, which holds their defaults.
  template <class Law>
  bool read_bounds(const TableView& table, Law& law) {
    const std::size_t before = complaints_.count();
    const Entry least = table["min"];
    const Entry greatest = table["max"];
    const Range lower = values_ == Values::positive ? not_negative_number() : any_number();
    if (least) law.min = read_number(least, lower, complaints_).value_or(law.min);
    if (greatest) law.max = read_number(greatest, range(), complaints_).value_or(law.max);
    if (complaints_.count() != before) return false;
    if (law.min < law.max) return true;
    const Entry named = greatest ? greatest : least;
    complaints_.not_allowed(
        named, "min < max, here min = " + number_text(law.min) + ", max = " + number_text(law.max));
    return false;
  }

  static std::string number_text(double x) { return shown(toml::value<double>{x}); }

  std::optional<Distribution> read_uniform(const Entry& entry) {
    const auto ends = read_numbers(entry, {2}, range(), complaints_);
    if (!ends) return std::nullopt;
    if ((*ends)[0] <= (*ends)[1]) {
      return Distribution{UniformLaw{(*ends)[0], (*ends)[1]}, Weighting::number};
    }
    complaints_.not_allowed(entry, "[lo, hi] with lo <= hi");
    return std::nullopt;
  }

  std::optional<Distribution> read_normal(const Entry& entry) {
    const TableView table(*entry.node->as_table(), entry.name, {"mean", "std", "min", "max"},
                          complaints_);
    const auto mean = parameter(table, "mean", any_number());
    const auto std = parameter(table, "std", not_negative_number());
    NormalLaw law;
    if (!mean || !std || !read_bounds(table, law)) return std::nullopt;
    law.mean = *mean;
    law.std = *std;
    return Distribution{law, Weighting::number};
  }

  std::optional<Distribution> read_lognormal(const Entry& entry) {
    const TableView table(*entry.node->as_table(), entry.name,
                          {"mean", "std", "mu", "sigma", "min", "max"}, complaints_);
    const bool by_moments = table["mean"] || table["std"];
    const bool by_logarithm = table["mu"] || table["sigma"];
    if (by_moments == by_logarithm) {
      complaints_.not_allowed(entry, "either mean and std, or mu and sigma of the logarithm");
      return std::nullopt;
    }
    LognormalLaw law;
    if (by_moments) {
      const auto mean = parameter(table, "mean", positive_number());
      const auto std = parameter(table, "std", positive_number());
      if (!mean || !std) return std::nullopt;
      law = lognormal_from_moments(*mean, *std);
    } else {
      const auto mu = parameter(table, "mu", any_number());
      const auto sigma = parameter(table, "sigma", not_negative_number());
      if (!mu || !sigma) return std::nullopt;
      law.mu = *mu;
      law.sigma = *sigma;
    }
    if (!read_bounds(table, law)) return std::nullopt;
    return Distribution{law, Weighting::number};
  }

  std::optional<Distribution> read_weibull(const Entry& entry) {
    const TableView table(*entry.node->as_table(), entry.name, {"shape", "scale", "min", "max"},
                          complaints_);
    const auto shape = parameter(table, "shape", positive_number());
    const auto scale = parameter(table, "scale", positive_number());
    WeibullLaw law;
    if (!shape || !scale || !read_bounds(table, law)) return std::nullopt;
    law.shape = *shape;
    law.scale = *scale;
    return Distribution{law, Weighting::number};
  }

  std::optional<Distribution> read_mixture(const Entry& entry) {
    const toml::array* const parts = entry.node->as_array();
    if (parts == nullptr || parts->empty()) {
      complaints_.not_allowed(
          entry, "a list of parts: [{ weight = 2, value = 1 }, { weight = 1, uniform = [1, 2] }]");
      return std::nullopt;
    }
    MixtureLaw mixture;
    double total = 0.0;
    for (std::size_t i = 0; i < parts->size(); ++i) {
      const Entry part = item(entry, i);
      if (!part.node->is_table()) {
        complaints_.not_allowed(part, "a part such as { weight = 1, uniform = [1, 2] }");
        continue;
      }
      const TableView table(
          *part.node->as_table(), part.name,
          {"weight", "value", "uniform", "normal", "lognormal", "weibull", "mixture", "table"},
          complaints_);
      const auto weight = parameter(table, "weight", not_negative_number());
      auto law = read(table);
      if (!weight || !law) continue;
      total += *weight;
      mixture.parts.push_back(std::move(*law));
      mixture.weights.push_back(*weight);
    }
    if (mixture.parts.size() != parts->size()) return std::nullopt;
    if (total > 0.0) return Distribution{std::move(mixture), Weighting::number};
    complaints_.not_allowed(entry, "parts whose weights sum to more than 0");
    return std::nullopt;
  }

  std::optional<Distribution> read_table(const Entry& entry) {
    auto law = entry.node->is_table() ? table_in_recipe(entry) : table_in_file(entry);
    if (!law) return std::nullopt;
    double total = 0.0;
    for (std::size_t i = 0; i < law->values.size(); ++i) {
      total += law->weights[i];
      if (range().holds(law->values[i])) continue;
      complaints_.not_allowed(entry, "values that are each " + range().text + "; value " +
                                         std::to_string(i + 1) + " is " +
                                         number_text(law->values[i]));
      return std::nullopt;
    }
    if (total > 0.0) return Distribution{std::move(*law), Weighting::number};
    complaints_.not_allowed(entry, "weights that sum to more than 0");
    return std::nullopt;
  }

  std::optional<TableLaw> table_in_recipe(const Entry& entry) {
    const TableView table(*entry.node->as_table(), entry.name, {"values", "weights"}, complaints_);
    for (const std::string_view key : {"values", "weights"}) {
      const toml::array* const list = table.node()[key].as_array();
      if (list != nullptr && !list->empty()) continue;
      complaints_.missing(&table.node(), joined(table.name(), key), "a list of numbers");
      return std::nullopt;
    }
    const std::size_t size = table["values"].node->as_array()->size();
    auto values = read_numbers(table["values"], {size}, any_number(), complaints_);
    auto weights = read_numbers(table["weights"], {size}, not_negative_number(), complaints_);
    if (!values || !weights) return std::nullopt;
    return TableLaw{std::move(*values), std::move(*weights)};
  }

  std::optional<TableLaw> table_in_file(const Entry& entry) {
    const auto file = entry.node->value_exact<std::string>();
    if (!file || file->empty()) {
      complaints_.not_allowed(entry,
                              "the name of a file with lines \"value, weight\", beside the recipe");
      return std::nullopt;
    }
    try {
      const std::filesystem::path folder =
          std::filesystem::path(complaints_.origin()).parent_path();
      return read_size_table(folder / *file);
    } catch (const FileError& error) {
      complaints_.add(entry.node, entry.name + " = " + shown(*entry.node) + "; " + error.what());
      return std::nullopt;
    }
  }

  Values values_;
  Complaints& complaints_;
};

std::optional<Weighting> read_weighting(const TableView& table, Weightable weightable,
                                        Complaints& complaints) {
  const Entry by = table["by"];
  if (!by) return Weighting::number;
  if (weightable == Weightable::no) {
    return read_choice<Weighting>(by, {{"number", Weighting::number}}, complaints);
  }
  return read_choice<Weighting>(by, {{"number", Weighting::number}, {"volume", Weighting::volume}},
                                complaints);
}

}  // namespace

std::optional<Distribution> read_distribution(const Entry& entry, Values values,
                                              Weightable weightable, Complaints& complaints) {
  LawReader reader(values, complaints);
  if (entry.node->is_number()) return reader.read_constant(entry);
  if (!entry.node->is_table()) {
    complaints.not_allowed(entry,
                           values == Values::positive ? std::string(kForms) + ", all > 0" : kForms);
    return std::nullopt;
  }
  const TableView table(
      *entry.node->as_table(), entry.name,
      {"value", "uniform", "normal", "lognormal", "weibull", "mixture", "table", "by"}, complaints);
  auto law = reader.read(table);
  const auto by = read_weighting(table, weightable, complaints);
  if (!law || !by) return std::nullopt;
  law->by = *by;
  try {
    check_distribution(*law, entry.name);
  } catch (const InvalidArgument& error) {
    complaints.add(entry.node, error.what());
    return std::nullopt;
  }
  if (values == Values::any || support_of(*law).min > 0.0) return law;
  complaints.not_allowed(entry, "a law of numbers > 0; give it a min > 0");
  return std::nullopt;
}

Distribution scaled(Distribution law, double factor) {
  const auto bounds = [factor](auto& l) {
    // Bounds that are absent stay so.
    if (l.min > -kNoBound) l.min *= factor;
    if (l.max < kNoBound) l.max *= factor;
  };
  std::visit(Overloaded{[&](ConstantLaw& l) { l.value *= factor; },
                        [&](UniformLaw& l) {
                          l.lo *= factor;
                          l.hi *= factor;
                        },
                        [&](NormalLaw& l) {
                          l.mean *= factor;
                          l.std *= factor;
                          bounds(l);
                        },
                        [&](LognormalLaw& l) {
                          l.mu += std::log(factor);
                          bounds(l);
                        },
                        [&](WeibullLaw& l) {
                          l.scale *= factor;
                          bounds(l);
                        },
                        [&](TableLaw& l) {
                          for (double& value : l.values) value *= factor;
                        },
                        [&](MixtureLaw& l) {
                          for (Distribution& part : l.parts) part = scaled(part, factor);
                        }},
             law.law);
  return law;
}

}  // namespace packstone::recipe
