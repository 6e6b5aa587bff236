#pragma once

/// @file
/// Times and their middle, for every benchmark.

#include <algorithm>
#include <ctime>
#include <vector>

namespace packstone::benchmarks {

/// Of this process, all threads [s].
[[nodiscard]] inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The value in the middle; of an even number the upper one.
template <class T>
[[nodiscard]] T median(std::vector<T> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace packstone::benchmarks
