// Event-driven growth: the packings of Ghossein and Levesque (2013), and what goes beyond them.
//
//   bench_event_driven table2 [seeds]                the 12 rows of table 2
//   bench_event_driven figures [seeds]               the packings of figures 2 to 5
//   bench_event_driven curves [seeds] [most N]       time against N, V_f, R_1: figures 7 to 9
//   bench_event_driven scaling [largest N]           aspect 2 at 0.5, from N = 100; 10^6 at 0.3
//   bench_event_driven rates [seeds]                 collisions per second without growth
//   bench_event_driven densest [seconds] [case]      as dense as a processor time allows
//   bench_event_driven physics [realizations]        pressure, energy, orientations (figure 6)
//   bench_event_driven alignment [realizations]      orientations as drawn, grown, at equilibrium
//   bench_event_driven reference [seeds] [limit_s]   beside the published method
//   bench_event_driven                               a short round of all but densest
//                                                    and alignment
//
// Times are processor times of one thread, of the packing alone; every packing is then checked by
// check_packing(). "aim" is what this code is meant to do on a machine of 2020. Lines that begin
// with # are for people; the others for programs too. Exit code 1 if a packing did not pass.

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "event_driven/common.hpp"

namespace {

using namespace packstone::benchmarks;

bool run_short_round() {
  bool all_passed = run_table_2(3);
  all_passed = run_figures(1) && all_passed;
  all_passed = run_curves(1, 1000) && all_passed;
  all_passed = run_scaling(10'000) && all_passed;
  all_passed = run_rates(1) && all_passed;
  all_passed = run_physics(10) && all_passed;
  return run_reference(1, 10.0) && all_passed;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  const auto number = [&](int at, double standard) {
    return argc > at ? std::atof(argv[at]) : standard;
  };
  const auto count = [&](int at, int standard) { return static_cast<int>(number(at, standard)); };
  bool all_passed = false;
  if (mode.empty()) {
    all_passed = run_short_round();
  } else if (mode == "table2") {
    all_passed = run_table_2(count(2, 7));
  } else if (mode == "figures") {
    all_passed = run_figures(count(2, 7));
  } else if (mode == "curves") {
    all_passed = run_curves(count(2, 3), count(3, 3000));
  } else if (mode == "scaling") {
    all_passed = run_scaling(static_cast<std::int64_t>(number(2, 1e5)));
  } else if (mode == "rates") {
    all_passed = run_rates(count(2, 3));
  } else if (mode == "densest") {
    all_passed = run_densest(number(2, 60.0), argc > 3 ? argv[3] : "",
                             static_cast<std::uint64_t>(count(4, 1)));
  } else if (mode == "physics") {
    all_passed = run_physics(count(2, 10));
  } else if (mode == "alignment") {
    all_passed = run_alignment(count(2, 100));
  } else if (mode == "reference") {
    all_passed = run_reference(count(2, 4), number(3, 60.0));
  } else {
    fmt::print(stderr, "unknown mode: {}\n", mode);
    return 2;
  }
  return all_passed ? 0 : 1;
}
