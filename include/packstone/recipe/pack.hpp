#pragma once

/// @file
/// From a recipe to a certified packing.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "packstone/core/mat.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/generate/event_driven.hpp"
#include "packstone/generate/published_advancing_layer.hpp"
#include "packstone/generate/published_time_driven.hpp"
#include "packstone/generate/relaxation.hpp"
#include "packstone/measure/density.hpp"
#include "packstone/recipe/recipe.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/moving_packing.hpp"
#include "packstone/structure/orientation_order.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// What was ordered of one group, and what stands.
struct GroupOutcome {
  std::string name;
  std::optional<std::int64_t> ordered_count;  ///< Absent: as many as fit.
  std::int64_t count = 0;
  std::optional<double> ordered_fraction;  ///< Absent: as much as fits [-].
  double fraction = 0.0;  ///< Of the inclusions as large as they are, see MotionOutcome [-].
  /// true: orientations were redrawn with the trials, which favors those that fit.
  bool redrawn = false;
  /// true: inclusions were turned by collisions or a relaxation, so their orientations are not
  /// those drawn.
  bool turned = false;
  /// Sample mean of u u^T over the symmetry axes u as they were drawn, and over those that stand
  /// [-]. Absent for spheres and disks; the ordered one also where the count is open.
  std::optional<SymMat3> ordered_tensor;
  std::optional<SymMat3> tensor;
  /// Order of `tensor`, and that of as many independent random axes. Absent where `tensor` is.
  std::optional<OrientationOrder> order;
  std::optional<RandomOrder> random_order;
};

/// What a method that moves inclusions and lets them grow has to tell.
struct MotionOutcome {
  /// Lengths of all inclusions over those ordered [-]. 1 where the target is reached; the goal
  /// "densest" may end on either side of it.
  double size_factor = 1.0;
  EventDrivenReport report;
  std::vector<EventDrivenSample> history;  ///< Since the start, or since the checkpoint.
};

/// What a relaxation has to tell.
struct RelaxationOutcome {
  double size_factor = 1.0;  ///< As of MotionOutcome.
  RelaxationReport report;
  std::vector<RelaxationSample> history;  ///< Of the last attempt.
};

/// What the published relaxation believes, and what is true.
struct TimeDrivenOutcome {
  double start_energy = 0.0;      ///< Potential energy at the start [L^2].
  double potential_energy = 0.0;  ///< And at the end: 0 where it sees no overlap [L^2].
  double kinetic_energy = 0.0;    ///< At the end [L^2 / T^2].
  std::int64_t overlaps = 0;      ///< Pairs that are not proven apart.
  double deepest = 0.0;           ///< Deepest overlap of a pair [L].
  std::int64_t steps = 0;
  int reshuffles = 0;  ///< Times that the Nose-Hoover thermostat was switched on.
  std::vector<TimeDrivenSample> history;
};

/// What the published advancing layers leave.
struct PublishedLayerOutcome {
  TrueOverlaps overlaps;         ///< Of the true bodies.
  std::int64_t first_row = 0;    ///< Bodies laid upon the floor.
  std::int64_t pairs_tried = 0;  ///< Pairs of partners.
};

/// What is about to be done, and what to expect of it.
struct PackPlan {
  std::string method;         ///< "rsa", "event-driven", ...: name(PackMethod).
  std::string method_reason;  ///< Why this method, for people.
  std::int64_t count = 0;     ///< Inclusions ordered, without those of groups of open count.
  double fraction = 0.0;      ///< Of those, each with half of the least gap around it [-].
  /// What random packings of such inclusions are known to reach [-]. Absent where that is not
  /// known, as of mixtures.
  std::optional<double> reachable;
  /// Processor time that it takes, within a factor of some ten [s]. Absent where no end is foreseen
  /// or nothing is known.
  std::optional<double> seconds;
  std::string warning;  ///< A sentence on why it will hardly succeed, or empty.
};
using PlanCallback = std::function<void(const PackPlan&)>;

