#pragma once

/// @file
/// The history of a run as a table.

#include <string>
#include <vector>

#include "packstone/generate/event_driven.hpp"
#include "packstone/generate/published_time_driven.hpp"
#include "packstone/generate/relaxation.hpp"

namespace packstone::cli {

/// CSV: one line that names the columns with their units, then one line per sample, numbers as the
/// shortest decimals that read back the same.
[[nodiscard]] std::string timeline_csv(const std::vector<EventDrivenSample>& history);
[[nodiscard]] std::string timeline_csv(const std::vector<RelaxationSample>& history);
[[nodiscard]] std::string timeline_csv(const std::vector<TimeDrivenSample>& history);

}  // namespace packstone::cli
