#include "generate/rsa/equal_balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "generate/rsa/ball_grid.hpp"
#include "generate/rsa/voxel_split.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/parallel.hpp"
#include "packstone/core/random.hpp"
#include "packstone/core/tolerances.hpp"

namespace packstone::rsa {
namespace {

// Measured: the time is flat around these, for disks and spheres.
constexpr double kPlainTrialsPerBin = 1.5;
constexpr double kTrialsPerVoxel = 0.5;
// A pass over the voxels of a bin costs about as much as this many plain trials.
constexpr double kPassPerBin = 3.0;

constexpr std::int64_t kTrialsPerBatch = 64;
constexpr std::int64_t kBatchesPerPoll = 64;
// Chunks have their own numbers, so their size is part of the promise of equal bits.
constexpr std::int64_t kVoxelsPerChunk = 4096;
constexpr std::int64_t kChunksPerSlab = 64;

// Voxel indices stay exact in a double and above the spacing of doubles.
constexpr std::int64_t kFinestIndex = std::int64_t{1} << 52;
constexpr double kMostBins = 0x1p36;

struct Distances {
  double keep = 0.0;  // Between centers [L].
  double wall = 0.0;  // From center to wall [L].
};

// What a center must keep so that an exact check proves the gap, whichever way it forms the
// difference of two centers and a shift by the period: docs/algorithms/rsa_saturation.md, (3).
Distances distances(const EqualBallsOrder& order) {
  const Vec3& size = order.cell.size;
  const double shift = 32 * kUnitRoundoff * (size.x + size.y + size.z);
  return {(2.0 * order.radius + order.min_gap) * (1.0 + 256 * kUnitRoundoff) + shift,
          order.radius * (1.0 + 64 * kUnitRoundoff) + shift};
}

// Twelve digits: enough to tell a radius from half a cell that it hardly misses.
std::string text(double x) { return number_text(x, 12); }

void check_room(const EqualBallsOrder& order, const Distances& need) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(order.cell.dimension); ++axis) {
    const double length = order.cell.size[axis];
    const bool periodic = order.cell.periodic[axis];
    if (periodic ? length > need.keep : length >= 2.0 * need.wall) continue;
    const std::string size = "cell.size[" + std::to_string(axis) + "] = " + text(length);
    throw InvalidArgument("radius = " + text(order.radius) +
                          (periodic ? " with min_gap = " + text(order.min_gap) +
                                          ": the body meets its own image, " + size +
                                          " must exceed 2 radius + min_gap"
                                    : ": the body does not fit between the walls, " + size +
                                          " must be at least 2 radius (and a rounding margin)"));
  }
}

void check_order(const EqualBallsOrder& order) {
  check_cell(order.cell);
  if (!(order.radius > 0.0) || !std::isfinite(order.radius)) {
    throw InvalidArgument("radius = " + text(order.radius) + ", allowed are finite lengths > 0");
  }
  if (!(order.min_gap >= 0.0) || !std::isfinite(order.min_gap)) {
    throw InvalidArgument("min_gap = " + text(order.min_gap) + ", allowed are finite lengths >= 0");
  }
  if (order.target < 0) {
    throw InvalidArgument("target = " + std::to_string(order.target) + ", allowed is >= 0");
  }
  const Distances need = distances(order);
  check_room(order, need);
  double bins = 1.0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(order.cell.dimension); ++axis) {
    bins *= std::sqrt(order.cell.dimension) * order.cell.size[axis] / need.keep + 1.0;
  }
  if (!(bins <= kMostBins)) {
    throw InvalidArgument("radius = " + text(order.radius) +
                          " is too small for this cell, which would hold some 10^10 bodies");
  }
}

template <int Dim>
class EqualBalls {
 public:
  EqualBalls(const EqualBallsOrder& order, const CenterRange<Dim>& range, double keep,
             RunContext& run)
      : order_(order), run_(run), grid_(range, keep) {
    for (int axis = 0; axis < Dim; ++axis) bins_ *= static_cast<double>(grid_.count()[axis]);
  }

