#include "summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "density_summary.hpp"
#include "packstone/core/number_text.hpp"

namespace packstone::cli {
namespace {

using Json = nlohmann::ordered_json;

Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json tensor_json(const std::optional<SymMat3>& t) {
  if (!t) return nullptr;
  return Json::array(
      {Json{t->xx, t->xy, t->xz}, Json{t->xy, t->yy, t->yz}, Json{t->xz, t->yz, t->zz}});
}

template <class T>
Json value_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

// A value beside what chance alone gives; infinite numbers are null.
Json against_chance_json(double value, const RandomValue& random) {
  return {{"value", finite_or_null(value)},
          {"random",
           {{"mean", finite_or_null(random.mean)},
            {"standard_deviation", finite_or_null(random.standard_deviation)},
            {"interval_95", {finite_or_null(random.low), finite_or_null(random.high)}}}}};
}

Json group_json(const GroupOutcome& group) {
  Json text{{"name", group.name},
            {"count", group.count},
            {"count_ordered", value_or_null(group.ordered_count)},
            {"fraction", group.fraction},
            {"fraction_ordered", value_or_null(group.ordered_fraction)}};
  if (!group.tensor && !group.ordered_tensor) return text;
  text["orientation"] = {{"redrawn", group.redrawn},
                         {"turned", group.turned},
                         {"tensor", tensor_json(group.tensor)},
                         {"tensor_ordered", tensor_json(group.ordered_tensor)},
                         {"weighting", "number"}};
  if (!group.order) return text;
  text["orientation"]["nematic_order"] =
      against_chance_json(group.order->nematic, group.random_order->nematic);
  text["orientation"]["rho"] = against_chance_json(group.order->rho, group.random_order->rho);
  return text;
}

std::string tensor_text(const SymMat3& t) {
  return fmt::format("xx {:.4f} yy {:.4f} zz {:.4f} yz {:+.4f} xz {:+.4f} xy {:+.4f}", t.xx, t.yy,
                     t.zz, t.yz, t.xz, t.xy);
}

std::string rounded(double x, int digits) {
  return std::isfinite(x) ? number_text(x, digits) : "infinite";
}

std::string against_chance_text(double value, const RandomValue& random, int digits) {
  return fmt::format("{} (random {}, 95 % in {} to {})", rounded(value, digits),
                     rounded(random.mean, digits), rounded(random.low, digits),
                     rounded(random.high, digits));
}

// Two axes or one say nothing of how the others would lie.
std::string order_text(const GroupOutcome& group) {
  if (!group.order || group.count < 3) return "";
  // Of rho the part above 1 counts.
  return "    order S " +
         against_chance_text(group.order->nematic, group.random_order->nematic, 3) + ", rho " +
         against_chance_text(group.order->rho, group.random_order->rho, 4) + "\n";
}

// How far the orientations went from those drawn, where the method changed them.
std::string changes_text(const GroupOutcome& group) {
  if (!(group.redrawn || group.turned) || !group.tensor) return "";
  std::string text = group.redrawn
                         ? "    orientations were redrawn with the trials, which favors those that "
                           "fit:\n"
                         : "    orientations were changed:\n";
  if (group.ordered_tensor) {
    text += "      <uu> as drawn  " + tensor_text(*group.ordered_tensor) + "\n";
  }
  return text + "      <uu> reached   " + tensor_text(*group.tensor) + "\n";
}

// By count, or by the size of those that stand. Sums of many volumes round.
bool falls_short(const GroupOutcome& group) {
  constexpr double kRounding = 1e-9;
  if (!group.ordered_fraction) return false;
  return group.count < group.ordered_count.value_or(0) ||
         group.fraction < *group.ordered_fraction * (1.0 - kRounding);
}

std::string group_text(const GroupOutcome& group, std::size_t width) {
  std::string text = fmt::format("  {:<{}}  {}", group.name, width, group.count);
  if (group.ordered_count) text += fmt::format(" of {}", *group.ordered_count);
  text += fmt::format(", fraction {:.6g}", group.fraction);
  if (falls_short(group)) text += fmt::format(" of {:.6g}", *group.ordered_fraction);
  return text + "\n" + order_text(group) + changes_text(group);
}

Json motion_json(const std::optional<MotionOutcome>& motion) {
  if (!motion) return nullptr;
  const EventDrivenReport& report = motion->report;
  return {{"size_factor", motion->size_factor},
          {"collisions", report.collisions},
          {"wall_collisions", report.wall_collisions},
          {"predictions", report.predictions},
          {"searches", report.searches},
          {"steps", report.steps},
          {"neighbor_searches", report.neighbor_searches},
          {"blocks", report.blocks},
          {"most_negative_gap", finite_or_null(report.most_negative_gap)},
          {"energy_drift", finite_or_null(report.energy_drift)},
          {"reduced_pressure", finite_or_null(report.reduced_pressure)},
          {"growth_rate", report.growth_rate}};
}

Json time_driven_json(const std::optional<TimeDrivenOutcome>& outcome) {
  if (!outcome) return nullptr;
  return {{"start_energy", outcome->start_energy},
          {"potential_energy", outcome->potential_energy},
          {"kinetic_energy", outcome->kinetic_energy},
          {"overlaps", outcome->overlaps},
          {"deepest", outcome->deepest},
          {"steps", outcome->steps},
          {"reshuffles", outcome->reshuffles}};
}

std::string time_driven_text(const TimeDrivenOutcome& outcome) {
  return fmt::format("{} steps, {} reshuffles, energy {} of {} at the start", outcome.steps,
                     outcome.reshuffles, rounded(outcome.potential_energy, 3),
                     rounded(outcome.start_energy, 3));
}

Json published_layer_json(const std::optional<PublishedLayerOutcome>& outcome) {
  if (!outcome) return nullptr;
  return {{"overlaps", outcome->overlaps.pairs},
          {"deepest", outcome->overlaps.deepest},
          {"mean", outcome->overlaps.mean},
          {"first_row", outcome->first_row},
          {"pairs_tried", outcome->pairs_tried}};
}

std::string published_layer_text(const PublishedLayerOutcome& outcome) {
  return fmt::format(
      "{} pairs of true bodies overlap, by {} of their half thickness at most, {} on "
      "the mean",
      outcome.overlaps.pairs, rounded(outcome.overlaps.deepest, 3),
      rounded(outcome.overlaps.mean, 3));
}

double size_factor(const PackOutcome& outcome) {
  if (outcome.relaxation) return outcome.relaxation->size_factor;
  return outcome.motion ? outcome.motion->size_factor : 1.0;
}

std::string sizes_text(const PackOutcome& outcome) {
  return fmt::format("sizes are {:.6g} of those ordered", size_factor(outcome));
}

// What the method did: positions tried, or collisions.
std::string work_text(const PackOutcome& outcome) {
  if (outcome.relaxation) return relaxation_text(outcome.relaxation->report);
  if (outcome.time_driven) return time_driven_text(*outcome.time_driven);
  if (outcome.published_layer) return published_layer_text(*outcome.published_layer);
  if (!outcome.motion) {
    return fmt::format("{} trials, {} restarts", outcome.trials, outcome.restarts);
  }
  const EventDrivenReport& report = outcome.motion->report;
  std::string text = fmt::format("{} collisions, reduced pressure {}", report.collisions,
                                 rounded(report.reduced_pressure, 4));
  if (report.growth_rate > 0.0) {
    text += ", growth rate " + rounded(report.growth_rate, 3);
  } else {
    text += ", energy drift " + rounded(report.energy_drift, 3);
  }
  if (report.most_negative_gap < 0.0) {
    text += ", deepest overlap seen " + rounded(-report.most_negative_gap, 3);
  }
  return text;
}

// "inclusions 3 and 17", "inclusion 3 and its own image at [0, 1, 0]".
std::string pair_text(const Certificate& c) {
  const auto& [a, b] = c.worst_pair;
  const std::string image = fmt::format("[{}]", fmt::join(c.worst_image, ", "));
  if (a == b) return fmt::format("inclusion {} and its own image {}", a, image);
  const bool same_period = c.worst_image == std::array<int, 3>{0, 0, 0};
  return fmt::format("inclusions {} and {}", a, b) + (same_period ? "" : " in image " + image);
}

std::string worst_text(const Certificate& c) {
  if (c.worst_pair[0] < 0 || !std::isfinite(c.smallest_gap)) return "";
  return " between " + pair_text(c);
}

std::string crossing_text(const WallCrossing& crossing) {
  return fmt::format("inclusion {} by {:.4g} through the wall {} = {:.6g}", crossing.inclusion,
                     crossing.depth, "xyz"[crossing.axis], crossing.wall);
}

std::string gap_text(const Certificate& c) {
  return std::isfinite(c.smallest_gap) ? fmt::format("{:.4g}", c.smallest_gap) : "none";
}

Json grown_json(const RelaxationOutcome& outcome) {
  Json text{{"size_factor", outcome.size_factor}};
  text.update(relaxation_json(outcome.report));
  return text;
}

std::string duration_text(const std::optional<double>& seconds) {
  if (!seconds) return "how long it takes is not foreseen";
  if (*seconds < 2.0) return "it takes a second or less";
  if (*seconds < 60.0) return "it takes up to a minute";
  return *seconds < 3600.0 ? "it takes minutes" : "it takes hours";
}

Json plan_json(const PackPlan& plan) {
  return {{"count", plan.count},
          {"fraction", plan.fraction},
          {"reachable", value_or_null(plan.reachable)},
          {"seconds", value_or_null(plan.seconds)},
          {"warning", plan.warning.empty() ? Json(nullptr) : Json(plan.warning)}};
}

}  // namespace

std::string plan_text(const PackPlan& plan) {
  std::string text = fmt::format("{} ({}): ", plan.method, plan.method_reason);
  if (plan.count > 0)
    text += fmt::format("{} inclusions, fraction {:.4g}; ", plan.count, plan.fraction);
  if (plan.reachable) {
    text += fmt::format("random packings of such reach about {:.2g}; ", *plan.reachable);
  }
  text += duration_text(plan.seconds);
  return plan.warning.empty() ? text : text + "\npackstone: warning: " + plan.warning;
}

std::string stop_words(const std::string& stop) {
  if (stop == "saturated") return "proven: the next inclusion fits nowhere";
  if (stop == "given_up") return "gave up after max_trials rejected trials in a row";
  if (stop == "full") return "one found no place";
  if (stop == "jammed") return "jammed: they hardly grow any more";
  if (stop == "stagnated") return "stagnated by the published criterion";
  if (stop == "relaxed") return "the method sees no overlap any more, but there are some";
  if (stop == "steps_used_up") return "max_steps are used up";
  if (stop == "stalled") return "no attempt came to rest without overlaps";
  if (stop == "cancelled") return "interrupted";
  if (stop == "out_of_time") return "the time limit passed";
  if (stop == "check_failed") return "the independent check did not pass";
  return stop;
}

std::string problem_text(const Certificate& c, const std::optional<WallCrossing>& crossing) {
  std::vector<std::string> parts;
  const bool pairs = c.overlaps + c.gaps_below > 0;
  if (pairs && c.smallest_gap < 0.0) {
    parts.push_back(fmt::format("{} by {:.4g}, deepest of {} {}", pair_text(c), -c.smallest_gap,
                                c.overlaps, c.overlaps == 1 ? "overlap" : "overlaps"));
  } else if (pairs) {
    parts.push_back(fmt::format("{} with a gap of {:.4g}, least of {} that {} too small",
                                pair_text(c), c.smallest_gap, c.overlaps + c.gaps_below,
                                c.overlaps + c.gaps_below == 1 ? "is" : "are"));
  }
  if (crossing) parts.push_back(crossing_text(*crossing));
  return parts.empty() ? "" : fmt::format("worst: {}", fmt::join(parts, "; "));
}

Json relaxation_json(const RelaxationReport& report) {
  return {{"iterations", report.iterations},
          {"evaluations", report.evaluations},
          {"neighbor_searches", report.neighbor_searches},
          {"relocated", report.relocated},
          {"energy", finite_or_null(report.energy)},
          {"deepest", report.deepest}};
}

std::string relaxation_text(const RelaxationReport& report) {
  std::string text = fmt::format("{} steps, {} restarts", report.iterations, report.restarts);
  if (report.relocated > 0) text += fmt::format(", {} moved elsewhere", report.relocated);
  return text;
}

Json certificate_json(const Certificate& c) {
  Json groups = Json::array();
  for (const GroupCensus& group : c.groups) {
    groups.push_back({{"name", group.name}, {"count", group.count}, {"fraction", group.fraction}});
  }
  return {{"passed", c.passed()},
          {"count", c.count},
          {"fraction", c.fraction},
          {"groups", groups},
          {"min_gap", c.min_gap},
          {"smallest_gap", finite_or_null(c.smallest_gap)},
          {"smallest_gap_error", finite_or_null(c.smallest_gap_error)},
          {"worst_pair", c.worst_pair},
          {"worst_image", c.worst_image},
          {"overlaps", c.overlaps},
          {"gaps_below", c.gaps_below},
          {"outside_walls", c.outside_walls},
          {"pairs_checked", c.pairs_checked}};
}

Json crossing_json(const std::optional<WallCrossing>& crossing) {
  if (!crossing) return nullptr;
  return {{"inclusion", crossing->inclusion},
          {"axis", std::string(1, "xyz"[crossing->axis])},
          {"wall", crossing->wall},
          {"depth", crossing->depth}};
}

Json outcome_json(const PackOutcome& outcome) {
  Json groups = Json::array();
  for (const GroupOutcome& group : outcome.groups) groups.push_back(group_json(group));
  Json text{{"target_reached", outcome.target_reached},
            {"stop", outcome.stop},
            {"method", outcome.method},
            {"method_reason", outcome.method_reason},
            {"plan", plan_json(outcome.plan)},
            {"seed", outcome.packing.provenance->seed},
            {"seconds", outcome.seconds},
            {"trials", outcome.trials},
            {"restarts", outcome.restarts},
            {"motion", motion_json(outcome.motion)},
            {"relaxation", outcome.relaxation ? grown_json(*outcome.relaxation) : Json(nullptr)},
            {"groups", groups},
            {"derived", outcome.derived}};
  text["time_driven"] = time_driven_json(outcome.time_driven);
  text["published_layer"] = published_layer_json(outcome.published_layer);
  text["density"] = nullptr;
  if (outcome.density) {
    text["density"] = density_json(*outcome.density);
    text["density"].erase("profiles");
  }
  text["certificate"] = certificate_json(*outcome.packing.certificate);
  text["deepest_crossing"] = crossing_json(outcome.deepest_crossing);
  return text;
}

std::string certificate_text(const Certificate& c, const std::optional<WallCrossing>& crossing) {
  std::string text = fmt::format("{} inclusions, fraction {:.6g}\n", c.count, c.fraction);
  if (c.overlaps > 0) {
    text += fmt::format("{} {}\n", c.overlaps, c.overlaps == 1 ? "pair overlaps" : "pairs overlap");
  }
  if (c.gaps_below > 0) {
    text += fmt::format("{} {} closer than {:.6g}\n", c.gaps_below,
                        c.gaps_below == 1 ? "pair is" : "pairs are", c.min_gap);
  }
  if (c.outside_walls > 0) {
    text += fmt::format("{} {} a wall", c.outside_walls,
                        c.outside_walls == 1 ? "inclusion crosses" : "inclusions cross");
    if (crossing) text += "; deepest: " + crossing_text(*crossing);
    text += "\n";
  }
  text += fmt::format("smallest gap {}{}\n", gap_text(c), worst_text(c));
  if (!c.passed()) return text + "FAILED\n";
  return text + (c.min_gap > 0.0 ? fmt::format("passed: every gap is at least {:.6g}\n", c.min_gap)
                                 : "passed: no two inclusions overlap\n");
}

std::string outcome_text(const PackOutcome& outcome) {
  std::string text;
  std::size_t width = 0;
  for (const GroupOutcome& group : outcome.groups) width = std::max(width, group.name.size());
  for (const GroupOutcome& group : outcome.groups) text += group_text(group, width);
  for (const std::string& sentence : outcome.derived) text += "  " + sentence + "\n";
  const Certificate& c = *outcome.packing.certificate;
  if (size_factor(outcome) != 1.0) {
    text += "  " + sizes_text(outcome) + "\n";
  }
  text += fmt::format("  {} ({}), {}, {:.3g} s\n", outcome.method, outcome.method_reason,
                      work_text(outcome), outcome.seconds);
  if (outcome.stop != "target_reached") text += "  ended: " + stop_words(outcome.stop) + "\n";
  text += fmt::format("  {}, fraction {:.6g}, smallest gap {}{}\n",
                      c.passed() ? "certified: no overlap" : "NOT CERTIFIED", c.fraction,
                      gap_text(c), worst_text(c));
  const std::string density = outcome.density ? density_line(*outcome.density) : "";
  return density.empty() ? text : text + "  " + density + "\n";
}

std::string outcome_line(const PackOutcome& outcome) {
  const Certificate& c = *outcome.packing.certificate;
  std::string text = fmt::format("{} inclusions, fraction {:.6g}, smallest gap {}", c.count,
                                 c.fraction, gap_text(c));
  if (size_factor(outcome) != 1.0) {
    text += ", " + sizes_text(outcome);
  }
  return text + fmt::format(", {}, {}, {:.3g} s", outcome.method, outcome.stop, outcome.seconds);
}

std::string shortfall_text(const PackOutcome& outcome) {
  std::string text = "target not reached: " + stop_words(outcome.stop);
  if (size_factor(outcome) != 1.0) {
    text += "; " + sizes_text(outcome);
  }
  for (const GroupOutcome& group : outcome.groups) {
    if (!falls_short(group)) continue;
    text += fmt::format("; {}: {} of {}, fraction {:.4g} of {:.4g}", group.name, group.count,
                        *group.ordered_count, group.fraction, *group.ordered_fraction);
  }
  const Certificate& certificate = *outcome.packing.certificate;
  if (!certificate.passed()) {
    text += "\n  " + problem_text(certificate, outcome.deepest_crossing);
  }
  if (outcome.stop == "saturated" || outcome.stop == "given_up") {
    text +=
        "\n  rsa never moves what it placed, so it jams early (equal spheres near 0.38): "
        "order a smaller fraction, or method = \"event-driven\"";
  } else if (outcome.stop == "full" && !outcome.published_layer) {
    text +=
        "\n  try another --seed, more restarts (packing.advancing-layer.max_restarts), or order a "
        "smaller fraction; where bodies may turn, method = \"event-driven\" packs denser";
  } else if (outcome.published_layer) {
    text += "\n  method = \"advancing-layer\" packs denser, without overlap";
  } else if (outcome.stop == "jammed") {
    text +=
        "\n  slower growth packs denser (packing.event-driven.growth_rate), as may another --seed; "
        "or order a smaller fraction";
  } else if (outcome.time_driven) {
    text += "\n  method = \"relaxation\" ends without overlap";
  } else if (outcome.stop == "stalled") {
    text +=
        "\n  method = \"event-driven\" packs denser; or try another --seed, more restarts "
        "(packing.relaxation.max_restarts), or a smaller fraction";
  } else if (outcome.stop == "out_of_time") {
    text += "\n  allow more time (--time-limit), try another --seed, or order a smaller fraction";
  }
  return text;
}

}  // namespace packstone::cli
