#include "generate/rsa/vacancy_list.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "generate/rsa/box_cuts.hpp"
#include "packstone/core/parallel.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/support.hpp"

namespace packstone::rsa {
namespace {

// Beyond this many cells splitting stops: some 200 MB with their neighbors.
constexpr std::int64_t kMostCells = 3'000'000;

// Boxes are not split below this part of the cell edge [-].
constexpr std::int32_t kMostCellsAlongAxis = 1 << 30;

// Cores are tabulated up to this many orientation cells.
constexpr std::int32_t kMostTabulatedCores = 6 << 10;

// Boxes are tested a little larger than they are, by this part of the coordinates: above the
// rounding of corners and of differences of coordinates [-].
constexpr double kBoxMargin = 8 * kUnitRoundoff;

// Lever of a turn: how far the surface moves per radian [L].
double lever(const Outline& outline) {
  return outline.ends == Outline::Ends::loose ? outline.circum_radius - outline.in_radius
                                              : outline.half_length;
}

double box_reach(const Vec3& half, const Vec3& n) {
  return half.x * std::abs(n.x) + half.y * std::abs(n.y) + half.z * std::abs(n.z);
}

}  // namespace

VacancyList::VacancyList(const PlacedBodies& placed, const Candidate& candidate, Turning turning,
                         const VoxelMask* mask)
    : placed_(placed),
      candidate_(candidate),
      turning_(turning),
      may_meet_own_image_(turning != Turning::none &&
                          !clears_own_images(placed.cell(),
                                             Candidate(Sphere{candidate.outline.circum_radius}),
                                             placed.min_gap())),
      dimension_(static_cast<std::size_t>(placed.cell().dimension)),
      division_{{1, 1, 1}, {1.0, 1.0, 1.0}, OrientationCells(turning)} {
  const double r = candidate.outline.in_radius;
  const Vec3 extents = turning == Turning::none ? candidate.half_extents : Vec3{r, r, r};
  domain_ = centers_inside_walls(placed.cell(), extents);
  if (dimension_ == 2) domain_.lo.z = domain_.hi.z = 0.0;
  origin_ = {domain_.lo.x, domain_.lo.y, domain_.lo.z};
  end_ = {domain_.hi.x, domain_.hi.y, domain_.hi.z};
  for (std::size_t axis = 0; axis < 3; ++axis) length_[axis] = end_[axis] - origin_[axis];
  images_ = placed.images_near(domain_.lo, domain_.hi, candidate.outline.circum_radius);
  noticed_ = placed.size();
  cores_ = cores_of(division_.orientations);
  if (mask != nullptr && turning == Turning::none) {
    start_with(*mask);
  } else {
    start_with_all();
  }
}

void VacancyList::start_with_all() {
  for (std::int32_t o = 0; o < division_.orientations.count(); ++o) {
    cells_.push_back({{0, 0, 0}, o});
    for (std::size_t k = 0; k < images_.size(); ++k) {
      neighbors_.push_back(static_cast<std::int32_t>(k));
    }
    neighbor_ends_.push_back(static_cast<std::int64_t>(neighbors_.size()));
  }
  last_split_cost_ = static_cast<std::int64_t>(neighbors_.size()) * Cost::glance + Cost::trial;
}

void VacancyList::start_with(const VoxelMask& mask) {
  division_.counts = mask.counts();
  for (std::size_t axis = 0; axis < 3; ++axis)
    division_.per_count[axis] = 1.0 / division_.counts[axis];
  std::vector<std::int32_t> all(images_.size()), layer, row;
  std::iota(all.begin(), all.end(), 0);
  std::array<std::int32_t, 3> last{-1, -1, -1};
  Cells out;
  for (std::int64_t k = 0; k < mask.size(); ++k) {
    const PoseCell cell{mask.index(k), 0};
    const Box box = box_of(division_, cell);
    // Voxels come row by row, so that most images are left out once for many of them.
    const bool new_layer = cell.index[2] != last[2];
    if (new_layer) pick_near(all, 2, box, layer, out.cost);
    if (new_layer || cell.index[1] != last[1]) pick_near(layer, 1, box, row, out.cost);
    last = cell.index;
    keep_unless_empty(cell, cores_[0], box, row, {}, out);
  }
  take(std::move(out));
  last_split_cost_ =
      static_cast<std::int64_t>(neighbors_.size()) * Cost::glance + size() * Cost::trial;
  last_split_children_ = std::max<std::int64_t>(1, size());
}

// Those of `images` that may touch a body of any box at the height of `box` along the axis.
void VacancyList::pick_near(const std::vector<std::int32_t>& images, std::size_t axis,
                            const Box& box, std::vector<std::int32_t>& near,
                            std::int64_t& cost) const {
  near.clear();
  cost += static_cast<std::int64_t>(images.size()) / 4 * Cost::pair;
  for (const std::int32_t image : images) {
    const PlacedImage& at = images_[static_cast<std::size_t>(image)];
    const double reach = candidate_.outline.circum_radius + placed_.outline(at.body).circum_radius +
                         placed_.min_gap() + box.half[axis];
    if (std::abs(at.center[axis] - box.middle[axis]) <= reach) near.push_back(image);
  }
}

double VacancyList::part() const {
  double all = division_.orientations.count();
  for (std::size_t axis = 0; axis < dimension_; ++axis) all *= division_.counts[axis];
  return static_cast<double>(size()) / all;
}

bool VacancyList::can_split() const {
  const auto most = *std::max_element(division_.counts.begin(), division_.counts.end());
  return size() <= kMostCells && most < kMostCellsAlongAxis;
}

std::int64_t VacancyList::expected_split_cost() const {
  return size() * last_split_cost_ * 8 / std::max<std::int64_t>(1, last_split_children_);
}

double VacancyList::edge_at(const Division& division, std::size_t axis, std::int32_t index) const {
  // The same expression for both neighbors of a face, so that no point is lost between them.
  const double part = static_cast<double>(index) * division.per_count[axis];
  return origin_[axis] + length_[axis] * part;
}

VacancyList::Box VacancyList::box_of(const Division& division, const PoseCell& cell) const {
  Box box{{0, 0, 0}, {0, 0, 0}};
  for (std::size_t axis = 0; axis < dimension_; ++axis) {
    const double lo = edge_at(division, axis, cell.index[axis]);
    const double hi = edge_at(division, axis, cell.index[axis] + 1);
    box.middle[axis] = 0.5 * (lo + hi);
    box.half[axis] = 0.5 * (hi - lo) + kBoxMargin * placed_.cell().size[axis];
  }
  return box;
}

std::span<const std::int32_t> VacancyList::neighbors_of(std::int64_t cell) const {
  const auto k = static_cast<std::size_t>(cell);
  const auto begin = static_cast<std::size_t>(k == 0 ? 0 : neighbor_ends_[k - 1]);
  return {neighbors_.data() + begin, static_cast<std::size_t>(neighbor_ends_[k]) - begin};
}

std::vector<CommonCore> VacancyList::cores_of(const OrientationCells& orientations) const {
  std::vector<CommonCore> cores;
  if (orientations.count() > kMostTabulatedCores) return cores;
  cores.resize(static_cast<std::size_t>(orientations.count()));
  for (std::size_t k = 0; k < cores.size(); ++k) {
    cores[k] = make_core(orientations, static_cast<std::int32_t>(k));
  }
  return cores;
}

CommonCore VacancyList::make_core(const OrientationCells& orientations, std::int32_t cell) const {
  if (turning_ == Turning::none) return common_core(candidate_.body, 0.0);
  CommonCore core =
      common_core(orientations.turned(candidate_.body, cell, 0.5, 0.5), orientations.angle(cell));
  if (may_meet_own_image_ && core.part_count > 0) {
    core.meets_own_image =
        meets_own_image(placed_.cell(), Candidate(core.parts[0]), placed_.min_gap());
  }
  return core;
}

const CommonCore& VacancyList::core_of(const Division& division,
                                       const std::vector<CommonCore>& cores,
                                       std::int32_t orientation, CommonCore& storage) const {
  if (!cores.empty()) return cores[static_cast<std::size_t>(orientation)];
  storage = make_core(division.orientations, orientation);
  return storage;
}

bool VacancyList::splits_orientation() const {
  if (!division_.orientations.can_split()) return false;
  const Vec3 half = box_of(division_, {{0, 0, 0}, 0}).half;
  return lever(candidate_.outline) * division_.orientations.widest() > norm(half);
}

std::int64_t VacancyList::split(const RunContext& run) {
  Division finer = division_;
  if (splits_orientation()) {
    finer.orientations.split();
  } else {
    const Vec3 half = box_of(division_, {{0, 0, 0}, 0}).half;
    const double longest = std::max({half.x, half.y, half.z});
    for (std::size_t axis = 0; axis < dimension_; ++axis) {
      if (half[axis] <= 0.6 * longest) continue;
      finer.counts[axis] *= 2;
      finer.per_count[axis] *= 0.5;
    }
  }
  const bool turned = finer.orientations.count() != division_.orientations.count();
  std::vector<CommonCore> cores = turned ? cores_of(finer.orientations) : std::move(cores_);

  constexpr std::int64_t chunk = 64;
  const std::int64_t chunks = (size() + chunk - 1) / chunk;
  std::vector<Cells> parts(static_cast<std::size_t>(chunks));
  parallel_for(chunks, run.threads(), 4, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t c = begin; c < end; ++c) {
      if (run.stop_request() != StopRequest::none) return;
      Cells& out = parts[static_cast<std::size_t>(c)];
      const std::int64_t last = std::min(size(), (c + 1) * chunk);
      for (std::int64_t parent = c * chunk; parent < last; ++parent) {
        split_cell(parent, finer, cores, out);
      }
    }
  });
  if (run.stop_request() != StopRequest::none) {
    if (!turned) cores_ = std::move(cores);
    return 0;
  }

  const std::int64_t parents = size();
  last_split_cost_ = 0;
  cells_.clear();
  neighbors_.clear();
  neighbor_ends_.clear();
  for (const Cells& part : parts) {
    const auto shift = static_cast<std::int64_t>(neighbors_.size());
    cells_.insert(cells_.end(), part.cells.begin(), part.cells.end());
    neighbors_.insert(neighbors_.end(), part.neighbors.begin(), part.neighbors.end());
    for (const std::int64_t end : part.neighbor_ends) neighbor_ends_.push_back(shift + end);
    last_split_cost_ += part.cost;
  }
  std::int64_t pieces = turned ? finer.orientations.branching() : 1;
  for (std::size_t axis = 0; axis < 3 && !turned; ++axis) {
    pieces *= finer.counts[axis] / division_.counts[axis];
  }
  last_split_children_ = pieces * parents;
  kept_by_last_split_ = static_cast<double>(size()) / static_cast<double>(last_split_children_);
  division_ = finer;
  cores_ = std::move(cores);
  return last_split_cost_;
}

