#include "recipe/read_packing.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "packstone/core/number_text.hpp"
#include "recipe/packing_words.hpp"
#include "recipe/time_text.hpp"

namespace packstone::recipe {
namespace {

constexpr std::int64_t kMostCandidates = 1'000'000;
constexpr std::int64_t kMostDrops = 10'000;
const Range kShare{.text = "a number >= 0 and <= 1", .lo = 0.0, .hi = 1.0};

// The readers of values that may be absent: `value` then stays as it is, as it does when what
// stands there is not allowed.

void read_into(const Entry& entry, bool& value, Complaints& complaints) {
  if (entry) value = read_flag(entry, complaints).value_or(value);
}

void read_into(const Entry& entry, const Range& range, double& value, Complaints& complaints) {
  if (entry) value = read_number(entry, range, complaints).value_or(value);
}

template <class Integer>
void read_into(const Entry& entry, std::int64_t least, Integer& value, Complaints& complaints) {
  if (!entry) return;
  value = static_cast<Integer>(read_integer(entry, least, complaints).value_or(value));
}

template <class T>
void read_into(const Entry& entry, const Words<T>& words, T& value, Complaints& complaints) {
  if (entry) value = read_choice<T>(entry, words, complaints).value_or(value);
}

Range positive_up_to(double most, const std::string& text) {
  return {.text = "a number > 0 and <= " + text, .lo = 0.0, .hi = most, .lo_excluded = true};
}

void read_rsa(const TableView& packing, RsaSettings& rsa, Complaints& complaints) {
  const toml::table* const node = read_table(packing, "rsa", complaints);
  if (node == nullptr) return;
  const TableView table(*node, "packing.rsa",
                        {"order", "redraw_orientations", "max_trials", "max_restarts"}, complaints);
  read_into(table["order"], kRsaOrders, rsa.order, complaints);
  read_into(table["redraw_orientations"], rsa.redraw_orientations, complaints);
  read_into(table["max_trials"], 1, rsa.max_trials, complaints);
  read_into(table["max_restarts"], 0, rsa.max_restarts, complaints);
}

void read_growth(const TableView& table, EventDrivenSettings& settings, Complaints& complaints) {
  constexpr double kFastest = 10.0;
  const std::size_t before = complaints.count();
  read_into(table["growth_rate"], positive_up_to(kFastest, "10"), settings.growth_rate, complaints);
  // What is too slow for a growth rate given alone takes that rate as the slowest.
  const Entry slowest = table["slowest_growth"];
  if (!slowest) settings.slowest_growth = std::min(settings.slowest_growth, settings.growth_rate);
  if (complaints.count() != before) return;
  read_into(
      slowest,
      positive_up_to(settings.growth_rate, "growth_rate = " + number_text(settings.growth_rate)),
      settings.slowest_growth, complaints);
}

void read_rotate(const Entry& rotate, Rotation& value, Complaints& complaints) {
  if (!rotate) return;
  if (const auto flag = rotate.node->value_exact<bool>()) {
    value = *flag ? Rotation::all : Rotation::none;
  } else if (rotate.node->value_exact<std::string>() == "auto") {
    value = Rotation::automatic;
  } else {
    complaints.not_allowed(rotate, "true, false or \"auto\"");
  }
}

void read_event_driven(const TableView& packing, EventDrivenSettings& settings,
                       Complaints& complaints) {
  const toml::table* const node = read_table(packing, "event-driven", complaints);
  if (node == nullptr) return;
  const TableView table(*node, "packing.event-driven",
                        {"goal", "growth_rate", "slowest_growth", "rotate", "collisions_per_body",
                         "published_stagnation", "check_every_event", "start", "start_fraction"},
                        complaints);
  read_into(table["goal"], kGoals, settings.goal, complaints);
  read_growth(table, settings, complaints);
  read_rotate(table["rotate"], settings.rotate, complaints);
  read_into(table["collisions_per_body"], positive_number(), settings.collisions_per_body,
            complaints);
  read_into(table["published_stagnation"], settings.published_stagnation, complaints);
  read_into(table["check_every_event"], settings.check_every_event, complaints);
  read_into(table["start"], kGrowthStarts, settings.start, complaints);
  if (const Entry fraction = table["start_fraction"]) {
    settings.start_fraction = read_number(fraction, fraction_number(), complaints);
  }
}

void read_steps(const TableView& table, RelaxationSettings& settings, Complaints& complaints) {
  const std::size_t before = complaints.count();
  read_into(table["first_step"], positive_up_to(1.0, "1"), settings.first_step, complaints);
  const Entry least = table["least_step"];
  if (!least) settings.least_step = std::min(settings.least_step, settings.first_step);
  if (complaints.count() != before) return;
  read_into(least,
            positive_up_to(settings.first_step, "first_step = " + number_text(settings.first_step)),
            settings.least_step, complaints);
}

void read_relaxation(const TableView& packing, RelaxationSettings& settings,
                     Complaints& complaints) {
  const toml::table* const node = read_table(packing, "relaxation", complaints);
  if (node == nullptr) return;
  const TableView table(
      *node, "packing.relaxation",
      {"goal", "rotate", "inflation", "patience", "relocated_share", "max_relocations",
       "max_restarts", "start", "start_fraction", "first_step", "least_step"},
      complaints);
  read_into(table["goal"], kRelaxationGoals, settings.goal, complaints);
  read_steps(table, settings, complaints);
  read_into(table["rotate"], kRelaxationTurns, settings.rotate, complaints);
  read_into(table["inflation"], positive_up_to(0.1, "0.1"), settings.inflation, complaints);
  read_into(table["patience"], 1, settings.patience, complaints);
  read_into(table["relocated_share"], kShare, settings.relocated_share, complaints);
  read_into(table["max_relocations"], 0, settings.max_relocations, complaints);
  read_into(table["max_restarts"], 0, settings.max_restarts, complaints);
  read_into(table["start"], kRelaxationStarts, settings.start, complaints);
  if (const Entry fraction = table["start_fraction"]) {
    settings.start_fraction = read_number(fraction, fraction_number(), complaints);
  }
}

void read_thermostats(const TableView& table, TimeDrivenOptions& options, Complaints& complaints) {
  const Range not_negative = not_negative_number();
  read_into(table["damping"], not_negative, options.damping, complaints);
  read_into(table["berendsen"], not_negative, options.berendsen, complaints);
  read_into(table["berendsen_temperature"], not_negative, options.berendsen_temperature,
            complaints);
  read_into(table["nose_hoover"], not_negative, options.nose_hoover, complaints);
  read_into(table["nose_hoover_temperature"], not_negative, options.nose_hoover_temperature,
            complaints);
  read_into(table["stagnation_steps"], 1, options.stagnation_steps, complaints);
  read_into(table["stagnation_drop"], fraction_number(), options.stagnation_drop, complaints);
  read_into(table["reshuffles"], 0, options.reshuffles, complaints);
  read_into(table["reshuffle_steps"], 1, options.reshuffle_steps, complaints);
}

void read_time_driven(const TableView& packing, TimeDrivenOptions& options,
                      Complaints& complaints) {
  const toml::table* const node = read_table(packing, "time-driven", complaints);
  if (node == nullptr) return;
  const TableView table(
      *node, "packing.time-driven",
      {"literal", "integrator", "time_step", "damping", "berendsen", "berendsen_temperature",
       "nose_hoover", "nose_hoover_temperature", "stagnation_steps", "stagnation_drop",
       "reshuffles", "reshuffle_steps", "rescale", "rescale_limit", "energy_threshold", "max_steps",
       "history_every", "overlap_volume_every", "overlap_points"},
      complaints);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  read_into(table["literal"], options.literal, complaints);
  read_into(table["integrator"], kIntegrators, options.integrator, complaints);
  read_into(table["time_step"], positive_up_to(1.0, "1"), options.time_step, complaints);
  read_thermostats(table, options, complaints);
  read_into(table["rescale"], {.text = "a number >= 1", .lo = 1.0, .hi = kInfinity},
            options.rescale, complaints);
  read_into(table["rescale_limit"], {.text = "a number >= 1 and <= 10000", .lo = 1.0, .hi = 1e4},
            options.rescale_limit, complaints);
  read_into(table["energy_threshold"], not_negative_number(), options.energy_threshold, complaints);
  read_into(table["max_steps"], 0, options.max_steps, complaints);
  read_into(table["history_every"], 1, options.history_every, complaints);
  read_into(table["overlap_volume_every"], 0, options.overlap_volume_every, complaints);
  read_into(table["overlap_points"], 2, options.overlap_points, complaints);
}

Range at_least(double least, const std::string& text) {
  return {
      .text = "a number >= " + text, .lo = least, .hi = std::numeric_limits<double>::infinity()};
}

void read_advancing_layer(const TableView& packing, AdvancingLayerSettings& settings,
                          Complaints& complaints) {
  const toml::table* const node = read_table(packing, "advancing-layer", complaints);
  if (node == nullptr) return;
  const TableView table(*node, "packing.advancing-layer",
                        {"top_layer", "candidates", "held_back", "close_top", "max_restarts"},
                        complaints);
  read_into(table["top_layer"], at_least(2.0, "2"), settings.top_layer, complaints);
  if (const Entry candidates = table["candidates"]) {
    if (const auto value = read_integer(candidates, 1, complaints)) {
      settings.candidates = static_cast<int>(std::min<std::int64_t>(*value, kMostCandidates));
    }
  }
  if (const Entry held = table["held_back"]) {
    settings.held_back = read_number(held, kShare, complaints);
  }
  read_into(table["close_top"], settings.close_top, complaints);
  read_into(table["max_restarts"], 0, settings.max_restarts, complaints);
}

void read_drop_and_roll(const TableView& packing, DropAndRollSettings& settings,
                        Complaints& complaints) {
  const toml::table* const node = read_table(packing, "drop-and-roll", complaints);
  if (node == nullptr) return;
  const TableView table(*node, "packing.drop-and-roll", {"drops"}, complaints);
  const Entry drops = table["drops"];
  if (!drops) return;
  const auto value = read_integer(drops, 1, complaints);
  if (value && *value > kMostDrops) complaints.not_allowed(drops, "an integer >= 1 and <= 10000");
  if (value && *value <= kMostDrops) settings.drops = static_cast<int>(*value);
}

void read_published_layer(const TableView& packing, PublishedLayerSettings& settings,
                          Complaints& complaints) {
  const toml::table* const node = read_table(packing, "published-advancing-layer", complaints);
  if (node == nullptr) return;
  const TableView table(*node, "packing.published-advancing-layer", {"spacing", "top_layer"},
                        complaints);
  read_into(table["spacing"], {.text = "a number >= 0.01 and <= 1", .lo = 0.01, .hi = 1.0},
            settings.spacing, complaints);
  read_into(table["top_layer"], positive_number(), settings.top_layer, complaints);
}

}  // namespace

void read_packing_table(const TableView& root, Recipe& order, Complaints& complaints) {
  const toml::table* const node = read_table(root, "packing", complaints);
  if (node == nullptr) return;
  const TableView table(
      *node, "packing",
      {"method", "min_gap", "seed", "time_limit", "rsa", "event-driven", "relaxation",
       "time-driven", "advancing-layer", "drop-and-roll", "published-advancing-layer"},
      complaints);
  if (const Entry method = table["method"]) {
    read_into(method, kMethods, order.method, complaints);
    order.places[method.name] = complaints.place(method.node) + ": " + quoted(method);
  }
  if (const Entry gap = table["min_gap"]) {
    read_into(gap, not_negative_number(), order.min_gap, complaints);
    order.places[gap.name] = complaints.place(gap.node) + ": " + quoted(gap);
  }
  if (const Entry seed = table["seed"]) {
    order.seed = static_cast<std::uint64_t>(read_integer(seed, 0, complaints).value_or(1));
  }
  if (const Entry limit = table["time_limit"]) order.time_limit = read_time(limit, complaints);
  read_rsa(table, order.rsa, complaints);
  read_event_driven(table, order.event_driven, complaints);
  read_relaxation(table, order.relaxation, complaints);
  read_time_driven(table, order.time_driven, complaints);
  read_advancing_layer(table, order.advancing_layer, complaints);
  read_drop_and_roll(table, order.drop_and_roll, complaints);
  read_published_layer(table, order.published_advancing_layer, complaints);
}

}  // namespace packstone::recipe
