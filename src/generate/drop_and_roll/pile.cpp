#include "generate/drop_and_roll/pile.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/core/tolerances.hpp"
#include "packstone/generate/constructive.hpp"

namespace packstone::rolling {
namespace {

Vec3 unit_along(std::size_t axis) {
  Vec3 unit;
  unit[axis] = 1.0;
  return unit;
}

double longest_edge(const Cell& cell) { return std::max({cell.size.x, cell.size.y, cell.size.z}); }

}  // namespace

// A part of an arc, in a box.
struct Pile::Stretch {
  double last_cos;
  Angle end;
  Vec3 center;
  Vec3 half;
};

// Where the way ends, and by what.
struct Pile::Hit {
  Angle angle;
  bool blocked = false;
  bool floor = false;
  Contact contact;

  // Is there no way at all?
  [[nodiscard]] bool is_at(const Angle& now) const { return blocked && angle.cos == now.cos; }
  void become(const Angle& at, const Contact& by) {
    angle = at;
    blocked = true;
    contact = by;
  }
};

Pile::Pile(const Cell& cell, double min_gap)
    : cell_(cell),
      up_axis_(vertical_axis(cell)),
      up_(unit_along(up_axis_)),
      min_gap_(min_gap),
      margin_(64 * kUnitRoundoff * longest_edge(cell)),
      search_(min_gap + 1e-9 * (min_gap + longest_edge(cell))),
      grid_(cell),
      skyline_(cell) {}

void Pile::add(const Vec3& center, double radius) {
  const Vec3 half{radius, radius, cell_.dimension == 2 ? 0.0 : radius};
  grid_.insert(static_cast<std::int32_t>(balls_.size()), center, half);
  balls_.push_back({center, radius});
  skyline_.add(center, radius);
}

std::optional<Vec3> Pile::drop(const Vec3& column, double radius) const {
  Traveler ball{radius, centers(radius), column, {}};
  ball.p[up_axis_] = skyline_.height(column, radius + search_) + radius + 2.0 * search_;
  Step step = fall(ball);
  for (int k = 0; step == Step::moved; ++k) {
    if (k == kMostSteps) return std::nullopt;
    if (settle(ball.contacts, up_)) break;
    step = ball.contacts.size() == 0 ? fall(ball) : roll(ball);
  }
  if (ball.p[up_axis_] > ball.box.hi[up_axis_]) return std::nullopt;
  return wrapped(cell_, ball.p);
}

// At which a ball that falls through p comes to touch.
double Pile::height_on(const Contact& contact, const Vec3& p) const {
  const Vec3 d = p - contact.center;
  const double across_sq = norm_sq(d) - d[up_axis_] * d[up_axis_];
  return contact.center[up_axis_] + std::sqrt(contact.reach * contact.reach - across_sq);
}

// Looks down in steps that grow: what is below the first contact does not matter.
Pile::Step Pile::fall(Traveler& ball) const {
  double& height = ball.p[up_axis_];
  const double floor = ball.box.lo[up_axis_];
  for (double depth = 2.0 * ball.radius;; depth *= 2.0) {
    if (const auto contact = first_below(ball, depth)) {
      ball.contacts.clear();
      ball.contacts.add(*contact);
      height = std::min(height, height_on(*contact, ball.p));
      ball.contacts[0].normal = normalized(ball.p - contact->center);
      return Step::moved;
    }
    height -= depth;
    if (height <= floor) {
      height = floor;
      return Step::rests;
    }
  }
}

std::optional<Contact> Pile::first_below(const Traveler& ball, double depth) const {
  const double height = ball.p[up_axis_];
  Vec3 center = ball.p;
  Vec3 half{ball.radius, ball.radius, cell_.dimension == 2 ? 0.0 : ball.radius};
  center[up_axis_] = height - 0.5 * (depth + ball.radius);
  half[up_axis_] = 0.5 * (depth + ball.radius);
  double highest = std::max(height - depth, ball.box.lo[up_axis_]);
  std::optional<Contact> first;
  grid_.query(center, half, search_, [&](std::int32_t id, const auto& image) {
    const Ball& other = balls_[id];
    const Vec3 at = other.center + image_shift(cell_, image);
    const double rho = reach(ball.radius, other);
    const Vec3 d = ball.p - at;
    const double below = d[up_axis_];
    const double across_sq = norm_sq(d) - below * below;
    const double near = rho - touch(rho);
    if (below <= 0.0 || across_sq >= near * near) return true;
    const Contact contact{id, at, rho, {}};
    const double contact_height = height_on(contact, ball.p);
    if (contact_height < highest) return true;
    highest = contact_height;
    first = contact;
    return true;
  });
  return first;
}

Pile::Step Pile::roll(Traveler& ball) const {
  auto arc = arc_on(ball.contacts, ball.p, up_);
  if (!arc) return Step::rests;
  Hit hit = first_hit(ball, *arc);
  // As upon two balls that stand at a wall: the way into the wall is as good as the one out of it.
  if (hit.is_at(arc->now) && arc->begins_at_top()) {
    arc = arc->mirrored();
    hit = first_hit(ball, *arc);
    if (hit.is_at(arc->now)) return Step::rests;
  }
  ball.p = arc->at(hit.angle);
  for (std::size_t a = 0; a < up_axis_; ++a) {
    if (!cell_.periodic[a]) ball.p[a] = std::clamp(ball.p[a], ball.box.lo[a], ball.box.hi[a]);
  }
  if (hit.floor) {
    ball.p[up_axis_] = ball.box.lo[up_axis_];
    return Step::rests;
  }
  if (hit.blocked) {
    ball.contacts.add(hit.contact);
  } else {
    ball.contacts.remove(arc->leaves);
  }
  for (std::size_t k = 0; k < ball.contacts.size(); ++k) {
    Contact& contact = ball.contacts[k];
    if (contact.body != Contact::kWall) contact.normal = normalized(ball.p - contact.center);
  }
  return Step::moved;
}

// The balls come last and piece by piece, so that a long arc that is soon blocked costs little.
Pile::Hit Pile::first_hit(const Traveler& ball, const Arc& arc) const {
  Hit hit;
  const double last_cos = std::min(arc.last_cos, arc.now.cos);
  hit.angle = {last_cos, std::sqrt(std::max(0.0, 1.0 - last_cos * last_cos))};
  meet_walls(ball, arc, hit);
  Angle from = arc.now;
  for (double length = ball.radius;; length *= 2.0) {
    const Stretch stretch = stretch_from(arc, from, length);
    meet_balls(ball, arc, stretch, hit);
    if (hit.angle.cos >= stretch.last_cos) return hit;
    from = stretch.end;
  }
}

void Pile::meet_walls(const Traveler& ball, const Arc& arc, Hit& hit) const {
  const auto meet = [&](std::size_t axis, const Vec3& point, double sign) {
    const Vec3 inward = sign * unit_along(axis);
    if (ball.contacts.holds_wall(inward)) return;
    const auto at =
        entry(blocked_by_plane(arc, point, inward, 0.25 * margin_), arc.now, hit.angle.cos);
    if (!at) return;
    hit.become(*at, {Contact::kWall, point, 0.0, inward});
    hit.floor = axis == up_axis_;
  };
  for (std::size_t a = 0; a < up_axis_; ++a) {
    if (cell_.periodic[a]) continue;
    meet(a, ball.box.lo, 1.0);
    meet(a, ball.box.hi, -1.0);
  }
  meet(up_axis_, ball.box.lo, 1.0);
}

void Pile::meet_balls(const Traveler& ball, const Arc& arc, const Stretch& stretch,
                      Hit& hit) const {
  const Vec3 half{ball.radius, ball.radius, cell_.dimension == 2 ? 0.0 : ball.radius};
  grid_.query(
      stretch.center, stretch.half + half, search_, [&](std::int32_t id, const auto& image) {
        const Ball& other = balls_[id];
        const Vec3 at = other.center + image_shift(cell_, image);
        if (ball.contacts.holds(id, at)) return true;
        const double rho = reach(ball.radius, other);
        const auto angle = entry(blocked_by_ball(arc, at, rho, touch(rho)), arc.now, hit.angle.cos);
        if (!angle) return true;
        hit.become(*angle, {id, at, rho, {}});
        hit.floor = false;
        return true;
      });
}

// From an angle over a chord of `length`; the rest of the half circle where that is a right angle
// or more.
Pile::Stretch Pile::stretch_from(const Arc& arc, const Angle& from, double length) const {
  const double half_sin = 0.5 * length / arc.radius;
  if (half_sin * half_sin >= 0.5) {
    const double r = arc.radius;
    return {-2.0, from, arc.middle, {r, r, cell_.dimension == 2 ? 0.0 : r}};
  }
  const double half_cos = std::sqrt(1.0 - half_sin * half_sin);
  const double c = 1.0 - 2.0 * half_sin * half_sin;
  const double s = 2.0 * half_sin * half_cos;
  const Angle end{from.cos * c - from.sin * s, from.sin * c + from.cos * s};
  const double bulge = arc.radius * (1.0 - half_cos);
  const Vec3 p = arc.at(from);
  const Vec3 q = arc.at(end);
  Vec3 half = 0.5 * (q - p);
  for (std::size_t a = 0; a <= up_axis_; ++a) half[a] = std::abs(half[a]) + bulge;
  return {end.sin < 0.0 ? -2.0 : end.cos, end, 0.5 * (p + q), half};
}

}  // namespace packstone::rolling
