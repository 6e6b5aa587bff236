#include "generate/published_advancing_layer/layer.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/core/error.hpp"
#include "packstone/core/tolerances.hpp"

namespace packstone::published_layer {
namespace {

// What contacts keep, over the longest edge [-]: more than the rounding of coordinates of the cell
// and of a test of two bodies that are as large as it.
constexpr double kContactGap = 256 * kUnitRoundoff;

// Arcs beyond have no such triangle, or one that reaches far.
constexpr double kLeastCosine = 0.4;

Triangle triangle_of(const ContactArc& arc) {
  const double sin = std::sqrt(std::max(0.0, 1.0 - arc.cos_half * arc.cos_half));
  const Vec2 across{-arc.middle.y, arc.middle.x};
  const Vec2 along = arc.reach * arc.cos_half * arc.middle;
  const Vec2 aside = arc.reach * sin * across;
  return {{arc.center + along + aside, arc.center + along - aside,
           arc.center + (arc.reach / arc.cos_half) * arc.middle}};
}

// May the arc come into the box about `center`?
bool may_enter(const ContactArc& arc, const Vec2& center, const Vec2& half) {
  if (arc.cos_half < kLeastCosine) return true;
  const auto [p, q, r] = triangle_of(arc).corners;
  const Vec2 lo{std::min({p.x, q.x, r.x}), std::min({p.y, q.y, r.y})};
  const Vec2 hi{std::max({p.x, q.x, r.x}), std::max({p.y, q.y, r.y})};
  return lo.x < center.x + half.x && hi.x > center.x - half.x && lo.y < center.y + half.y &&
         hi.y > center.y - half.y;
}

bool lies_on(const ContactArc& arc, const Vec2& center, const Vec2& p) {
  return dot(p - center, arc.middle) >= arc.reach * arc.cos_half;
}

// Equations (2): where the circles of both arcs cross, if on both of them.
void add_crossings(const ContactArc& a, const ContactArc& b, const Vec2& shift,
                   std::vector<Vec2>& crossings) {
  const Vec2 center_b = b.center + shift;
  const Vec2 d = center_b - a.center;
  const double distance_sq = norm_sq(d);
  const double sum = a.reach + b.reach;
  if (distance_sq >= sum * sum || distance_sq == 0.0) return;
  const double along = 0.5 * (1.0 + (a.reach - b.reach) * sum / distance_sq);
  const double aside_sq = a.reach * a.reach / distance_sq - along * along;
  if (aside_sq < 0.0) return;
  const double aside = std::sqrt(aside_sq);
  for (const double side : {-aside, aside}) {
    const Vec2 p = a.center + along * d + side * Vec2{-d.y, d.x};
    if (lies_on(a, a.center, p) && lies_on(b, center_b, p)) crossings.push_back(p);
  }
}

}  // namespace

Layer::Layer(const Cell& cell, const PublishedLayerOptions& options)
    : cell_(cell),
      options_(options),
      contact_gap_(kContactGap * std::max(cell.size.x, cell.size.y)),
      grid_(cell),
      curves_(contact_gap_),
      disk_curves_(contact_gap_) {}

std::optional<Vec2> Layer::place(const MultiCircle& shape, double largest) {
  std::optional<Vec2> center;
  if (row_is_open_) center = place_in_row(shape);
  row_is_open_ = row_is_open_ && center;
  if (!center) center = place_by_pairs(shape, largest);
  if (!center) return std::nullopt;
  const Vec3 inside = wrapped(cell_, lift(*center));
  add(shape, flatten(inside));
  return flatten(inside);
}

void Layer::add(const MultiCircle& shape, const Vec2& center) {
  const auto id = static_cast<std::int32_t>(bodies_.size());
  bodies_.push_back({shape, center});
  grid_.insert(id, lift(center), lift(shape.half()));
  const Listed listed{center.y + shape.half().y, id};
  const auto after =
      std::upper_bound(heights_.begin(), heights_.end(), listed.height,
                       [](double height, const Listed& other) { return height < other.height; });
  heights_.insert(after, listed);
}

// As far to the left as the row allows. On a periodic axis it must leave the first body alone.
std::optional<Vec2> Layer::place_in_row(const MultiCircle& shape) {
  const double y = shape.half().y;
  const Vec2 center{row_abscissa(shape, y), y};
  ++tried_.positions;
  if (center.x + shape.half().x > cell_.size.x) return std::nullopt;
  const Placed there{shape, center};
  if (!is_free(shape, center, candidates(there, {}))) return std::nullopt;
  ++first_row_;
  return center;
}

double Layer::row_abscissa(const MultiCircle& shape, double y) const {
  double x = shape.half().x;
  for (const Placed& body : bodies_) {
    if (body.center.x + body.shape.half().x + shape.half().x < x) continue;
    for (const Circle& p : body.shape.circles()) {
      for (const Circle& q : shape.circles()) {
        const double reach = p.radius + q.radius + contact_gap_;
        const double rise = y + q.offset.y - body.center.y - p.offset.y;
        const double run_sq = reach * reach - rise * rise;
        if (run_sq <= 0.0) continue;
        x = std::max(x, body.center.x + p.offset.x + std::sqrt(run_sq) - q.offset.x);
      }
    }
  }
  return x;
}

std::optional<Vec2> Layer::place_by_pairs(const MultiCircle& shape, double largest) {
  PACKSTONE_ASSERT(!heights_.empty());  // The first body fits into the row.
  curves_.begin(shape);
  const MultiCircle disk(shape.smallest_radius());
  disk_curves_.begin(disk);
  const double least = heights_.back().height - options_.top_layer * largest;
  auto first =
      std::upper_bound(heights_.begin(), heights_.end(), least,
                       [](double height, const Listed& other) { return height < other.height; });
  for (; first != heights_.end(); ++first) {
    if (shape.smallest_radius() >= bodies_[first->id].no_room_from) continue;
    if (const auto center = place_on(first->id, curves_, tried_)) return center;
    remember_no_room(first->id, shape);
  }
  return std::nullopt;
}

// Where a body touches another one with a circle of radius r, a disk of that radius fits there too,
// and slid along the outline it meets a second body, unless there are walls. So a body that such a
// disk finds no room at accepts no more body of circles so large, as what stands never moves.
void Layer::remember_no_room(std::int32_t first, const MultiCircle& shape) {
  Placed& body = bodies_[first];
  const Vec2 domain = body.shape.half() + 2.0 * shape.half();
  for (std::size_t a = 0; a < 2; ++a) {
    const double x = a == 0 ? body.center.x : body.center.y;
    const double reach = a == 0 ? domain.x : domain.y;
    if (!cell_.periodic[a] && (x - reach < 0.0 || x + reach > cell_.size[a])) return;
  }
  const bool is_disk = shape.circles().size() == 1;
  Tried uncounted;
  if (is_disk || !place_on(first, disk_curves_, uncounted)) {
    body.no_room_from = shape.smallest_radius();
  }
}

std::optional<Vec2> Layer::place_on(std::int32_t first, ContactCurves& curves, Tried& tried) const {
  const MultiCircle& shape = curves.moving();
  const std::vector<Near> near = candidates(bodies_[first], shape.half());
  const std::vector<ContactArc> arcs = open_arcs(first, near, curves);
  if (arcs.empty()) return std::nullopt;
  for (const Near& second : near) {
    if (second.id == first && second.center == bodies_[first].center) continue;
    ++tried.pairs;
    if (const auto center = first_free(solutions_with(second, arcs, curves), shape, near, tried)) {
      return center;
    }
  }
  return std::nullopt;
}

// The candidate domain, from the lowest body up.
std::vector<Layer::Near> Layer::candidates(const Placed& first, const Vec2& half) const {
  std::vector<Near> near;
  const Vec2 domain = first.shape.half() + 2.0 * half;
  grid_.query(lift(first.center), lift(domain), contact_gap_,
              [&](std::int32_t id, const auto& image) {
                const Placed& body = bodies_[id];
                const Vec2 center = body.center + flatten(image_shift(cell_, image));
                near.push_back({center.y + body.shape.half().y, id, center});
                return true;
              });
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) {
    if (a.height != b.height) return a.height < b.height;
    return a.id != b.id ? a.id < b.id : a.center.x < b.center.x;
  });
  return near;
}