void VacancyList::split_cell(std::int64_t parent, const Division& finer,
                             const std::vector<CommonCore>& cores, Cells& out) const {
  const PoseCell& from = cells_[static_cast<std::size_t>(parent)];
  const std::span<const std::int32_t> images = neighbors_of(parent);
  const bool turned = finer.orientations.count() != division_.orientations.count();
  const int turns = turned ? finer.orientations.branching() : 1;
  const std::int32_t first_turn =
      turned ? finer.orientations.first_child(from.orientation) : from.orientation;
  std::array<std::int32_t, 3> pieces{1, 1, 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    pieces[axis] = finer.counts[axis] / division_.counts[axis];
  }
  CommonCore storage;
  for (int turn = 0; turn < turns; ++turn) {
    const CommonCore& core = core_of(finer, cores, first_turn + turn, storage);
    for (std::int32_t z = 0; z < pieces[2]; ++z) {
      for (std::int32_t y = 0; y < pieces[1]; ++y) {
        for (std::int32_t x = 0; x < pieces[0]; ++x) {
          const PoseCell child{{from.index[0] * pieces[0] + x, from.index[1] * pieces[1] + y,
                                from.index[2] * pieces[2] + z},
                               first_turn + turn};
          out.cost += Cost::trial;
          keep_unless_empty(child, core, box_of(finer, child), images, {}, out);
        }
      }
    }
  }
}

