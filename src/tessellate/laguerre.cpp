#include "packstone/tessellate/laguerre.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "packstone/core/error.hpp"
#include "packstone/geometry/inscribed_balls.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/images.hpp"
#include "tessellate/laguerre/assembly.hpp"
#include "tessellate/laguerre/errors.hpp"
#include "tessellate/laguerre/grains.hpp"
#include "tessellate/laguerre/interfaces.hpp"
#include "tessellate/laguerre/shape_rounds.hpp"
#include "tessellate/laguerre/shape_step.hpp"
#include "tessellate/laguerre/transport.hpp"

namespace packstone {
namespace {

using laguerre::CellMoments;
using laguerre::CellSums;
using laguerre::Grain;
using laguerre::Order;
using laguerre::ShapeGoal;
using laguerre::Site;
using laguerre::TransportOutcome;

// In all rounds but the last, measures need not be better than this: the next one changes them.
constexpr double kRoundTolerance = 0.03;
constexpr int kRoundSteps = 3;

// The same in the plane, where steps mind the measures too; in the last rounds these have to be
// nearly right, or the shapes will not be when they are made right.
constexpr double kEarlyTolerance = 0.3;
constexpr int kEarlySteps = 1;
constexpr double kLateTolerance = 0.03;
constexpr int kLateSteps = 3;
constexpr int kLateRounds = 3;

// Before that bodies go where their cells are, as often as this, with measures this nearly right.
constexpr int kSpreadings = 4;
constexpr double kSpreadTolerance = 0.1;
constexpr int kSpreadSteps = 3;

// Of the steps in the plane: first, from one round to the next, and last. With less, cells that
// cannot get the shape ordered pull others out of theirs.
constexpr double kFirstDamping = 2.0;
constexpr double kDampingRatio = 0.7;
constexpr double kLastDamping = 1.0;

// A cell that a step takes apart goes back if more than this part of its measure comes off, in the
// second try with its neighbors.
constexpr double kMostLoose = 0.1;
constexpr int kMostReturns = 2;

// While sites are taken out, and how often that is done at most.
constexpr double kLooseTolerance = 1e-3;
constexpr int kMostLoosenings = 20;

void check_range(bool good, const char* option, double value, const char* allowed) {
  if (good) return;
  throw InvalidArgument(std::string(option) + " is " + std::to_string(value) + "; allowed are " +
                        allowed);
}

void check_input(const Packing& packing, const LaguerreOptions& o) {
  check_range(o.spacing >= kLeastBallSpacing && o.spacing <= kMostBallSpacing, "spacing", o.spacing,
              "numbers in [0.01, 1]");
  check_range(o.measure_tolerance >= 1e-12 && o.measure_tolerance <= 1.0, "measure_tolerance",
              o.measure_tolerance, "numbers in [1e-12, 1]");
  check_range(o.max_newton_steps >= 1, "max_newton_steps", o.max_newton_steps, "numbers >= 1");
  check_range(o.shape_rounds >= 0, "shape_rounds", o.shape_rounds, "numbers >= 0");
  check_range(o.shape_gain > 0.0 && o.shape_gain < 2.0, "shape_gain", o.shape_gain,
              "numbers in (0, 2)");
  check_range(o.center_gain >= 0.0 && o.center_gain <= 1.0, "center_gain", o.center_gain,
              "numbers in [0, 1]");
  check_well_formed(packing);
  check_images(packing);
  if (packing.inclusions.empty()) throw InvalidArgument("the packing has no inclusion");
}

std::vector<TessellationCell> cells_of(const Packing& packing) {
  std::vector<TessellationCell> cells;
  for (const Inclusion& inclusion : packing.inclusions) {
    cells.push_back({inclusion.center, inclusion.group, 1});
  }
  return cells;
}

// A tessellation on its way.
class Tessellator {
 public:
  Tessellator(const Packing& packing, const LaguerreOptions& options, RunContext run)
      : packing_(packing), box_(packing.cell), options_(options), run_(std::move(run)) {}