// The parts of the curve of contact that no single circle of another body covers: on the others
// every solution overlaps.
std::vector<ContactArc> Layer::open_arcs(std::int32_t first, const std::vector<Near>& near,
                                         ContactCurves& curves) const {
  std::vector<ContactArc> open;
  std::vector<CirclePair> pairs;
  pairs.reserve(near.size());
  for (const Near& other : near) {
    pairs.push_back(
        {bodies_[other.id].shape.circles().size() / 2, curves.moving().circles().size() / 2});
  }
  std::size_t last = 0;  // That covered the arc before, and likely covers the next one.
  for (ContactArc arc : curves.about(first, bodies_[first].shape)) {
    arc.center = arc.center + bodies_[first].center;
    bool covered = false;
    if (arc.cos_half >= kLeastCosine) {
      const Triangle triangle = triangle_of(arc);
      for (std::size_t k = 0; k < near.size() && !covered; ++k) {
        const std::size_t n = (last + k) % near.size();
        covered = covers(near[n], curves.moving(), triangle, pairs[n]);
        if (covered) last = n;
      }
    }
    if (!covered) open.push_back(arc);
  }
  return open;
}

// Does one circle of the body keep the moving one from all of the triangle? Looks on from `pair`.
bool Layer::covers(const Near& other, const MultiCircle& moving, const Triangle& triangle,
                   CirclePair& pair) const {
  const MultiCircle& fixed = bodies_[other.id].shape;
  const Vec2 p = triangle.corners[0] - other.center;
  const Vec2 reach = fixed.half() + moving.half();
  if (std::abs(p.x) >= reach.x || std::abs(p.y) >= reach.y) return false;
  pair = deepest_pair(fixed, moving, triangle.middle() - other.center, pair);
  const Circle& a = fixed.circles()[pair.fixed];
  const Circle& b = moving.circles()[pair.moving];
  const double radius = a.radius + b.radius;
  return std::all_of(triangle.corners.begin(), triangle.corners.end(), [&](const Vec2& corner) {
    return norm_sq(corner - other.center + b.offset - a.offset) < radius * radius;
  });
}