  EqualBallsRun place_all() {
    if (reached()) return std::move(result_);
    bool more = try_plainly();
    if (more) list_bins();
    while (more) more = pass();
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::int64_t placed() const {
    return static_cast<std::int64_t>(result_.centers.size());
  }
  [[nodiscard]] bool open() const {
    return order_.target == std::numeric_limits<std::int64_t>::max();
  }
  [[nodiscard]] bool reached() const { return placed() >= order_.target; }

  // Reports, and returns true when the run has to end.
  bool poll(std::string_view stage) {
    const double ball = order_.cell.dimension == 2
                            ? std::numbers::pi * order_.radius * order_.radius
                            : 4.0 / 3.0 * std::numbers::pi * std::pow(order_.radius, 3);
    const double fraction = static_cast<double>(placed()) * ball / volume(order_.cell);
    // Without a target: against the known fraction at saturation of balls grown by half the gap.
    const double full =
        (Dim == 2 ? 0.547 : 0.384) * std::pow(1.0 + 0.5 * order_.min_gap / order_.radius, -Dim);
    const double done = open() ? fraction / full
                               : static_cast<double>(placed()) / static_cast<double>(order_.target);
    run_.report({stage, std::min(1.0, done), fraction, placed(), open() ? 0 : order_.target});
    const StopRequest request = run_.stop_request();
    if (request == StopRequest::none) return false;
    result_.stop = request == StopRequest::cancelled ? RsaStop::cancelled : RsaStop::out_of_time;
    return true;
  }

  // Stores a center that is_free(); true when it was the last one wanted.
  bool place(const Point<Dim>& p, const Index<Dim>& bin) {
    grid_.place(p, bin);
    Vec3 center;
    for (int axis = 0; axis < Dim; ++axis) center[static_cast<std::size_t>(axis)] = p[axis];
    result_.centers.push_back(center);
    return reached();
  }

  // While room is plenty: positions uniform in the whole range. False: the run is over.
  bool try_plainly() {
    RandomStream random(order_.seed, StreamId::rsa_center, 0, order_.start);
    const auto window = static_cast<std::int64_t>(std::ceil(bins_ / 8 / kTrialsPerBatch));
    std::int64_t gained = 0;
    do {
      const std::int64_t before = placed();
      for (std::int64_t batch = 0; batch < window; ++batch) {
        if (batch % kBatchesPerPoll == 0 && poll("placing")) return false;
        if (try_batch(random)) return false;
      }
      gained = placed() - before;
    } while (plain_trials_pay(gained, window * kTrialsPerBatch));
    return true;
  }

  // Past the first trials, plain ones go on only where they come to the target sooner than a pass
  // over the voxels. Room shrinks on the way: hence the factor.
  [[nodiscard]] bool plain_trials_pay(std::int64_t gained, std::int64_t trials) const {
    if (static_cast<double>(result_.trials) < kPlainTrialsPerBin * bins_) return true;
    if (open() || gained == 0) return false;
    const double missing = static_cast<double>(order_.target - placed());
    const double trials_each = static_cast<double>(trials) / static_cast<double>(gained);
    return 1.5 * missing * trials_each < kPassPerBin * bins_;
  }

  // Positions are drawn ahead of their tests, so that memory is there in time. True: target met.
  bool try_batch(RandomStream& random) {
    std::array<BallTrial<Dim>, kTrialsPerBatch> batch;
    std::array<std::int64_t, kTrialsPerBatch> slots;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      draw(random, batch[i]);
      slots[i] = grid_.slot(batch[i].bin);
      grid_.prefetch(slots[i]);
    }
    for (std::size_t i = 0; i < batch.size(); ++i) {
      ++result_.trials;
      if (grid_.is_free(batch[i].p, slots[i]) && place(batch[i].p, batch[i].bin)) return true;
    }
    return false;
  }

  // A position uniform in the range, and its bin: the integer part of one number says which bin,
  // the rest where in it.
  void draw(RandomStream& random, BallTrial<Dim>& out) const {
    for (int axis = 0; axis < Dim; ++axis) {
      const double s = random.uniform() * static_cast<double>(grid_.count()[axis]);
      out.bin[axis] = std::min(static_cast<std::int64_t>(s), grid_.count()[axis] - 1);
      const double low = bins_lattice_.corner(out.bin[axis], axis);
      const double high = bins_lattice_.corner(out.bin[axis] + 1, axis);
      const double part = s - static_cast<double>(out.bin[axis]);
      out.p[axis] = std::min(low + part * (high - low), high);
    }
  }

  void list_bins() {
    Index<Dim> bin{};
    while (bin[Dim - 1] < grid_.count()[Dim - 1]) {
      // A bin with a center is covered by its ball.
      if (!grid_.occupied(grid_.slot(bin))) voxels_.push_back(bin);
      for (int axis = 0; axis < Dim; ++axis) {
        if (++bin[axis] < grid_.count()[axis] || axis == Dim - 1) break;
        bin[axis] = 0;
      }
    }
  }

  [[nodiscard]] bool can_split() const {
    for (int axis = 0; axis < Dim; ++axis) {
      if (grid_.count()[axis] << (level_ + 1) > kFinestIndex) return false;
    }
    return true;
  }

