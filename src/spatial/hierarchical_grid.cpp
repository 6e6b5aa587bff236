#include "packstone/spatial/hierarchical_grid.hpp"

#include <algorithm>

#include "packstone/core/error.hpp"
#include "packstone/core/memory_hints.hpp"

namespace packstone {
namespace {

constexpr std::int64_t kFirstRebuild = 32;
// Grid cells along one axis: their index times the rounding of double stays far below kFloatSlack.
constexpr int kMaxDims = 1 << 20;
// Bodies smaller than this times the largest share one level.
constexpr double kLeastRatio = 0x1p-60;

struct Layout {
  std::array<int, 3> dims{1, 1, 1};
  double cost = std::numeric_limits<double>::infinity();
};

// Chunks that a query of `width` (box plus the reach of the level, in cell edges) walks over when
// a grid cell is `width` / `per_width` wide.
Layout layout_for(const std::array<double, 3>& width, double per_width, double count) {
  Layout layout;
  double cells_in_grid = 1.0;
  double cells_in_query = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double wanted = width[a] > 0.0 ? per_width / width[a] : 1.0;
    layout.dims[a] = static_cast<int>(std::clamp(wanted, 1.0, double{kMaxDims}));
    cells_in_grid *= layout.dims[a];
    cells_in_query *= 1.0 + width[a] * layout.dims[a];
  }
  if (cells_in_grid > count) return layout;
  // Further chunks start to appear when a grid cell holds some two bodies on average.
  const double chained = std::max(0.0, 0.25 * (count / cells_in_grid - 2.0));
  layout.cost = cells_in_query * (1.0 + chained);
  return layout;
}

}  // namespace

HierarchicalGrid::Chunk::Chunk() noexcept {
  constexpr float inf = std::numeric_limits<float>::infinity();
  for (Floats& lanes : lo) lanes = Floats{inf, inf, inf, inf};
  for (Floats& lanes : hi) lanes = -Floats{inf, inf, inf, inf};
  std::fill_n(id, kLanes, -1);
  core = Halves{};
}

// A ball. Its center in units of the cell edges, lane by lane the same.
struct HierarchicalGrid::Ball {
  Floats center[3];
  Floats edge[3];  // Of the cell [L].
  Floats radius;   // [L].
};

HierarchicalGrid::HierarchicalGrid(const Cell& cell)
    : cell_(cell),
      core_slack_(0x1p-20 * std::max({cell.size.x, cell.size.y, cell.size.z})),
      periodic_(cell.periodic) {
  check_cell(cell);
  const bool flat = cell.dimension == 2;
  per_edge_ = {1.0 / cell.size.x, 1.0 / cell.size.y, flat ? 0.0 : 1.0 / cell.size.z};
}

void HierarchicalGrid::reserve(std::int64_t count) { reserved_ = count; }

void HierarchicalGrid::clear() noexcept {
  levels_.clear();
  size_ = 0;
  rebuild_at_ = 0;
}

void HierarchicalGrid::insert(std::int32_t id, const Vec3& center, const Vec3& half_extents,
                              double core) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(core * (1.0 - 0x1p-23)));
  const Entry entry{float_box(center, half_extents), id, static_cast<std::uint16_t>(bits >> 16)};
  if (size_ >= rebuild_at_) {
    std::vector<Entry> all = entries();
    all.push_back(entry);
    rebuild(all);
  } else {
    put(level_for(entry), entry);
  }
  ++size_;
}

inline bool HierarchicalGrid::chain_meets(const Level& level, std::size_t head,
                                          const Ball& ball) noexcept {
  using Words = std::uint32_t __attribute__((vector_size(16)));
  constexpr float sure = 1.0F - 0x1p-18F;
  for (const Chunk* chunk = &level.chunks[head];; chunk = &level.chunks[chunk->next]) {
    const Floats dx = ball.edge[0] * (0.5F * (chunk->lo[0] + chunk->hi[0]) - ball.center[0]);
    const Floats dy = ball.edge[1] * (0.5F * (chunk->lo[1] + chunk->hi[1]) - ball.center[1]);
    const Floats dz = ball.edge[2] * (0.5F * (chunk->lo[2] + chunk->hi[2]) - ball.center[2]);
    const Words bits = __builtin_convertvector(chunk->core, Words) << 16;
    const Floats near = sure * (std::bit_cast<Floats>(bits) + ball.radius);
    const Flags hit = dx * dx + dy * dy + dz * dz < near * near;  // False in free lanes, by NaN.
    const auto halves = std::bit_cast<std::array<std::int64_t, 2>>(hit);
    if ((halves[0] | halves[1]) != 0) return true;
    if (chunk->next < 0) return false;
  }
}

