#pragma once

/// @file
/// Printed numbers of event-driven growth: E. Ghossein, M. Levesque, J. Comput. Phys. 253 (2013)
/// 471-490. MATLAB 2011a on an Intel i7 of 1.60 GHz, averages over 10 runs.
///
/// The curves of figures 6 to 9 are not given as numbers; only the slopes that the text reads off
/// them are.

#include <array>
#include <string_view>

namespace packstone::benchmarks {

/// One row of table 2. Count and fraction are those of scenes::ghossein_table_2() as well.
struct PrintedGrowth {
  std::string_view scene;  ///< "prolate-2" (R_1 = R_2 = 2), "oblate-2" (R_1 = 2, R_2 = 1), ...
  double aspect;           ///< R_1.
  double fraction;         ///< Largest V_f reached.
  int count;               ///< N.
  double seconds;          ///< t_CPU.
};

inline constexpr std::array<PrintedGrowth, 12> kGhosseinTable2 = {{
    {"prolate-2", 2, 0.60, 30, 54.3},
    {"prolate-5", 5, 0.55, 45, 69.9},
    {"prolate-10", 10, 0.30, 90, 48.6},
    {"prolate-20", 20, 0.20, 175, 112.5},
    {"prolate-30", 30, 0.10, 175, 104.9},
    {"prolate-40", 40, 0.10, 310, 181.3},
    {"oblate-2", 2, 0.60, 30, 52.7},
    {"oblate-5", 5, 0.55, 45, 65.2},
    {"oblate-10", 10, 0.30, 60, 39.3},
    {"oblate-20", 20, 0.20, 75, 47.8},
    {"oblate-30", 30, 0.10, 90, 53.7},
    {"oblate-40", 40, 0.10, 100, 92.8},
}};

inline constexpr double kSlopeOfCount = 1.5;         ///< t_CPU ~ N^1.5, N > 100: figure 7.
inline constexpr double kSlopeOfFraction = 2.6;      ///< t_CPU ~ V_f^2.6, R_1 = 2: figure 8.
inline constexpr double kSlopeOfAspectTo10 = 0.6;    ///< t_CPU ~ R_1^0.6, V_f = 0.1: figure 9.
inline constexpr double kSlopeOfAspectFrom10 = 2.8;  ///< t_CPU ~ R_1^2.8, V_f = 0.1: figure 9.

/// Milliseconds for one collision time of a pair, and of an ellipsoid and a face.
inline constexpr double kMillisecondsOfPair = 0.07, kMillisecondsOfFace = 0.02;

}  // namespace packstone::benchmarks
