#pragma once

/// @file
/// The innermost loops in eight lanes, compiled once for every width of registers: the same bits
/// from all of them.

#include <cstddef>
#include <cstdint>

#include "generate/event_driven/bodies.hpp"
#include "generate/event_driven/pair_lanes.hpp"
#include "generate/event_driven/reference_lanes.hpp"

namespace packstone::event_driven {

/// Which of its neighbors may body i, its clock at t, touch? See PairLanes::look().
struct PairQuestion {
  const Flight* flight;
  const Spin* spin;
  const double* reach;
  double size;  ///< Size factor at t.
  double growth;
  double min_gap;
  Vec3 edges;
  double coordinate_gap;
  std::int32_t i;
  double t;
  double horizon;
  const double* times;
  Neighbor* neighbors;
  std::size_t count;  ///< > 0
};

/// How far are `others` from `own`? See bound_near_gaps().
struct GapQuestion {
  const StandingLine& own;
  double own_margin;
  const StandingLine* lines;
  const double* margins;  ///< None: gaps are wanted as closely as can be.
  const Neighbor* others;
  std::size_t count;  ///< > 0
  Vec3 edges;
  double* gaps;
};

/// The loops for one width.
struct LaneKernels {
  std::size_t (*balls)(const PairQuestion&, Suspect*, double& least_gap);
  std::size_t (*revolution)(const PairQuestion&, Suspect*);
  void (*bound_gaps)(const GapQuestion&);
};

/// Named for the numbers in a register.
extern const LaneKernels kLanesByTwo;
#ifdef __x86_64__
extern const LaneKernels kLanesByFour;   ///< AVX2.
extern const LaneKernels kLanesByEight;  ///< AVX-512F.
#endif

/// For the widest registers of this processor.
[[nodiscard]] const LaneKernels& lane_kernels();

}  // namespace packstone::event_driven
