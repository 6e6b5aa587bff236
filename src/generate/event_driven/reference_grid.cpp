#include "generate/event_driven/reference_grid.hpp"

#include <algorithm>

#include "generate/event_driven/lane_kernels.hpp"

namespace packstone::event_driven {
namespace {

// Bodies per grid cell that a query is fastest with, as measured.
constexpr double kBodiesPerCell = 6.0;
constexpr int kMostCellsAlong = 1024;
constexpr int kMostLevels = 40;

}  // namespace

ReferenceGrid::ReferenceGrid(const Cell& cell)
    : cell_(cell),
      slack_(0x1p-19 * std::max({cell.size.x, cell.size.y, cell.size.z})),
      hits_(lane_kernels().capsules) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    per_size_[a] = 1.0 / cell.size[a];
  }
}

std::int32_t ReferenceGrid::level_of(double reach) const {
  const int exponent = reach > smallest_ ? std::ilogb(reach / smallest_) : 0;
  return std::min(exponent, static_cast<int>(levels_.size()) - 1);
}

void ReferenceGrid::shape(Level& level, std::int64_t bodies, double reach) const {
  const double wanted = std::max(1.0, static_cast<double>(bodies) / kBodiesPerCell);
  const double edge =
      cell_.dimension == 2 ? std::sqrt(volume(cell_) / wanted) : std::cbrt(volume(cell_) / wanted);
  // Far finer than what they hold, grid cells are only walked over.
  const double least = std::max(edge, 0.5 * reach);
  std::size_t cells = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell_.dimension); ++a) {
    level.dims[a] = std::clamp(static_cast<int>(cell_.size[a] / least), 1, kMostCellsAlong);
    cells *= static_cast<std::size_t>(level.dims[a]);
  }
  level.chunks.assign(cells, {});
}

void ReferenceGrid::reset(const std::vector<double>& reaches) {
  levels_.clear();
  places_.assign(reaches.size(), {});
  if (reaches.empty()) return;
  const auto [low, high] = std::minmax_element(reaches.begin(), reaches.end());
  smallest_ = *low;
  levels_.resize(static_cast<std::size_t>(std::min(kMostLevels, 1 + std::ilogb(*high / *low))));
  std::vector<std::int64_t> count(levels_.size(), 0);
  for (const double reach : reaches) {
    const auto l = static_cast<std::size_t>(level_of(reach));
    ++count[l];
    levels_[l].largest = std::max(levels_[l].largest, reach);
  }
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    if (count[l] > 0) shape(levels_[l], count[l], levels_[l].largest);
    levels_[l].largest = 0.0;
  }
}

void ReferenceGrid::insert(std::int32_t body, const Capsule& capsule) {
  const Vec3& center = capsule.center;
  const double reach = capsule.reach();
  Place& place = places_[static_cast<std::size_t>(body)];
  if (place.level < 0) {
    place.level = level_of(reach);
    // Bodies grow after the grid was laid out.
    while (levels_[static_cast<std::size_t>(place.level)].chunks.empty()) --place.level;
  }
  Level& level = levels_[static_cast<std::size_t>(place.level)];
  std::array<int, 3> index{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell_.dimension); ++a) {
    const int n = level.dims[a];
    index[a] = std::clamp(static_cast<int>(center[a] * per_size_[a] * n), 0, n - 1);
  }
  place.cell = (index[2] * level.dims[1] + index[1]) * level.dims[0] + index[0];
  level.largest = std::max(level.largest, reach);
  ++level.bodies;
  auto at = static_cast<std::size_t>(place.cell);
  while (level.chunks[at].count == static_cast<std::int32_t>(CapsuleChunk::kLanes)) {
    if (level.chunks[at].next < 0) {
      std::int32_t fresh = level.free;
      if (fresh >= 0) {
        level.free = level.chunks[static_cast<std::size_t>(fresh)].next;
        level.chunks[static_cast<std::size_t>(fresh)].next = -1;
      } else {
        fresh = static_cast<std::int32_t>(level.chunks.size());
        level.chunks.emplace_back();
      }
      level.chunks[at].next = fresh;
    }
    at = static_cast<std::size_t>(level.chunks[at].next);
  }
  CapsuleChunk& chunk = level.chunks[at];
  const auto lane = static_cast<std::size_t>(chunk.count++);
  chunk.x[lane] = static_cast<float>(center.x);
  chunk.y[lane] = static_cast<float>(center.y);
  chunk.z[lane] = static_cast<float>(center.z);
  chunk.axis_x[lane] = static_cast<float>(capsule.axis.x);
  chunk.axis_y[lane] = static_cast<float>(capsule.axis.y);
  chunk.axis_z[lane] = static_cast<float>(capsule.axis.z);
  chunk.half[lane] = static_cast<float>(capsule.half);
  chunk.radius[lane] = static_cast<float>(capsule.radius);
  chunk.body[lane] = body;
}

void ReferenceGrid::remove(std::int32_t body) {
  const Place& place = places_[static_cast<std::size_t>(body)];
  Level& level = levels_[static_cast<std::size_t>(place.level)];
  --level.bodies;
  CapsuleChunk* held = nullptr;
  std::size_t lane = 0;
  CapsuleChunk* before = nullptr;
  CapsuleChunk* last = &level.chunks[static_cast<std::size_t>(place.cell)];
  for (;;) {
    for (std::size_t l = 0; held == nullptr && l < static_cast<std::size_t>(last->count); ++l) {
      if (last->body[l] != body) continue;
      held = last;
      lane = l;
    }
    if (last->next < 0) break;
    before = last;
    last = &level.chunks[static_cast<std::size_t>(last->next)];
  }
  const auto end = static_cast<std::size_t>(--last->count);
  for (auto lanes :
       {&CapsuleChunk::x, &CapsuleChunk::y, &CapsuleChunk::z, &CapsuleChunk::axis_x,
        &CapsuleChunk::axis_y, &CapsuleChunk::axis_z, &CapsuleChunk::half, &CapsuleChunk::radius}) {
    (held->*lanes)[lane] = (last->*lanes)[end];
  }
  held->body[lane] = last->body[end];
  if (last->count > 0 || before == nullptr) return;
  last->next = level.free;
  level.free = before->next;
  before->next = -1;
}

}  // namespace packstone::event_driven