// Adds the cell, with those of `images` that can touch a member and all of `known`, to `out`.
void VacancyList::keep_unless_empty(const PoseCell& cell, const CommonCore& core, const Box& box,
                                    std::span<const std::int32_t> images,
                                    std::span<const std::int32_t> known, Cells& out) const {
  const std::size_t kept = out.neighbors.size();
  if (is_empty(core, box, images, out.neighbors, out.cost)) {
    out.neighbors.resize(kept);
    return;
  }
  out.neighbors.insert(out.neighbors.end(), known.begin(), known.end());
  out.cells.push_back(cell);
  out.neighbor_ends.push_back(static_cast<std::int64_t>(out.neighbors.size()));
}

void VacancyList::take(Cells&& cells) {
  cells_ = std::move(cells.cells);
  neighbors_ = std::move(cells.neighbors);
  neighbor_ends_ = std::move(cells.neighbor_ends);
}

bool VacancyList::is_empty(const CommonCore& core, const Box& box,
                           std::span<const std::int32_t> images, std::vector<std::int32_t>& kept,
                           std::int64_t& cost) const {
  if (core.meets_own_image || walls_forbid(core, box)) return true;
  const double min_gap = placed_.min_gap();
  const double blur = norm(box.half);
  BoxCuts cuts(box.half);
  std::size_t front = kept.size();
  for (const std::int32_t image : images) {
    const PlacedImage& at = images_[static_cast<std::size_t>(image)];
    const Outline& other = placed_.outline(at.body);
    const Vec3 r = at.center - box.middle;
    const double far = core.middle_outline.circum_radius + other.circum_radius + min_gap + blur;
    cost += Cost::pair;
    if (norm_sq(r) > far * far) continue;
    if (is_ball(core.middle_outline) && other.ends != Outline::Ends::loose) {
      const bool flat = other.ends == Outline::Ends::flat;
      const double range = core.middle_outline.radius + min_gap + (flat ? 0.0 : other.radius);
      const BoxCuts::Meeting meeting = cuts.look_at(other, -r, range);
      if (other.half_length > 0.0) cost += Cost::glance;
      if (meeting == BoxCuts::Meeting::covers) return true;
      if (meeting == BoxCuts::Meeting::nowhere) continue;
      kept.push_back(image);
      if (meeting == BoxCuts::Meeting::middle) std::swap(kept[front++], kept.back());
      continue;
    }
    const Verdict seen = quick_verdict(core.middle_outline, other, r, min_gap);
    cost += Cost::glance;
    if (seen == Verdict::separated) {
      // Does any member of the cell come near this image? g(n) changes by no more than the box and
      // the swing of the capsule reach along n.
      const Glance apart = glance(core.middle_outline, other, r, min_gap);
      const double reach = box_reach(box.half, apart.normal) + core.swing;
      cost += Cost::glance;
      if (apart.gap_bound - reach <= min_gap) kept.push_back(image);
      continue;
    }
    kept.push_back(image);
    if (covers(image, core, box, cost)) return true;
    // What overlaps the middle goes first: it is the likeliest to cover a child or stop a trial.
    if (seen == Verdict::overlapping) std::swap(kept[front++], kept.back());
  }
  if (!cuts.leave_middle()) cost += 4 * Cost::glance;
  return cuts.leave_nothing();
}