inline HierarchicalGrid::Ball HierarchicalGrid::ball_at(const Vec3& center,
                                                        double radius) const noexcept {
  Ball ball;
  ball.radius = all_lanes(radius);
  for (std::size_t a = 0; a < 3; ++a) {
    ball.center[a] = all_lanes(center[a] * per_edge_[a]);
    ball.edge[a] = all_lanes(cell_.size[a]);
  }
  return ball;
}

inline std::size_t HierarchicalGrid::home_of(const Level& level,
                                             const Vec3& center) const noexcept {
  std::size_t home = 0;
  for (std::size_t a = 3; a-- > 0;) {
    const int n = level.dims[a];
    const int index = static_cast<int>(center[a] * per_edge_[a] * n);
    home = home * n + static_cast<std::size_t>(std::min(index, n - 1));
  }
  return home;
}

inline std::array<HierarchicalGrid::AxisRange, 3> HierarchicalGrid::core_ranges(
    const Level& level, const Vec3& center, double radius) const noexcept {
  const double reach = radius + level.largest_core;
  std::array<AxisRange, 3> ranges;
  for (std::size_t a = 0; a < 3; ++a) {
    ranges[a] = axis_range(level, (center[a] - reach) * per_edge_[a],
                           (center[a] + reach) * per_edge_[a], a);
  }
  return ranges;
}

bool HierarchicalGrid::meets_core(const Vec3& center, double radius) const noexcept {
  const double sure = radius - core_slack_;
  if (sure <= 0.0) return false;
  Ball ball = ball_at(center, sure);
  for (const Level& level : levels_) {
    if (chain_meets(level, home_of(level, center), ball)) return true;
  }
  for (const Level& level : levels_) {
    if (level_meets(level, center, sure, ball)) return true;
  }
  return false;
}

bool HierarchicalGrid::meets_core_at_home(const Vec3& center, double radius) const noexcept {
  const double sure = radius - core_slack_;
  if (sure <= 0.0) return false;
  const Ball ball = ball_at(center, sure);
  return std::any_of(levels_.begin(), levels_.end(), [&](const Level& level) {
    return chain_meets(level, home_of(level, center), ball);
  });
}

bool HierarchicalGrid::level_meets(const Level& level, const Vec3& center, double radius,
                                   Ball& ball) const noexcept {
  return !walk(
      level, core_ranges(level, center, radius),
      [&](const Image& image) {
        for (std::size_t a = 0; a < 3; ++a) {
          ball.center[a] = all_lanes(center[a] * per_edge_[a] - image[a]);
        }
      },
      [&](std::size_t head, const Image&) { return !chain_meets(level, head, ball); });
}

void HierarchicalGrid::prefetch_home(const Vec3& center) const noexcept {
  for (const Level& level : levels_) prefetch(&level.chunks[home_of(level, center)], sizeof(Chunk));
}

void HierarchicalGrid::prefetch_core(const Vec3& center, double radius) const noexcept {
  for (const Level& level : levels_) prefetch_cells(level, core_ranges(level, center, radius));
}

void HierarchicalGrid::prefetch_query(const Vec3& center, const Vec3& half_extents,
                                      double margin) const noexcept {
  const UnitBox box = unit_box(center, half_extents, margin);
  for (const Level& level : levels_) prefetch_cells(level, ranges_of(level, box));
}

void HierarchicalGrid::prefetch_cells(const Level& level,
                                      const std::array<AxisRange, 3>& ranges) noexcept {
  walk(
      level, ranges, [](const Image&) {},
      [&](std::size_t head, const Image&) {
        prefetch(&level.chunks[head], sizeof(Chunk));
        return true;
      });
}

HierarchicalGrid::FloatBox HierarchicalGrid::float_box(const Vec3& center,
                                                       const Vec3& half_extents) const {
  const UnitBox box = unit_box(center, half_extents, 0.0);
  FloatBox result;
  for (std::size_t a = 0; a < 3; ++a) {
    result.lo[a] = rounded_down(box.lo[a]);
    result.hi[a] = rounded_up(box.hi[a]);
  }
  return result;
}

double HierarchicalGrid::longest_half_extent(const FloatBox& box) const {
  double longest = 0.0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell_.dimension); ++a) {
    longest = std::max(longest, 0.5 * (double{box.hi[a]} - double{box.lo[a]}) * cell_.size[a]);
  }
  return longest;
}

int HierarchicalGrid::exponent_of(double half_extent) const {
  return static_cast<int>(std::ceil(std::log2(std::max(half_extent / reference_, kLeastRatio))));
}

HierarchicalGrid::Level& HierarchicalGrid::level_for(const Entry& entry) {
  const int exponent = exponent_of(longest_half_extent(entry.box));
  const auto place = std::find_if(levels_.begin(), levels_.end(),
                                  [&](const Level& level) { return level.exponent <= exponent; });
  if (place != levels_.end() && place->exponent == exponent) return *place;
  Level& level = *levels_.emplace(place);
  level.exponent = exponent;
  shape_level(level, {entry}, std::max<std::int64_t>(size_ / 4, 1));
  return level;
}

