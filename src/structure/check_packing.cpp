#include "packstone/structure/check_packing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

#include "packstone/core/compensated_sum.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/parallel.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/geometry/support.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"
#include "packstone/spatial/separation.hpp"
#include "packstone/structure/images.hpp"

namespace packstone {
namespace {

using Image = std::array<int, 3>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Inclusions in a row that share one search for the smallest gap. The result does not depend on
// threads because this partition does not.
constexpr std::int64_t kBlock = 64;
// Blocks between two reports of progress.
constexpr std::int64_t kReportBlocks = 128;
// Inclusions that give the first guess at the smallest gap.
constexpr std::int64_t kSamples = 64;
// Coordinates near the far wall have this resolution, relative to the length of the cell.
constexpr double kWallRoundoff = 4 * kUnitRoundoff;

void take_census(const Packing& packing, Certificate& certificate) {
  std::vector<CompensatedSum> volumes(packing.groups.size());
  CompensatedSum total;
  for (const std::string& name : packing.groups) certificate.groups.push_back({name, 0, 0.0});
  for (const Inclusion& inclusion : packing.inclusions) {
    const double v = volume(inclusion.body);
    total.add(v);
    volumes[inclusion.group].add(v);
    ++certificate.groups[inclusion.group].count;
  }
  certificate.count = static_cast<std::int64_t>(packing.inclusions.size());
  certificate.fraction = total.value() / volume(packing.cell);
  for (std::size_t g = 0; g < volumes.size(); ++g) {
    certificate.groups[g].fraction = volumes[g].value() / volume(packing.cell);
  }
}

// The wall that inclusion `i` crosses deepest. Within rounding: a body that overshoots a wall by no
// more than the two roundoffs is inside.
std::optional<WallCrossing> crossing(const Packing& packing, std::int64_t i) {
  const Cell& cell = packing.cell;
  const Inclusion& inclusion = packing.inclusions[static_cast<std::size_t>(i)];
  std::optional<WallCrossing> deepest;
  for (int axis = 0; axis < cell.dimension; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (cell.periodic[a]) continue;
    Vec3 outward;
    outward[a] = 1.0;
    const double reach = support(inclusion.body, outward);  // the same both ways
    const double length = cell.size[a];
    const double slack = kSupportRoundoff * circum_radius(inclusion.body) + kWallRoundoff * length;
    const double x = inclusion.center[a];
    for (const WallCrossing& at : {WallCrossing{i, axis, 0.0, reach - x},
                                   WallCrossing{i, axis, length, reach - (length - x)}}) {
      if (at.depth > slack && (!deepest || at.depth > deepest->depth)) deepest = at;
    }
  }
  return deepest;
}

std::vector<WallCrossing> crossings(const Packing& packing) {
  std::vector<WallCrossing> found;
  for (std::size_t i = 0; i < packing.inclusions.size(); ++i) {
    if (const auto one = crossing(packing, static_cast<std::int64_t>(i))) found.push_back(*one);
  }
  return found;
}

void check_options(const Cell& cell, const CheckOptions& options) {
  if (const auto reason = why_no_least_gap(cell, options.min_gap)) {
    throw InvalidArgument("min_gap = " + number_text(options.min_gap) + "; " + *reason);
  }
}

// Of i and its own images, and of two inclusions, one of each mirrored pair.
bool is_canonical(std::int64_t i, std::int64_t j, const Image& image) {
  return i < j || (i == j && image > Image{0, 0, 0});
}

// The smallest gap seen so far.
struct SmallestGap {
  double value = kInfinity;
  double error = 0.0;
  double lower = kInfinity;  // Least proven lower bound among all pairs measured.
  std::int64_t a = -1;
  std::int64_t b = -1;
  Image image{0, 0, 0};

  void take(const SmallestGap& other) {
    const double least = std::min(lower, other.lower);
    const auto rank = [](const SmallestGap& g) { return std::tie(g.value, g.a, g.b, g.image); };
    if (rank(other) < rank(*this)) *this = other;
    lower = least;
  }
};

struct PairCounts {
  std::int64_t overlaps = 0;
  std::int64_t gaps_below = 0;
  std::int64_t pairs_checked = 0;
};

struct BlockResult {
  SmallestGap smallest;
  PairCounts counts;
};

// All pairs of a packing, by the boxes of the inclusions.
class PairSearch {
 public:
  PairSearch(const Packing& packing, double min_gap)
      : packing_(packing), min_gap_(min_gap), grid_(packing.cell) {
    for (const Inclusion& inclusion : packing.inclusions) {
      extents_.push_back(half_extents(inclusion.body));
      check_images(packing.cell, extents_.size() - 1, extents_.back());
    }
    grid_.reserve(count());
    for (std::int64_t i = 0; i < count(); ++i) {
      grid_.insert(static_cast<std::int32_t>(i), packing.inclusions[i].center, extents_[i]);
    }
  }