  // Splits all voxels once and places what their trials give. False: the run is over.
  bool pass() {
    if (voxels_.empty() || !can_split()) {
      result_.stop = voxels_.empty() ? RsaStop::saturated : RsaStop::given_up;
      return false;
    }
    std::vector<Index<Dim>> children;
    std::vector<BallTrial<Dim>> candidates;
    if (!split_all(children, candidates)) return false;
    voxels_ = std::move(children);
    ++level_;
    return !settle(candidates);
  }

  // Chunk by chunk, on all threads; outputs are joined in the order of the voxels. False: stopped.
  bool split_all(std::vector<Index<Dim>>& children, std::vector<BallTrial<Dim>>& candidates) {
    const VoxelLattice<Dim> parent_lattice(grid_, level_);
    const VoxelLattice<Dim> child_lattice(grid_, level_ + 1);
    const std::span<const Index<Dim>> voxels(voxels_);
    const auto total = static_cast<std::int64_t>(voxels.size());
    const std::int64_t chunks = (total + kVoxelsPerChunk - 1) / kVoxelsPerChunk;
    const std::uint64_t item = order_.start << 32 | static_cast<std::uint64_t>(level_);
    std::vector<SplitOutput<Dim>> outputs(
        static_cast<std::size_t>(std::min(chunks, kChunksPerSlab)));
    const auto split_chunk = [&](std::int64_t chunk, SplitOutput<Dim>& out) {
      const std::int64_t begin = chunk * kVoxelsPerChunk;
      const std::int64_t count = std::min(kVoxelsPerChunk, total - begin);
      VoxelSplitter<Dim> splitter(
          grid_, parent_lattice, child_lattice, kTrialsPerVoxel,
          RandomStream(order_.seed, StreamId::rsa_voxel, item, static_cast<std::uint64_t>(chunk)));
      splitter.split(
          voxels.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(count)), out);
    };
    for (std::int64_t first = 0; first < chunks; first += kChunksPerSlab) {
      if (poll("searching voxels")) return false;
      const std::int64_t count = std::min(kChunksPerSlab, chunks - first);
      parallel_for(count, run_.threads(), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k < end; ++k) split_chunk(first + k, outputs[k]);
      });
      for (std::int64_t k = 0; k < count; ++k) {
        const SplitOutput<Dim>& out = outputs[static_cast<std::size_t>(k)];
        children.insert(children.end(), out.voxels.begin(), out.voxels.end());
        candidates.insert(candidates.end(), out.candidates.begin(), out.candidates.end());
        result_.trials += out.trials;
      }
    }
    return true;
  }

  // Places the candidates of a pass in the order of their times. True: the run is over.
  bool settle(const std::vector<BallTrial<Dim>>& candidates) {
    constexpr std::size_t kAhead = 8;
    std::vector<std::pair<std::uint64_t, std::size_t>> sequence(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) sequence[i] = {candidates[i].time, i};
    std::sort(sequence.begin(), sequence.end());
    for (std::size_t i = 0; i < sequence.size(); ++i) {
      if (i % (kTrialsPerBatch * kBatchesPerPoll) == 0 && poll("placing")) return true;
      if (i + kAhead < sequence.size()) {
        grid_.prefetch(grid_.slot(candidates[sequence[i + kAhead].second].bin));
      }
      const BallTrial<Dim>& candidate = candidates[sequence[i].second];
      if (!grid_.is_free(candidate.p, grid_.slot(candidate.bin))) continue;
      if (place(candidate.p, candidate.bin)) return true;
    }
    return false;
  }

  const EqualBallsOrder& order_;
  RunContext& run_;
  BallGrid<Dim> grid_;
  VoxelLattice<Dim> bins_lattice_{grid_, 0};
  double bins_ = 1.0;
  int level_ = 0;
  std::vector<Index<Dim>> voxels_;  // Of the present level; cover all that is free.
  EqualBallsRun result_;
};

template <int Dim>
EqualBallsRun run_in(const EqualBallsOrder& order, RunContext& run) {
  const Distances need = distances(order);
  CenterRange<Dim> range;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double size = order.cell.size[a];
    const bool periodic = order.cell.periodic[a];
    range.periodic[a] = periodic;
    range.low[a] = periodic ? 0.0 : need.wall;
    range.high[a] = periodic ? std::nextafter(size, 0.0) : size - need.wall;
    range.width[a] = periodic ? size : range.high[a] - range.low[a];
  }
  return EqualBalls<Dim>(order, range, need.keep, run).place_all();
}

}  // namespace

EqualBallsRun rsa_equal_balls(const EqualBallsOrder& order, RunContext run) {
  check_order(order);
  return order.cell.dimension == 2 ? run_in<2>(order, run) : run_in<3>(order, run);
}

}  // namespace packstone::rsa
