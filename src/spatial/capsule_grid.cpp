#include "spatial/capsule_grid.hpp"

#include <algorithm>

#include "packstone/core/memory_hints.hpp"

namespace packstone {
namespace {

// Bodies per grid cell that a query is fastest with, and pieces of long ones, as measured.
constexpr double kBodiesPerCell = 6.0;
constexpr double kPiecesPerCell = 12.0;
constexpr int kMostCellsAlong = 1024;
constexpr int kMostLevels = 40;
constexpr double kMostPieces = 64.0;

double pieces_of(const Capsule& capsule, double piece) {
  return std::max(1.0, std::floor(2.0 * capsule.half / piece));
}

// The edge of grid cells that hold as many pieces as wanted, these being about as long as the edge.
double edge_for(const Cell& cell, const std::vector<Capsule>& capsules, double per_cell) {
  constexpr int kRounds = 8;  // Each of them has a third of the error.
  const int dimension = cell.dimension;
  const auto edge_of = [&](double pieces) {
    const double wanted = std::max(1.0, pieces / per_cell);
    return dimension == 2 ? std::sqrt(volume(cell) / wanted) : std::cbrt(volume(cell) / wanted);
  };
  double radius = 0.0, half = 0.0;
  for (const Capsule& c : capsules) {
    radius = std::max(radius, c.radius);
    half = std::max(half, c.half);
  }
  // Far finer than what they hold, grid cells are only walked over.
  const double least = std::max(0.5 * radius, 2.0 * half / kMostPieces);
  double edge = edge_of(static_cast<double>(capsules.size()));
  for (int round = 0; round < kRounds; ++round) {
    double pieces = 0.0;
    for (const Capsule& c : capsules) pieces += std::max(1.0, 2.0 * c.half / edge);
    edge = std::max(least, edge_of(pieces));
  }
  return edge;
}

void move_lane(const CapsuleChunk& from, std::size_t lane, CapsuleChunk& to, std::size_t there) {
  for (auto lanes :
       {&CapsuleChunk::x, &CapsuleChunk::y, &CapsuleChunk::z, &CapsuleChunk::axis_x,
        &CapsuleChunk::axis_y, &CapsuleChunk::axis_z, &CapsuleChunk::half, &CapsuleChunk::radius}) {
    (to.*lanes)[there] = (from.*lanes)[lane];
  }
  to.body[there] = from.body[lane];
  to.greatest = std::max(to.greatest, from.body[lane]);
  std::copy_n(from.wrap[lane], 3, to.wrap[there]);
}

}  // namespace

Capsule capsule_about(const PosedBody& body, double around) {
  double radius = body.lateral;
  if (body.form == Form::scalene) radius = std::max(radius, body.second);
  double half = body.form == Form::ball ? 0.0 : body.axial;
  if (is_ellipsoid(body.form)) half = std::max(0.0, half - radius);
  return {body.pose.center, body.pose.axis, half, radius + around};
}

CapsuleGrid::CapsuleGrid(const Cell& cell)
    : cell_(cell),
      slack_(0x1p-19 * std::max({cell.size.x, cell.size.y, cell.size.z})),
      hits_(capsule_hits()) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    per_size_[a] = 1.0 / cell.size[a];
  }
}

std::int32_t CapsuleGrid::level_of(double reach) const {
  const int exponent = reach > smallest_ ? std::ilogb(reach / smallest_) : 0;
  return std::min(exponent, static_cast<int>(levels_.size()) - 1);
}

void CapsuleGrid::shape(Level& level, const std::vector<Capsule>& capsules) {
  level.piece = edge_for(cell_, capsules, kBodiesPerCell);
  const bool cut = std::any_of(capsules.begin(), capsules.end(),
                               [&](const Capsule& c) { return pieces_of(c, level.piece) > 1.0; });
  if (cut) level.piece = edge_for(cell_, capsules, kPiecesPerCell);
  std::size_t cells = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell_.dimension); ++a) {
    level.dims[a] = std::clamp(static_cast<int>(cell_.size[a] / level.piece), 1, kMostCellsAlong);
    cells *= static_cast<std::size_t>(level.dims[a]);
  }
  level.chunks.assign(cells, {});
}

void CapsuleGrid::reset(const std::vector<Capsule>& capsules) {
  levels_.clear();
  places_.assign(capsules.size(), {});
  if (capsules.empty()) return;
  const auto [low, high] =
      std::minmax_element(capsules.begin(), capsules.end(),
                          [](const Capsule& a, const Capsule& b) { return a.reach() < b.reach(); });
  smallest_ = low->reach();
  const int doublings = std::ilogb(high->reach() / smallest_);
  levels_.resize(static_cast<std::size_t>(std::min(kMostLevels, 1 + doublings)));
  std::vector<std::vector<Capsule>> of_level(levels_.size());
  for (std::size_t k = 0; k < capsules.size(); ++k) {
    places_[k].level = level_of(capsules[k].reach());
    of_level[static_cast<std::size_t>(places_[k].level)].push_back(capsules[k]);
  }
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    if (!of_level[l].empty()) shape(levels_[l], of_level[l]);
  }
  std::int64_t pieces = 0;
  for (std::size_t k = 0; k < capsules.size(); ++k) {
    Level& level = levels_[static_cast<std::size_t>(places_[k].level)];
    places_[k].first = pieces;
    places_[k].pieces = static_cast<std::int32_t>(pieces_of(capsules[k], level.piece));
    level.cut = level.cut || places_[k].pieces > 1;
    pieces += places_[k].pieces;
  }
  grid_cells_.assign(static_cast<std::size_t>(pieces), 0);
}