  [[nodiscard]] std::int64_t count() const {
    return static_cast<std::int64_t>(packing_.inclusions.size());
  }

  // Calls visit(j, image) for every image whose box comes within `margin` of inclusion i.
  template <class Visit>
  void near(std::int64_t i, double margin, const Visit& visit) const {
    grid_.query(packing_.inclusions[i].center, extents_[i], margin,
                [&](std::int32_t j, const Image& image) {
                  visit(static_cast<std::int64_t>(j), image);
                  return true;
                });
  }

  // An upper bound on the smallest gap: that of some near pairs. Infinite only without any pair.
  [[nodiscard]] SmallestGap first_guess() const {
    BlockResult result;
    if (count() == 0) return result.smallest;
    const Cell& cell = packing_.cell;
    const double widest = std::max({cell.size.x, cell.size.y, cell.size.z});
    double margin = std::max({extents_[0].x, extents_[0].y, extents_[0].z});
    sample(0, margin, result);
    // Once the margin is as long as the cell, the first inclusion has met every other one.
    while (result.smallest.a < 0 && margin <= widest) sample(0, margin *= 2.0, result);
    for (std::int64_t k = 1; k < std::min(kSamples, count()); ++k) {
      const std::int64_t i = k * count() / std::min(kSamples, count());
      sample(i, std::max(0.0, result.smallest.value), result);
    }
    return result.smallest;
  }

  // Every pair whose first inclusion stands in [begin, end).
  [[nodiscard]] BlockResult check(std::int64_t begin, std::int64_t end,
                                  const SmallestGap& guess) const {
    BlockResult result{guess, {}};
    for (std::int64_t i = begin; i < end; ++i) {
      near(i, threshold(result), [&](std::int64_t j, const Image& image) {
        if (is_canonical(i, j, image)) check_pair(i, j, image, result);
      });
    }
    return result;
  }

  // One direction for each pair of inclusion i, in the order of (b, image).
  void directions(std::int64_t i, std::vector<PairWitness>& witnesses) const {
    const auto first = static_cast<std::ptrdiff_t>(witnesses.size());
    near(i, min_gap_, [&](std::int64_t j, const Image& image) {
      if (is_canonical(i, j, image)) witnesses.push_back(witness(i, j, image));
    });
    std::sort(witnesses.begin() + first, witnesses.end(),
              [](const PairWitness& x, const PairWitness& y) {
                return std::tie(x.b, x.image) < std::tie(y.b, y.image);
              });
  }

 private:
  // Pairs proven farther apart than this need no closer look.
  [[nodiscard]] double threshold(const BlockResult& result) const {
    return std::max(result.smallest.value, min_gap_);
  }

  void sample(std::int64_t i, double margin, BlockResult& result) const {
    near(i, margin, [&](std::int64_t j, const Image& image) {
      if (is_canonical(i, j, image)) {
        check_pair(i, j, image, result);
      } else if (i != j) {
        check_pair(j, i, {-image[0], -image[1], -image[2]}, result);
      }
    });
  }

  void check_pair(std::int64_t i, std::int64_t j, const Image& image, BlockResult& result) const {
    const Body& a = packing_.inclusions[i].body;
    const Body& b = packing_.inclusions[j].body;
    const Separation at = separation_of(i, j, image);
    const double enough = threshold(result) + at.error;
    if (enough < kInfinity && quick_gap_bound(a, b, at.r_ab) > enough) return;
    ++result.counts.pairs_checked;
    if (enough < kInfinity && apart(a, b, at.r_ab, enough)) return;
    const Gap measured = gap(a, b, at.r_ab);
    const double error = measured.error + at.error;
    result.smallest.take({measured.value, error, measured.value - error, i, j, image});
    if (apart(a, b, at.r_ab, min_gap_ + at.error)) return;
    const bool gap_only = min_gap_ > 0.0 && apart(a, b, at.r_ab, at.error);
    ++(gap_only ? result.counts.gaps_below : result.counts.overlaps);
  }

