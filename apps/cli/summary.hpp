#pragma once

/// @file
/// What the commands say on standard output: for people, or one JSON object for machines.

#include <nlohmann/json.hpp>
#include <string>

#include "packstone/recipe/pack.hpp"
#include "packstone/structure/certificate.hpp"

namespace packstone::cli {

[[nodiscard]] nlohmann::ordered_json certificate_json(const Certificate& certificate);
[[nodiscard]] nlohmann::ordered_json outcome_json(const PackOutcome& outcome);

/// The verdict in a few lines.
[[nodiscard]] std::string certificate_text(const Certificate& certificate);
/// Groups, what was derived, method, and the verdict.
[[nodiscard]] std::string outcome_text(const PackOutcome& outcome);
/// Why the target was not reached and what is missing, with advice.
[[nodiscard]] std::string shortfall_text(const PackOutcome& outcome);

}  // namespace packstone::cli