bool CapsuleGrid::Scratch::is_new(std::int32_t body, const Image& image) {
  std::uint32_t& first = first_[static_cast<std::size_t>(body)];
  if (first < found_.size() && found_[first].body == body) {
    const auto is_same = [&](const Seen& s) { return s.body == body && s.image == image; };
    if (std::any_of(found_.begin() + first, found_.end(), is_same)) return false;
  } else {
    first = static_cast<std::uint32_t>(found_.size());
  }
  found_.push_back({body, image});
  return true;
}

CapsuleChunk& CapsuleGrid::chunk_with_room(Level& level, std::int32_t grid_cell) {
  auto at = static_cast<std::size_t>(grid_cell);
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
  return level.chunks[at];
}

std::size_t CapsuleGrid::grid_cell_of(const Level& level, const Vec3& center) const noexcept {
  std::size_t number = 0;
  for (std::size_t a = 3; a-- > 0;) {
    const int n = level.dims[a];
    const int index = std::clamp(static_cast<int>(center[a] * per_size_[a] * n), 0, n - 1);
    number = number * static_cast<std::size_t>(n) + static_cast<std::size_t>(index);
  }
  return number;
}

void CapsuleGrid::prefetch(const Vec3& center) const noexcept {
  for (const Level& level : levels_) {
    if (level.pieces == 0) continue;
    packstone::prefetch(&level.chunks[grid_cell_of(level, center)], sizeof(CapsuleChunk));
  }
}

void CapsuleGrid::insert_piece(Level& level, std::int32_t body, Capsule piece,
                               std::int32_t& grid_cell) {
  std::array<int, 3> wrap{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell_.dimension); ++a) {
    if (!cell_.periodic[a]) continue;
    wrap[a] = static_cast<int>(std::floor(piece.center[a] * per_size_[a]));
    piece.center[a] -= wrap[a] * cell_.size[a];
  }
  grid_cell = static_cast<std::int32_t>(grid_cell_of(level, piece.center));
  level.largest = std::max(level.largest, piece.reach());
  ++level.pieces;
  CapsuleChunk& chunk = chunk_with_room(level, grid_cell);
  const auto lane = static_cast<std::size_t>(chunk.count++);
  chunk.x[lane] = static_cast<float>(piece.center.x);
  chunk.y[lane] = static_cast<float>(piece.center.y);
  chunk.z[lane] = static_cast<float>(piece.center.z);
  chunk.axis_x[lane] = static_cast<float>(piece.axis.x);
  chunk.axis_y[lane] = static_cast<float>(piece.axis.y);
  chunk.axis_z[lane] = static_cast<float>(piece.axis.z);
  chunk.half[lane] = static_cast<float>(piece.half);
  chunk.radius[lane] = static_cast<float>(piece.radius);
  chunk.body[lane] = body;
  chunk.greatest = std::max(chunk.greatest, body);
  for (std::size_t a = 0; a < 3; ++a) chunk.wrap[lane][a] = static_cast<std::int16_t>(wrap[a]);
}

void CapsuleGrid::insert(std::int32_t body, const Capsule& capsule) {
  const Place& place = places_[static_cast<std::size_t>(body)];
  Level& level = levels_[static_cast<std::size_t>(place.level)];
  Capsule piece = capsule;
  piece.half = capsule.half / place.pieces;
  for (std::int32_t k = 0; k < place.pieces; ++k) {
    const double along = (2 * k + 1 - place.pieces) * piece.half;
    if (place.pieces > 1) piece.center = capsule.center + along * capsule.axis;
    insert_piece(level, body, piece, grid_cells_[static_cast<std::size_t>(place.first + k)]);
  }
}

void CapsuleGrid::remove_piece(Level& level, std::int32_t body, std::int32_t grid_cell) {
  --level.pieces;
  CapsuleChunk* held = nullptr;
  std::size_t lane = 0;
  CapsuleChunk* before = nullptr;
  CapsuleChunk* last = &level.chunks[static_cast<std::size_t>(grid_cell)];
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
  move_lane(*last, static_cast<std::size_t>(--last->count), *held, lane);
  if (last->count > 0 || before == nullptr) return;
  last->next = level.free;
  level.free = before->next;
  before->next = -1;
}

void CapsuleGrid::remove(std::int32_t body) {
  const Place& place = places_[static_cast<std::size_t>(body)];
  Level& level = levels_[static_cast<std::size_t>(place.level)];
  for (std::int32_t k = 0; k < place.pieces; ++k) {
    remove_piece(level, body, grid_cells_[static_cast<std::size_t>(place.first + k)]);
  }
}

}  // namespace packstone