  LaguerreResult make() {
    const bool moves = options_.ordered_measures || options_.shape_rounds > 0;
    const bool published = !options_.inflate && !moves;
    if (!published) publish();
    const bool grows = options_.inflate && !steps_in_plane();
    const double factor = grows ? std::pow(fraction(packing_), -1.0 / box_.dimension) : 1.0;
    grains_ = laguerre::grains_of(packing_, factor);
    sites_ = laguerre::sites_of(box_, grains_, options_.spacing);
    if (moves) {
      set_targets();
      steps_in_plane() ? shape_in_plane() : shape();
      settle();
    }
    finish();
    if (published) result_.report.published = result_.report.made;
    return std::move(result_);
  }

 private:
  // What the published method makes, to compare with; with walls also which cells count.
  void publish() {
    const std::vector<Grain> grains = laguerre::grains_of(packing_, 1.0);
    const std::vector<Vec3> centers = laguerre::centers_of(grains);
    const CellSums sums = laguerre::cell_sums(
        box_, laguerre::sites_of(box_, grains, options_.spacing), centers, run_.threads());
    count_all_but(sums.at_wall);
    std::vector<CellShape> shapes;
    for (std::size_t g = 0; g < centers.size(); ++g) {
      shapes.push_back(shape_of(sums.cells[g]));
      shapes.back().centroid += centers[g];
    }
    result_.report.published = laguerre::errors_of(packing_, shapes, sums.parts, counts_);
  }

  // Where all touch walls all count.
  void count_all_but(const std::vector<char>& at_wall) {
    counts_.clear();
    for (const char touches : at_wall) counts_.push_back(touches == 0 ? 1 : 0);
    if (std::none_of(counts_.begin(), counts_.end(), [](char c) { return c != 0; })) {
      counts_.assign(at_wall.size(), 1);
    }
  }

  [[nodiscard]] std::vector<char> cells_at_walls() const {
    std::vector<char> at_wall(packing_.inclusions.size(), 0);
    for (const Facet& facet : result_.tessellation.facets) {
      if (facet.outer == Facet::kWall) at_wall[static_cast<std::size_t>(facet.inner)] = 1;
    }
    return at_wall;
  }

  // Relative to the point that the moments are about.
  [[nodiscard]] CellShape shape_of(const CellMoments& cell) const {
    if (cell.measure <= 0.0) return {};
    const Vec3 mean = cell.first / cell.measure;
    return shape_of_moments(box_.dimension, cell.measure, mean,
                            cell.second - cell.measure * dyad(mean));
  }

  // Proportional to what is ordered, for all cells or for those that count.
  void set_targets() {
    std::vector<char> kept(grains_.size(), 0);
    CellSums sums;
    if (options_.keep_wall_cells && !fully_periodic()) {
      sums = laguerre::cell_sums(box_, sites_, laguerre::centers_of(grains_), run_.threads());
      for (std::size_t g = 0; g < kept.size(); ++g) {
        // One without a cell has no measure to keep.
        kept[g] = counts_[g] == 0 && sums.cells[g].measure > 0.0 ? 1 : 0;
      }
    }
    double ordered = 0.0, left = volume(box_);
    targets_.resize(grains_.size());
    for (std::size_t g = 0; g < grains_.size(); ++g) {
      targets_[g] = kept[g] != 0 ? sums.cells[g].measure : volume(grains_[g].body);
      (kept[g] != 0 ? left : ordered) += kept[g] != 0 ? -targets_[g] : targets_[g];
    }
    for (std::size_t g = 0; g < grains_.size(); ++g) {
      if (kept[g] == 0) targets_[g] *= left / ordered;
    }
  }

  [[nodiscard]] bool fully_periodic() const {
    for (std::size_t a = 0; a < static_cast<std::size_t>(box_.dimension); ++a) {
      if (!box_.periodic[a]) return false;
    }
    return true;
  }

  [[nodiscard]] bool steps_in_plane() const {
    return box_.dimension == 2 && options_.shape_rounds > 0;
  }