bool VacancyList::walls_forbid(const CommonCore& core, const Box& box) const {
  if (turning_ == Turning::none) return false;
  for (std::size_t axis = 0; axis < dimension_; ++axis) {
    if (placed_.cell().periodic[axis]) continue;
    Vec3 n{0, 0, 0};
    n[axis] = 1.0;
    double reach = 0.0;
    for (int k = 0; k < core.part_count; ++k) {
      reach = std::max(reach, support(core.parts[static_cast<std::size_t>(k)], n));
    }
    reach *= 1.0 - 1e-12;
    const double size = placed_.cell().size[axis];
    if (box.middle[axis] + box.half[axis] < reach) return true;
    if (box.middle[axis] - box.half[axis] > size - reach) return true;
  }
  return false;
}

bool VacancyList::covers(std::int32_t image, const CommonCore& core, const Box& box,
                         std::int64_t& cost) const {
  const PlacedImage& at = images_[static_cast<std::size_t>(image)];
  const Outline& other = placed_.outline(at.body);
  const double min_gap = placed_.min_gap();
  const double reach = core.middle_outline.circum_radius + other.circum_radius + min_gap;
  if (norm_sq(box.half) > reach * reach) return false;

  // A glance at all corners first: one that is free ends the test. The corner farthest from the
  // image is the likeliest, so it comes first.
  const Vec3 r = at.center - box.middle;
  const unsigned count = 1u << dimension_;
  const unsigned farthest = (r.x < 0 ? 1u : 0u) | (r.y < 0 ? 2u : 0u) | (r.z < 0 ? 4u : 0u);
  std::array<Vec3, 8> doubtful;
  std::size_t doubtful_count = 0;
  for (unsigned k = 0; k < count; ++k) {
    const unsigned corner = k ^ farthest;
    const Vec3 offset{(corner & 1u) != 0 ? box.half.x : -box.half.x,
                      (corner & 2u) != 0 ? box.half.y : -box.half.y,
                      (corner & 4u) != 0 ? box.half.z : -box.half.z};
    const Verdict seen = quick_verdict(core.middle_outline, other, r - offset, min_gap);
    cost += Cost::glance;
    if (seen == Verdict::separated) return false;
    if (seen == Verdict::undecided || core.angle > 0.0) doubtful[doubtful_count++] = r - offset;
  }
  for (std::size_t k = 0; k < doubtful_count; ++k) {
    if (!always_overlaps(at.body, core, doubtful[k], cost)) return false;
  }
  return true;
}