/// What pack() made, beside what was ordered.
struct PackOutcome {
  Packing packing;  ///< With certificate and provenance.
  /// Everything ordered stands in the size ordered, and the certificate is clean. The goal
  /// "densest" orders no size: it is reached when they jam, and by a time limit as well.
  bool target_reached = false;
  /// The inclusion that reaches farthest through a wall. Absent where none does. The pair that
  /// overlaps the most stands in the certificate.
  std::optional<WallCrossing> deepest_crossing;
  std::string method;         ///< "rsa", "event-driven", ...: name(PackMethod).
  std::string method_reason;  ///< Why this method, for people.
  PackPlan plan;              ///< As told before the work; empty after a checkpoint.
  std::string stop;           ///< Why it stopped: "target_reached", "saturated", "jammed", ...
  std::vector<GroupOutcome> groups;
  /// Sentences: what two of count, fraction and size gave for the third, and what of the order is
  /// met only roughly.
  std::vector<std::string> derived;
  /// Processor time of the method [s]: of the whole process, or with RunContext::threads(1) of the
  /// calling thread alone.
  double seconds = 0.0;
  std::int64_t trials = 0;              ///< Positions tried, by methods that place inclusions.
  std::int64_t restarts = 0;            ///< Fresh starts.
  std::optional<MotionOutcome> motion;  ///< Of methods that move inclusions and let them grow.
  std::optional<RelaxationOutcome> relaxation;           ///< Of relaxations.
  std::optional<TimeDrivenOutcome> time_driven;          ///< Of the published relaxation.
  std::optional<PublishedLayerOutcome> published_layer;  ///< Of the published advancing layers.
  /// How dense inside and at the boundaries: of constructive methods, which pack from a floor.
  std::optional<DensityReport> density;
};

/// Makes the packing that `recipe` orders and checks it, independently of how it was made.
///
/// A cancelled run and one that is out of time end with the best valid packing; a relaxation, whose
/// inclusions have their full size from the start, with the state that overlaps least, and with the
/// certificate that says so. The time limit of
/// the recipe and the deadline of `run` both hold. Any other
/// certificate that did not pass makes target_reached false and stop "check_failed": such a packing
/// is a defect of this library and must not be used.
///
/// Errors:  throws InvalidArgument, before any work, when the recipe is not well formed or cannot
///          be met: an inclusion larger than the cell allows, bodies that with their gaps need
///          more room than the cell has, equal spheres or disks above the densest packing there
///          is (T. C. Hales, Ann. Math. 162 (2005) 1065-1185; L. Fejes Toth, Math. Z. 46 (1940)
///          83-85).
///
/// `checkpointing`: event-driven dynamics hands its state over on the way, and at the end when it
/// was cancelled or out of time, with the names of the groups and with the recipe in the
/// provenance: ready for write_checkpoint() of checkpoint_file.hpp. Other methods keep none.
///
/// `on_plan`: called once, when the bodies are drawn and nothing speaks against the order.
[[nodiscard]] PackOutcome pack(const Recipe& recipe, RunContext run = {},
                               const Checkpointing& checkpointing = {},
                               const PlanCallback& on_plan = {});

/// What pack() would do, and what to expect of it, without the work. Errors as pack().
[[nodiscard]] PackPlan plan_pack(const Recipe& recipe);

/// Goes on from a checkpoint that pack() made of the same recipe. From one made on the way the
/// result has the bits that the run would have given uninterrupted. The time limit counts anew.
/// `recipe` may differ in what does not change the inclusions, such as the slowest growth.
///
/// Errors:  as pack(); InvalidArgument too when the checkpoint is not well formed or its inclusions
///          are not those that the recipe orders.
[[nodiscard]] PackOutcome resume_pack(const Recipe& recipe, MovingPacking checkpoint,
                                      RunContext run = {}, const Checkpointing& checkpointing = {});

}  // namespace packstone
