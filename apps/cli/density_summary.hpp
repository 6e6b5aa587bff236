#pragma once

/// @file
/// What the program says of a density report.

#include <nlohmann/json.hpp>
#include <string>

#include "packstone/measure/density.hpp"

namespace packstone::cli {

/// All of it.
[[nodiscard]] nlohmann::ordered_json density_json(const DensityReport& report);
/// The fraction inside, and what each boundary costs, in one line; empty where the packing is too
/// small to have an inside.
[[nodiscard]] std::string density_line(const DensityReport& report);
/// All but the profiles, in some ten lines.
[[nodiscard]] std::string density_text(const DensityReport& report, int dimension);

}  // namespace packstone::cli