  void shape_in_plane() {
    ShapeGoal goal{{}, targets_};
    for (const Grain& grain : grains_) goal.shapes.push_back(shape_of_body(grain.body));
    double damping = kFirstDamping;
    spread_centers();
    fit_for_round(false);
    for (int round = 0; round < options_.shape_rounds && !stop_asked(); ++round) {
      run_.report(
          {.stage = "shaping cells", .done = static_cast<double>(round) / options_.shape_rounds});
      const bool late = round + kLateRounds >= options_.shape_rounds;
      const std::vector<Site> before = sites_;
      take_step(goal, damping);
      fit_for_round(late);
      if (options_.connected) keep_connected(before, late ? kMostReturns : 0);
      damping = std::max(kLastDamping, kDampingRatio * damping);
      ++result_.report.shape_rounds;
    }
  }

  // Where the packing is denser in some places than in others cells stand far from their bodies,
  // and many sites have none: the bodies follow. The weights were for where they stood before.
  void spread_centers() {
    for (int k = 0; k < kSpreadings && options_.ordered_measures && !stop_asked(); ++k) {
      fit(kSpreadTolerance, kSpreadSteps);
      for (std::size_t g = 0; g < grains_.size(); ++g) {
        const CellMoments& cell = sums_.cells[g];
        if (cell.measure > 0.0) {
          grains_[g].center += options_.center_gain / cell.measure * cell.first;
        }
        grains_[g].weight = 0.0;
      }
      sites_ = laguerre::sites_of(box_, grains_, options_.spacing);
    }
  }

  // Where measures are not ordered the present ones are to be kept.
  void take_step(ShapeGoal& goal, double damping) {
    for (std::size_t g = 0; g < targets_.size() && !options_.ordered_measures; ++g) {
      if (sums_.cells[g].measure > 0.0) goal.measures[g] = sums_.cells[g].measure;
    }
    const auto interfaces = laguerre::interfaces_of(box_, sites_, run_.threads());
    laguerre::shape_step(box_, goal, laguerre::centers_of(grains_), sums_, interfaces, damping,
                         sites_);
  }

  void fit_for_round(bool late) {
    if (!options_.ordered_measures) {
      fit(1e300, 1);
    } else if (late) {
      fit(kLateTolerance, kLateSteps);
    } else {
      fit(kEarlyTolerance, kEarlySteps);
    }
  }

  // What lies apart is taken out, or, where that is much, the step undone.
  void keep_connected(const std::vector<Site>& before, int returns) {
    for (int k = 0; k < returns && !stop_asked(); ++k) {
      std::vector<char> back = cells_far_apart();
      if (std::count(back.begin(), back.end(), 1) == 0) break;
      if (k > 0) add_neighbors(back);
      for (std::size_t i = 0; i < sites_.size(); ++i) {
        if (back[static_cast<std::size_t>(sites_[i].owner)] != 0) sites_[i] = before[i];
      }
      fit_for_round(true);
    }
    if (sums_.loose_sites == 0) return;
    drop_loose();
    sums_ = laguerre::cell_sums(box_, sites_, laguerre::centers_of(grains_), run_.threads());
    ++result_.report.diagrams;
  }

  [[nodiscard]] std::vector<char> cells_far_apart() const {
    std::vector<char> apart(targets_.size(), 0);
    for (std::size_t g = 0; g < apart.size(); ++g) {
      const double loose = sums_.cells[g].measure - sums_.bodies[g].measure;
      apart[g] = loose > kMostLoose * targets_[g] ? 1 : 0;
    }
    return apart;
  }

  void add_neighbors(std::vector<char>& chosen) const {
    const std::vector<char> first = chosen;
    for (const laguerre::Coupling& c : sums_.couplings) {
      const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
      if (first[a] != 0) chosen[b] = 1;
      if (first[b] != 0) chosen[a] = 1;
    }
  }

  void shape() {
    const Order order = laguerre::order_of(box_.dimension, grains_);
    std::vector<SymMat3> drawn = order.log_shapes;
    for (int round = 0; round < options_.shape_rounds; ++round) {
      if (stop_asked()) return;
      run_.report(
          {.stage = "shaping cells", .done = static_cast<double>(round) / options_.shape_rounds});
      fit(options_.ordered_measures ? kRoundTolerance : 1e300, kRoundSteps);
      laguerre::correct_shapes(box_.dimension, sums_, order, options_, drawn, grains_);
      sites_ = laguerre::sites_of(box_, grains_, options_.spacing);
      ++result_.report.shape_rounds;
    }
  }