// How many bodies to lay out for where `count` stand now: growth until the next rebuild included.
std::int64_t HierarchicalGrid::expected(std::int64_t count) const {
  if (reserved_ <= size_) return count + count / 2;
  const double growth = static_cast<double>(reserved_) / static_cast<double>(size_ + 1);
  return static_cast<std::int64_t>(static_cast<double>(count) * std::min(growth, 1.5));
}

// As many grid cells across the width of a typical query as make it walk least, memory permitting.
void HierarchicalGrid::shape_level(Level& level, const std::vector<Entry>& entries,
                                   std::int64_t count) const {
  std::array<double, 3> width{};
  for (const Entry& entry : entries) {
    for (std::size_t a = 0; a < 3; ++a) width[a] += double{entry.box.hi[a]} - entry.box.lo[a];
  }
  for (double& w : width) w *= 2.0 / static_cast<double>(entries.size());
  if (cell_.dimension == 2) width[2] = 0.0;
  Layout best;
  for (double per_width = 0x1p-20; per_width < 9.0; per_width *= 1.189207115002721) {
    const Layout layout = layout_for(width, per_width, static_cast<double>(count));
    if (layout.cost < best.cost) best = layout;
  }
  level.dims = best.dims;
  const std::size_t cells = static_cast<std::size_t>(best.dims[0]) * best.dims[1] * best.dims[2];
  level.chunks.reserve(cells);
  prefer_large_pages(level.chunks.data(), cells * sizeof(Chunk));
  level.chunks.assign(cells, {});
}

void HierarchicalGrid::put(Level& level, const Entry& entry) {
  std::size_t index[3];
  for (std::size_t a = 0; a < 3; ++a) {
    const double lo = entry.box.lo[a];
    const double hi = entry.box.hi[a];
    const int n = level.dims[a];
    const int i = static_cast<int>(std::floor(0.5 * (lo + hi) * n));
    // A center at the very edge may leave the grid by rounding; the slack covers the way back.
    index[a] = static_cast<std::size_t>(std::clamp(i, 0, n - 1));
    level.reach[a] = std::max(level.reach[a], 0.5 * (hi - lo) + kFloatSlack);
  }
  const std::size_t head = (index[2] * level.dims[1] + index[1]) * level.dims[0] + index[0];
  if (level.chunks[head].count == kLanes) {
    level.chunks.push_back(level.chunks[head]);
    level.chunks[head] = Chunk();
    level.chunks[head].next = static_cast<std::int32_t>(level.chunks.size() - 1);
  }
  Chunk& chunk = level.chunks[head];
  const int lane = chunk.count++;
  for (std::size_t a = 0; a < 3; ++a) {
    chunk.lo[a][lane] = entry.box.lo[a];
    chunk.hi[a][lane] = entry.box.hi[a];
  }
  chunk.id[lane] = entry.id;
  chunk.core[lane] = entry.core;
  const auto bits = static_cast<std::uint32_t>(entry.core) << 16;
  level.largest_core = std::max(level.largest_core, double{std::bit_cast<float>(bits)});
}

std::vector<HierarchicalGrid::Entry> HierarchicalGrid::entries() const {
  std::vector<Entry> all;
  all.reserve(static_cast<std::size_t>(size_) + 1);
  for (const Level& level : levels_) {
    for (const Chunk& chunk : level.chunks) {
      for (int l = 0; l < chunk.count; ++l) {
        all.push_back({{{chunk.lo[0][l], chunk.lo[1][l], chunk.lo[2][l]},
                        {chunk.hi[0][l], chunk.hi[1][l], chunk.hi[2][l]}},
                       chunk.id[l],
                       chunk.core[l]});
      }
    }
  }
  return all;
}

void HierarchicalGrid::rebuild(const std::vector<Entry>& all) {
  reference_ = 0.0;
  for (const Entry& entry : all) {
    reference_ = std::max(reference_, longest_half_extent(entry.box));
  }
  std::vector<std::vector<Entry>> by_depth;
  for (const Entry& entry : all) {
    const auto depth = static_cast<std::size_t>(-exponent_of(longest_half_extent(entry.box)));
    if (depth >= by_depth.size()) by_depth.resize(depth + 1);
    by_depth[depth].push_back(entry);
  }
  levels_.clear();
  for (std::size_t depth = 0; depth < by_depth.size(); ++depth) {
    const std::vector<Entry>& members = by_depth[depth];
    if (members.empty()) continue;
    Level& level = levels_.emplace_back();
    level.exponent = -static_cast<int>(depth);
    shape_level(level, members, expected(static_cast<std::int64_t>(members.size())));
    for (const Entry& entry : members) put(level, entry);
  }
  rebuild_at_ = std::max(kFirstRebuild, 2 * static_cast<std::int64_t>(all.size()));
}

}  // namespace packstone
