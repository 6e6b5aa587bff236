#pragma once

/// @file
/// Progress for people: one line that changes on a terminal, a line now and then in a log.

#include <chrono>
#include <deque>
#include <string>

#include "packstone/core/run_context.hpp"

namespace packstone::cli {

/// Writes reports to standard error. On a terminal one line is overwritten and wiped at the end;
/// elsewhere a plain line is written every few seconds.
class ProgressPrinter {
 public:
  ProgressPrinter();
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;
  ~ProgressPrinter();

  void print(const Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  struct Sample {
    Clock::time_point when;
    double done = 0.0;
    std::int64_t placed = 0;
  };

  [[nodiscard]] std::string line(const Progress& progress, Clock::time_point now);
  void remember(const Progress& progress, Clock::time_point now);

  bool terminal_;
  bool dirty_ = false;  // a line stands on the terminal
  Clock::time_point next_;
  Clock::time_point start_;    // of this stage
  std::deque<Sample> recent_;  // what the rate is taken from
};

}  // namespace packstone::cli
