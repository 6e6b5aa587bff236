#include "generate/drop_and_roll/rolling.hpp"

#include <algorithm>
#include <cmath>

namespace packstone::rolling {
namespace {

// The normals of contacts, and their components along `up`.
struct Normals {
  std::size_t count = 0;
  std::array<Vec3, Contacts::kMost> n{};
  std::array<double, Contacts::kMost> up{};
};

Normals normals_of(const Contacts& contacts, const Vec3& up) {
  Normals normals;
  normals.count = contacts.size();
  for (std::size_t k = 0; k < normals.count; ++k) {
    normals.n[k] = contacts[k].normal;
    normals.up[k] = dot(up, contacts[k].normal);
  }
  return normals;
}

// Does v, which contacts i and j do not hinder, press on no other?
bool leads_away(const Normals& normals, const Vec3& v, std::size_t i, std::size_t j) {
  for (std::size_t k = 0; k < normals.count; ++k) {
    if (k != i && k != j && dot(v, normals.n[k]) < 0.0) return false;
  }
  return true;
}

// By the very expression whose sign says whether i and k share the weight, so that rounding leaves
// one of both.
bool carries_alone(const Normals& normals, std::size_t i) {
  if (normals.up[i] <= 0.0) return false;
  for (std::size_t k = 0; k < normals.count; ++k) {
    if (k != i && normals.up[k] > dot(normals.n[i], normals.n[k]) * normals.up[i]) return false;
  }
  return true;
}

// The share of gravity that contacts i and j carry together: of the unit vector `up` what lies in
// their plane, as a sum of both normals.
struct Shares {
  double i = 0.0;
  double j = 0.0;
};

std::optional<Shares> shares_of(const Normals& normals, std::size_t i, std::size_t j) {
  const double c = dot(normals.n[i], normals.n[j]);
  const double det = 1.0 - c * c;
  if (!(det > 0.0)) return std::nullopt;
  const Shares shares{(normals.up[i] - c * normals.up[j]) / det,
                      (normals.up[j] - c * normals.up[i]) / det};
  if (shares.i < 0.0 || shares.j < 0.0) return std::nullopt;
  return shares;
}

bool falls(const Normals& normals) {
  return std::all_of(normals.up.begin(), normals.up.begin() + normals.count,
                     [](double u) { return u <= 0.0; });
}

// In the plane two contacts that share the weight leave no way.
bool is_flat(const Normals& normals) {
  return std::all_of(normals.n.begin(), normals.n.begin() + normals.count,
                     [](const Vec3& n) { return n.z == 0.0; });
}

void keep_only(Contacts& contacts, std::size_t i, std::size_t j) {
  for (std::size_t k = contacts.size(); k-- > 0;) {
    if (k != i && k != j) contacts.remove(k);
  }
}

// Level, away from the axis; any way from its top.
Vec3 steepest_way(const Vec3& radial, const Vec3& up) {
  const Vec3 across = radial - dot(radial, up) * up;
  const double length = norm(across);
  return length > 0.0 ? across / length : Vec3{1, 0, 0};
}

// The one of both ways that leads to where the ball is.
Vec3 toward(const Vec3& radial, const Vec3& across) {
  return dot(radial, across) < 0.0 ? -across : across;
}

Angle angle_of(const Arc& arc, const Vec3& p) {
  const Vec3 radial = (p - arc.middle) / arc.radius;
  return {dot(radial, arc.uphill), dot(radial, arc.across)};
}

Arc arc_on_ball(const Contact& ball, const Vec3& p, const Vec3& up) {
  Arc arc;
  arc.middle = ball.center;
  arc.radius = ball.reach;
  arc.uphill = up;
  arc.across = steepest_way(p - ball.center, up);
  arc.now = angle_of(arc, p);
  return arc;
}

std::optional<Arc> arc_on_ball_and_wall(const Contacts& contacts, std::size_t ball, const Vec3& p,
                                        const Vec3& up) {
  const Contact& wall = contacts[1 - ball];
  const double distance = dot(contacts[ball].center - wall.center, wall.normal);
  const double radius_sq = contacts[ball].reach * contacts[ball].reach - distance * distance;
  if (!(radius_sq > 0.0)) return std::nullopt;
  Arc arc;
  arc.middle = contacts[ball].center - distance * wall.normal;
  arc.radius = std::sqrt(radius_sq);
  arc.uphill = up;
  arc.across = toward(p - arc.middle, cross(wall.normal, up));
  arc.now = angle_of(arc, p);
  arc.leaves = ball;
  return arc;
}

// With e the unit vector from the first center to the second and x_1, x_2 the distances of the
// middle from both, contact 1 carries nothing any more where U cos t x_2 = -h up.e, and contact 2
// where U cos t x_1 = h up.e; U is the length of `up` in the plane of the circle.
void set_end(Arc& arc, double x_1, double x_2, double along, double steepness) {
  arc.last_cos = -1.0;
  const auto offer = [&](double x, double sign, std::size_t which) {
    if (!(x > 0.0)) return;
    const double cos = sign * along * arc.radius / (steepness * x);
    if (cos <= arc.last_cos) return;
    arc.last_cos = cos;
    arc.leaves = which;
  };
  offer(x_2, -1.0, 0);
  offer(x_1, 1.0, 1);
}

std::optional<Arc> arc_on_balls(const Contact& first, const Contact& second, const Vec3& p,
                                const Vec3& up) {
  const Vec3 d = second.center - first.center;
  const double distance = norm(d);
  const Vec3 e = d / distance;
  const double x_1 =
      0.5 * (distance + (first.reach - second.reach) * (first.reach + second.reach) / distance);
  const double radius_sq = first.reach * first.reach - x_1 * x_1;
  const double along = dot(up, e);
  const Vec3 slope = up - along * e;
  const double steepness = norm(slope);
  if (!(radius_sq > 0.0 && steepness > 0.0)) return std::nullopt;
  Arc arc;
  arc.middle = first.center + x_1 * e;
  arc.radius = std::sqrt(radius_sq);
  arc.uphill = slope / steepness;
  arc.across = toward(p - arc.middle, cross(e, arc.uphill));
  arc.now = angle_of(arc, p);
  set_end(arc, x_1, distance - x_1, along, steepness);
  return arc;
}

}  // namespace

bool settle(Contacts& contacts, const Vec3& up) {
  const Normals normals = normals_of(contacts, up);
  if (falls(normals)) {
    contacts.clear();
    return false;
  }
  for (std::size_t i = 0; i < normals.count; ++i) {
    if (!carries_alone(normals, i)) continue;
    keep_only(contacts, i, i);
    return false;
  }
  if (is_flat(normals)) return true;
  for (std::size_t i = 0; i < normals.count; ++i) {
    for (std::size_t j = i + 1; j < normals.count; ++j) {
      const auto shares = shares_of(normals, i, j);
      if (!shares) continue;
      const Vec3 v = shares->i * normals.n[i] + shares->j * normals.n[j] - up;
      if (!leads_away(normals, v, i, j)) continue;
      keep_only(contacts, i, j);
      return false;
    }
  }
  return true;
}

std::optional<Arc> arc_on(const Contacts& contacts, const Vec3& p, const Vec3& up) {
  if (contacts.size() == 1) return arc_on_ball(contacts[0], p, up);
  if (contacts[0].body == Contact::kWall) return arc_on_ball_and_wall(contacts, 1, p, up);
  if (contacts[1].body == Contact::kWall) return arc_on_ball_and_wall(contacts, 0, p, up);
  return arc_on_balls(contacts[0], contacts[1], p, up);
}

std::optional<Angle> entry(const Blocked& blocked, const Angle& now, double last_cos) {
  const auto [a, b, k, slack] = blocked;
  const double depth = a * now.cos + b * now.sin - k;
  // Less is along the contact, not into it: one that carries nothing any more is left along its
  // tangent, which rounding may turn either way.
  const double inward = b * now.cos - a * now.sin;
  if (depth > -slack && inward > slack) return now;
  const double amplitude_sq = a * a + b * b;
  const double room = amplitude_sq - k * k;
  if (!(room > 0.0)) return std::nullopt;
  // t = atan2(b, a) - acos(k / amplitude), without an angle.
  const double root = std::sqrt(room);
  const Angle at{(a * k + b * root) / amplitude_sq, (b * k - a * root) / amplitude_sq};
  if (at.sin < 0.0 || at.cos >= now.cos || at.cos < last_cos) return std::nullopt;
  return at;
}

}  // namespace packstone::rolling