std::vector<Vec2> Layer::solutions_with(const Near& second, const std::vector<ContactArc>& arcs,
                                        ContactCurves& curves) const {
  std::vector<Vec2> solutions;
  const MultiCircle& shape = bodies_[second.id].shape;
  const Vec2 reach = shape.half() + curves.moving().half() + Vec2{contact_gap_, contact_gap_};
  const auto& others = curves.about(second.id, shape);
  for (const ContactArc& arc : arcs) {
    if (!may_enter(arc, second.center, reach)) continue;
    for (const ContactArc& other : others) add_crossings(arc, other, second.center, solutions);
  }
  return solutions;
}

// "Beneath" before "above".
std::optional<Vec2> Layer::first_free(std::vector<Vec2> solutions, const MultiCircle& shape,
                                      const std::vector<Near>& near, Tried& tried) const {
  std::sort(solutions.begin(), solutions.end(),
            [](const Vec2& a, const Vec2& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  for (const Vec2& center : solutions) {
    if (!is_inside(center, shape.half())) continue;
    ++tried.positions;
    if (is_free(shape, center, near)) return center;
  }
  return std::nullopt;
}

bool Layer::is_inside(const Vec2& center, const Vec2& half) const {
  if (center.y < half.y || center.y + half.y > cell_.size.y) return false;
  return cell_.periodic[0] || (center.x >= half.x && center.x + half.x <= cell_.size.x);
}

// Rectangles first, then circle by circle.
bool Layer::is_free(const MultiCircle& shape, const Vec2& center,
                    const std::vector<Near>& near) const {
  return std::none_of(near.begin(), near.end(), [&](const Near& other) {
    const MultiCircle& body = bodies_[other.id].shape;
    const Vec2 r = center - other.center;
    const Vec2 sum = body.half() + shape.half();
    if (std::abs(r.x) >= sum.x + contact_gap_ || std::abs(r.y) >= sum.y + contact_gap_) {
      return false;
    }
    return circles_overlap(body, shape, r, contact_gap_);
  });
}

}  // namespace packstone::published_layer
