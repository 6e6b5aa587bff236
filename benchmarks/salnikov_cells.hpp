#pragma once

/// @file
/// Runs of one cell of the printed tables, and the line that shows them beside the print.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "timing.hpp"

namespace packstone::benchmarks {

/// Which cell. printed_s < 0: blank.
struct PrintedCell {
  int count_each;
  double sphere_fraction;
  double cylinder_fraction;
  double aspect;
  double printed_s;
};

/// Of several runs with other seeds.
struct CellRuns {
  std::vector<double> seconds{};
  std::vector<std::int64_t> restarts{};
  int passed = 0;  ///< Those that reached the fractions and whose packing passed the check.
  std::uint64_t hash = 0;

  void add(double run_s, std::int64_t run_restarts, bool run_passed, std::uint64_t run_hash) {
    seconds.push_back(run_s);
    restarts.push_back(run_restarts);
    passed += run_passed ? 1 : 0;
    hash ^= run_hash;
  }
  /// Printed time over the median here.
  [[nodiscard]] double ratio(const PrintedCell& cell) const {
    return cell.printed_s / median(seconds);
  }
};

inline void print_cell_heading() {
  fmt::print(
      "#  n   f_s   f_c   a  paper-s   median-s      max-s     mean-s    ratio passed restarts "
      "most hash\n");
}

/// Restarts: median and most.
inline void print_cell(const PrintedCell& cell, const CellRuns& runs, std::string_view note = "") {
  const bool blank = cell.printed_s < 0;
  const std::string paper = blank ? "-" : fmt::format("{}", cell.printed_s);
  const std::string ratio = blank ? "-" : fmt::format("{:.1f}", runs.ratio(cell));
  const std::size_t count = runs.seconds.size();
  const double mean =
      std::accumulate(runs.seconds.begin(), runs.seconds.end(), 0.0) / static_cast<double>(count);
  fmt::print(
      "{:4} {:5.3f} {:5.3f} {:3.0f} {:>8} {:10.6f} {:10.6f} {:10.6f} {:>8} {:>6} {:8} {:4} "
      "{:016x}{}\n",
      cell.count_each, cell.sphere_fraction, cell.cylinder_fraction, cell.aspect, paper,
      median(runs.seconds), *std::max_element(runs.seconds.begin(), runs.seconds.end()), mean,
      ratio, fmt::format("{}/{}", runs.passed, count), median(runs.restarts),
      *std::max_element(runs.restarts.begin(), runs.restarts.end()), runs.hash, note);
  std::fflush(stdout);
}

}  // namespace packstone::benchmarks