  [[nodiscard]] PairWitness witness(std::int64_t i, std::int64_t j, const Image& image) const {
    const Body& a = packing_.inclusions[i].body;
    const Body& b = packing_.inclusions[j].body;
    const Separation at = separation_of(i, j, image);
    const Decision decision = decide(a, b, at.r_ab, min_gap_ + at.error);
    const Vec3 d =
        decision.verdict == Verdict::separated ? decision.witness : gap(a, b, at.r_ab).normal;
    return {i, j, image, d, proven_gap(a, b, at.r_ab, d) - at.error};
  }

  [[nodiscard]] Separation separation_of(std::int64_t i, std::int64_t j, const Image& image) const {
    return separation(packing_.cell, packing_.inclusions[i].center, packing_.inclusions[j].center,
                      image);
  }

  static bool apart(const Body& a, const Body& b, const Vec3& r_ab, double gap) {
    return overlap(a, b, r_ab, gap) == Verdict::separated;
  }

  const Packing& packing_;
  double min_gap_;
  std::vector<Vec3> extents_;
  HierarchicalGrid grid_;
};

// Calls block(k, begin, end) for every block of inclusions, in parallel.
template <class Block>
void for_each_block(std::int64_t count, RunContext& run, const Block& block) {
  const std::int64_t blocks = (count + kBlock - 1) / kBlock;
  for (std::int64_t start = 0; start < blocks; start += kReportBlocks) {
    const std::int64_t stop = std::min(start + kReportBlocks, blocks);
    parallel_for(stop - start, run.threads(), 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t k = start + begin; k < start + end; ++k) {
        block(k, k * kBlock, std::min((k + 1) * kBlock, count));
      }
    });
    Progress progress;
    progress.stage = "checking pairs";
    progress.done = static_cast<double>(stop) / static_cast<double>(blocks);
    run.report(progress);
  }
}

std::size_t block_count(std::int64_t count) {
  return static_cast<std::size_t>((count + kBlock - 1) / kBlock);
}

void check_pairs(const PairSearch& search, RunContext& run, Certificate& certificate) {
  SmallestGap smallest = search.first_guess();
  std::vector<BlockResult> results(block_count(search.count()));
  for_each_block(search.count(), run, [&](std::int64_t k, std::int64_t begin, std::int64_t end) {
    results[k] = search.check(begin, end, smallest);
  });
  for (const BlockResult& result : results) {
    smallest.take(result.smallest);
    certificate.overlaps += result.counts.overlaps;
    certificate.gaps_below += result.counts.gaps_below;
    certificate.pairs_checked += result.counts.pairs_checked;
  }
  certificate.smallest_gap = smallest.value;
  if (smallest.a < 0) return;
  certificate.smallest_gap_error = std::max(smallest.error, smallest.value - smallest.lower);
  certificate.worst_pair = {smallest.a, smallest.b};
  certificate.worst_image = smallest.image;
}

}  // namespace

Certificate check_packing(const Packing& packing, const CheckOptions& options, RunContext run) {
  check_well_formed(packing);
  check_options(packing.cell, options);
  Certificate certificate;
  certificate.min_gap = options.min_gap;
  take_census(packing, certificate);
  const PairSearch search(packing, options.min_gap);
  check_pairs(search, run, certificate);
  certificate.outside_walls = static_cast<std::int64_t>(crossings(packing).size());
  return certificate;
}

std::vector<WallCrossing> wall_crossings(const Packing& packing) {
  check_well_formed(packing);
  return crossings(packing);
}

std::optional<WallCrossing> deepest_crossing(const Packing& packing) {
  const std::vector<WallCrossing> all = wall_crossings(packing);
  const auto found = std::max_element(
      all.begin(), all.end(),
      [](const WallCrossing& a, const WallCrossing& b) { return a.depth < b.depth; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

std::vector<PairWitness> separating_directions(const Packing& packing, const CheckOptions& options,
                                               RunContext run) {
  check_well_formed(packing);
  check_options(packing.cell, options);
  const PairSearch search(packing, options.min_gap);
  std::vector<std::vector<PairWitness>> blocks(block_count(search.count()));
  for_each_block(search.count(), run, [&](std::int64_t k, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) search.directions(i, blocks[k]);
  });
  std::vector<PairWitness> witnesses;
  for (const auto& block : blocks) witnesses.insert(witnesses.end(), block.begin(), block.end());
  return witnesses;
}

}  // namespace packstone