bool VacancyList::always_overlaps(std::int32_t body, const CommonCore& core, const Vec3& r,
                                  std::int64_t& cost) const {
  const Outline& other = placed_.outline(body);
  const double min_gap = placed_.min_gap();
  if (core.angle > 0.0 && thin_core_meets(core, other, r)) return true;
  for (int k = 0; k < core.part_count; ++k) {
    const auto part = static_cast<std::size_t>(k);
    const Verdict seen = core.angle > 0.0 ? quick_verdict(core.outlines[part], other, r, min_gap)
                                          : Verdict::undecided;
    cost += Cost::glance;
    if (seen == Verdict::overlapping) return true;
    if (seen == Verdict::separated) continue;
    cost += Cost::kernel;
    if (overlap(core.parts[part], placed_.body(body), r, min_gap) == Verdict::overlapping) {
      return true;
    }
  }
  return false;
}

// Balls about points of the axis, so small that they stay inside when the axis turns.
bool VacancyList::thin_core_meets(const CommonCore& core, const Outline& other,
                                  const Vec3& r) const {
  const Outline& middle = core.middle_outline;
  if (middle.ends == Outline::Ends::loose) return false;
  const double bend = core.swing / middle.half_length;
  const double foot = nearest_on_segment(middle, other, r);
  for (const double part : {1.0, 0.75}) {
    const double t = part * foot;
    double ball = middle.radius;
    if (middle.ends == Outline::Ends::flat) {
      ball = std::min(ball, middle.half_length - std::abs(t));
    }
    ball -= std::abs(t) * bend;
    if (meets_ball(other, t * middle.axis - r, ball, placed_.min_gap())) return true;
  }
  return false;
}

std::int64_t VacancyList::add_last_placed() {
  const auto first_new = images_.size();
  std::vector<std::int32_t> fresh;
  for (; noticed_ < placed_.size(); ++noticed_) {
    placed_.add_images_near(noticed_, domain_.lo, domain_.hi, candidate_.outline.circum_radius,
                            images_);
  }
  for (std::size_t k = first_new; k < images_.size(); ++k) {
    fresh.push_back(static_cast<std::int32_t>(k));
  }
  Cells out;
  out.cells.reserve(cells_.size());
  out.neighbors.reserve(neighbors_.size() + cells_.size());
  out.neighbor_ends.reserve(cells_.size());
  CommonCore storage;
  for (std::int64_t k = 0; k < size(); ++k) {
    const PoseCell& cell = cells_[static_cast<std::size_t>(k)];
    const CommonCore& core = core_of(division_, cores_, cell.orientation, storage);
    keep_unless_empty(cell, core, box_of(division_, cell), fresh, neighbors_of(k), out);
  }
  const std::int64_t cost = out.cost;
  take(std::move(out));
  return cost;
}