  // The last weights. Without the sites whose cells lie apart others take their place, and may come
  // apart in turn, ever fewer.
  void settle() {
    if (!options_.ordered_measures) return;
    if (options_.connected) {
      fit(kLooseTolerance, options_.max_newton_steps);
      for (int k = 0; k < kMostLoosenings && sums_.loose_sites > 0 && !stop_asked(); ++k) {
        drop_loose();
        fit(kLooseTolerance, options_.max_newton_steps);
      }
    }
    fit(options_.measure_tolerance, options_.max_newton_steps);
    if (!reached_) stop_with(LaguerreStop::stalled);
  }

  void drop_loose() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (sums_.loose[i] == 0) sites_[kept++] = sites_[i];
    }
    sites_.resize(kept);
  }

  // Weights for the measures ordered; keeps them with the grains for sites made anew.
  void fit(double tolerance, int steps) {
    if (stop_asked()) return;
    std::vector<double> before(grains_.size());
    for (const Site& site : sites_) before[static_cast<std::size_t>(site.owner)] = site.weight;
    TransportOutcome outcome =
        laguerre::transport(box_, sites_, laguerre::centers_of(grains_), targets_,
                            {.tolerance = tolerance, .max_steps = steps}, run_);
    std::vector<double> after(grains_.size());
    for (const Site& site : sites_) after[static_cast<std::size_t>(site.owner)] = site.weight;
    for (std::size_t g = 0; g < grains_.size(); ++g) grains_[g].weight += after[g] - before[g];
    result_.report.newton_steps += outcome.steps;
    result_.report.diagrams += outcome.evaluations;
    reached_ = outcome.reached;
    sums_ = std::move(outcome.sums);
    stop_asked();
  }

  bool stop_asked() {
    const StopRequest asked = run_.stop_request();
    if (asked == StopRequest::cancelled) stop_with(LaguerreStop::cancelled);
    if (asked == StopRequest::out_of_time) stop_with(LaguerreStop::out_of_time);
    return asked != StopRequest::none;
  }

  // The first reason counts.
  void stop_with(LaguerreStop stop) {
    if (result_.stop == LaguerreStop::finished) result_.stop = stop;
  }

  void finish() {
    result_.tessellation = laguerre::assemble(box_, sites_, cells_of(packing_), run_.threads());
    result_.shapes = cell_shapes(result_.tessellation);
    LaguerreReport& report = result_.report;
    report.sites = static_cast<std::int64_t>(sites_.size());
    report.hidden_sites = sums_.hidden;
    std::vector<int> parts;
    for (const TessellationCell& cell : result_.tessellation.cells) parts.push_back(cell.parts);
    if (counts_.empty()) count_all_but(cells_at_walls());
    report.made = laguerre::errors_of(packing_, result_.shapes, parts, counts_);
  }

  const Packing& packing_;
  const Cell& box_;
  const LaguerreOptions& options_;
  RunContext run_;
  LaguerreResult result_;
  std::vector<char> counts_;  // Of each cell: whether it counts in errors.
  std::vector<Grain> grains_;
  std::vector<Site> sites_;
  std::vector<double> targets_;
  CellSums sums_;
  bool reached_ = false;
};

}  // namespace

LaguerreResult laguerre_tessellate(const Packing& packing, const LaguerreOptions& options,
                                   RunContext run) {
  check_input(packing, options);
  return Tessellator(packing, options, std::move(run)).make();
}

double angle_between_shapes(int dimension, const CellShape& a, const CellShape& b) noexcept {
  const Vec3& s = a.semi_axes;
  const bool flat = dimension == 3 && s.y * s.y > s.x * s.z;
  const Vec3 &u = flat ? a.axes.col_z : a.axes.col_x, &v = flat ? b.axes.col_z : b.axes.col_x;
  return std::atan2(norm(cross(u, v)), std::abs(dot(u, v)));
}

CellShape shape_of_body(const Body& body) noexcept {
  return shape_of_moments(dimension(kind(body)), volume(body), {}, second_moment(body));
}

}  // namespace packstone
