#pragma once

/// @file
/// What the commands say on standard output: for people, or one JSON object for machines.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "packstone/recipe/pack.hpp"
#include "packstone/structure/certificate.hpp"
#include "packstone/structure/check_packing.hpp"

namespace packstone::cli {

[[nodiscard]] nlohmann::ordered_json certificate_json(const Certificate& certificate);
[[nodiscard]] nlohmann::ordered_json crossing_json(const std::optional<WallCrossing>& crossing);
[[nodiscard]] nlohmann::ordered_json outcome_json(const PackOutcome& outcome);
[[nodiscard]] nlohmann::ordered_json relaxation_json(const RelaxationReport& report);

/// What is about to be done and what to expect of it, on a line, and a warning on another one.
[[nodiscard]] std::string plan_text(const PackPlan& plan);
/// What a relaxation did, on part of a line.
[[nodiscard]] std::string relaxation_text(const RelaxationReport& report);
/// Why a run stopped, in words.
[[nodiscard]] std::string stop_words(const std::string& stop);

/// The pair that overlaps the most, or has the least gap of those that are too small, and the
/// inclusion that reaches farthest through a wall, on one line; empty for what passed.
[[nodiscard]] std::string problem_text(const Certificate& certificate,
                                       const std::optional<WallCrossing>& crossing);
/// The verdict in a few lines. `crossing`: the deepest one through a wall, if there is any.
[[nodiscard]] std::string certificate_text(const Certificate& certificate,
                                           const std::optional<WallCrossing>& crossing);
/// Groups, what was derived, method, and the verdict.
[[nodiscard]] std::string outcome_text(const PackOutcome& outcome);
/// The same on one line: counts, fraction, why it stopped.
[[nodiscard]] std::string outcome_line(const PackOutcome& outcome);
/// Why the target was not reached and what is missing, with advice.
[[nodiscard]] std::string shortfall_text(const PackOutcome& outcome);

}  // namespace packstone::cli