// Four words do for all that a pose needs, but for Turning::full: the first says which cell; of
// each other one the upper 42 bits say where in the box, and what the lower 22 bits of them add up
// to, where in the cell of orientations.
VacancyList::Pose VacancyList::draw(TrialNumbers::Row numbers) const {
  constexpr int low_bits = 22;
  Pose pose;
  pose.cell = static_cast<std::int32_t>(numbers.below(static_cast<std::uint64_t>(size())));
  const PoseCell& cell = cells_[static_cast<std::size_t>(pose.cell)];
  std::array<std::uint64_t, 3> low{};
  std::array<double, 3> center{};
  for (std::size_t axis = 0; axis < dimension_; ++axis) {
    const std::uint64_t word = numbers.bits();
    low[axis] = word & ((1u << low_bits) - 1);
    // In the box but for rounding, which its margin covers.
    const double part = static_cast<double>(word >> low_bits) * 0x1p-42;
    const double at = (cell.index[axis] + part) * division_.per_count[axis];
    center[axis] = std::min(origin_[axis] + length_[axis] * at, end_[axis]);
  }
  pose.center = {center[0], center[1], center[2]};
  pose.u = static_cast<double>(low[0] << 11 | low[2] >> 11) * 0x1p-33;
  pose.v = static_cast<double>(low[1] << 11 | (low[2] & 0x7ff)) * 0x1p-33;
  if (turning_ == Turning::in_plane) pose.u = static_cast<double>(low[0] << 22 | low[1]) * 0x1p-44;
  if (turning_ == Turning::full) {
    RandomStream random(numbers.bits(), StreamId::rsa_voxel);
    pose.rotation = random_rotation(random);
  }
  return pose;
}

Candidate VacancyList::turned(const Pose& pose) const {
  if (turning_ == Turning::none) return candidate_;
  if (turning_ == Turning::full) {
    Body body = candidate_.body;
    std::get<Ellipsoid>(body).orientation = pose.rotation;
    return Candidate(body, placed_.needs_extents());
  }
  const std::int32_t orientation = cells_[static_cast<std::size_t>(pose.cell)].orientation;
  return Candidate(division_.orientations.turned(candidate_.body, orientation, pose.u, pose.v),
                   placed_.needs_extents());
}

bool VacancyList::fits(const Pose& pose, std::int64_t& cost) const {
  cost += Cost::trial;
  if (turning_ == Turning::none) return stands_apart(candidate_, pose, cost);
  if (!ball_fits(pose, cost)) return false;
  cost += Cost::trial;
  const Candidate candidate = turned(pose);
  const Cell& cell = placed_.cell();
  return stands_apart(candidate, pose, cost) &&
         is_inside(centers_inside_walls(cell, candidate.half_extents), pose.center,
                   cell.dimension) &&
         (!may_meet_own_image_ || clears_own_images(cell, candidate, placed_.min_gap()));
}

// What every turn of the body holds, its inscribed ball, settles many poses.
bool VacancyList::ball_fits(const Pose& pose, std::int64_t& cost) const {
  const double ball = candidate_.outline.in_radius, min_gap = placed_.min_gap();
  const std::span<const std::int32_t> images = neighbors_of(pose.cell);
  cost += static_cast<std::int64_t>(images.size()) / 2 * Cost::pair;
  for (const std::int32_t image : images) {
    const PlacedImage& at = images_[static_cast<std::size_t>(image)];
    const Outline& other = placed_.outline(at.body);
    const Vec3 r = pose.center - at.center;
    const double far = other.circum_radius + ball + min_gap;
    if (norm_sq(r) < far * far && meets_ball(other, r, ball, min_gap)) return false;
  }
  return true;
}

bool VacancyList::stands_apart(const Candidate& candidate, const Pose& pose,
                               std::int64_t& cost) const {
  const double min_gap = placed_.min_gap();
  std::array<std::int32_t, 32> waiting;
  std::size_t waiting_count = 0;
  const auto apart = [&](std::int32_t image) {
    const PlacedImage& at = images_[static_cast<std::size_t>(image)];
    cost += Cost::kernel;
    return overlap(candidate.body, placed_.body(at.body), at.center - pose.center, min_gap) ==
           Verdict::separated;
  };
  for (const std::int32_t image : neighbors_of(pose.cell)) {
    const PlacedImage& at = images_[static_cast<std::size_t>(image)];
    cost += Cost::glance;
    const Verdict seen = quick_verdict(candidate.outline, placed_.outline(at.body),
                                       at.center - pose.center, min_gap);
    if (seen == Verdict::overlapping) return false;
    if (seen == Verdict::separated) continue;
    if (waiting_count < waiting.size()) {
      waiting[waiting_count++] = image;
    } else if (!apart(image)) {
      return false;
    }
  }
  for (std::size_t k = 0; k < waiting_count; ++k) {
    if (!apart(waiting[k])) return false;
  }
  return true;
}

}  // namespace packstone::rsa
