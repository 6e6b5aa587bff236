#include "generate/event_driven/reference_grid.hpp"

#include <algorithm>

// Vectors pass between inlined functions alone: no binary interface.
#pragma GCC diagnostic ignored "-Wpsabi"

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
      hits_(__builtin_cpu_supports("avx2") != 0 ? &hits_wide : &hits_narrow) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    per_size_[a] = 1.0 / cell.size[a];
  }
}

std::int32_t ReferenceGrid::level_of(double reach) const {
  const int exponent = reach > smallest_ ? std::ilogb(reach / smallest_) : 0;
  return std::min(exponent, static_cast<int>(levels_.size()) - 1);
}

// Bounding balls first; then the capsules, by the plane across the way between the points of their
// segments that come nearest. Those points need not be found exactly: any plane is a proof.
[[gnu::always_inline]] inline unsigned ReferenceGrid::hits_in(const Chunk& c, const Seen& s) {
  using Floats = float __attribute__((vector_size(32)));
  using Flags = std::int32_t __attribute__((vector_size(32)));
  const auto lanes = [](const std::array<float, kLanes>& from) __attribute__((always_inline)) {
    Floats to;
    __builtin_memcpy(&to, from.data(), sizeof to);
    return to;
  };
  const Floats x = lanes(c.x) - s.x, y = lanes(c.y) - s.y, z = lanes(c.z) - s.z;
  const Floats half = lanes(c.half), radii = lanes(c.radius) + s.radius;
  const Floats rr = x * x + y * y + z * z, reach = half + radii + s.half;
  Flags meet = rr <= reach * reach;
  const auto bits = [&c](const Flags& flags) __attribute__((always_inline)) {
    unsigned result = 0;
    for (std::size_t l = 0; l < kLanes; ++l) result |= static_cast<unsigned>(flags[l] & 1) << l;
    return result & ((1U << c.count) - 1U);
  };
  const unsigned near = bits(meet);
  if (near == 0) return 0;
  const Floats ux = lanes(c.axis_x), uy = lanes(c.axis_y), uz = lanes(c.axis_z);
  const Floats cosine = ux * s.axis_x + uy * s.axis_y + uz * s.axis_z;
  const Floats along_own = x * s.axis_x + y * s.axis_y + z * s.axis_z;
  const Floats along = x * ux + y * uy + z * uz;
  const auto within = [](const Floats& v, const Floats& most) __attribute__((always_inline)) {
    const Floats low = v > -most ? v : -most;
    return low < most ? low : most;
  };
  const Floats sine_sq = 1.0F - cosine * cosine;
  const Floats own_half = Floats{} + s.half;
  const Floats denominator = sine_sq > 1e-6F ? sine_sq : Floats{} + 1e-6F;
  const Floats first = within((along_own - cosine * along) / denominator, own_half);
  const Floats there = within(cosine * first - along, half);
  const Floats here = within(along_own + cosine * there, own_half);
  const Floats dx = x + there * ux - here * s.axis_x, dy = y + there * uy - here * s.axis_y,
               dz = z + there * uz - here * s.axis_z;
  const auto magnitude = [](const Floats& v) __attribute__((always_inline)) {
    return v < 0.0F ? -v : v;
  };
  const Floats apart = dx * x + dy * y + dz * z - half * magnitude(dx * ux + dy * uy + dz * uz) -
                       own_half * magnitude(dx * s.axis_x + dy * s.axis_y + dz * s.axis_z);
  const Floats dd = dx * dx + dy * dy + dz * dz;
  const Flags separated = (apart > 0.0F) & (apart * apart > radii * radii * dd);
  return near & ~bits(separated);
}

[[gnu::target("avx2")]] unsigned ReferenceGrid::hits_wide(const Chunk& chunk, const Seen& seen) {
  return hits_in(chunk, seen);
}
unsigned ReferenceGrid::hits_narrow(const Chunk& chunk, const Seen& seen) {
  return hits_in(chunk, seen);
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
  while (level.chunks[at].count == static_cast<std::int32_t>(kLanes)) {
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
  Chunk& chunk = level.chunks[at];
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
  Chunk* held = nullptr;
  std::size_t lane = 0;
  Chunk* before = nullptr;
  Chunk* last = &level.chunks[static_cast<std::size_t>(place.cell)];
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
  for (auto lanes : {&Chunk::x, &Chunk::y, &Chunk::z, &Chunk::axis_x, &Chunk::axis_y,
                     &Chunk::axis_z, &Chunk::half, &Chunk::radius}) {
    (held->*lanes)[lane] = (last->*lanes)[end];
  }
  held->body[lane] = last->body[end];
  if (last->count > 0 || before == nullptr) return;
  last->next = level.free;
  level.free = before->next;
  before->next = -1;
}

}  // namespace packstone::event_driven
