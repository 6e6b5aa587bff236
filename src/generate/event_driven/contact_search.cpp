#include "generate/event_driven/contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "generate/event_driven/contact_gap.hpp"
#include "generate/event_driven/plane_bound.hpp"
#include "generate/event_driven/plane_search.hpp"
#include "generate/event_driven/revolution_bound.hpp"
#include "generate/event_driven/revolution_pair.hpp"
#include "geometry/touching_points.hpp"

namespace packstone::event_driven {
namespace {

constexpr int kMostSteps = 200;

// The point of a body of revolution at size factor 1 that lies farthest along the unit vector n,
// and how far that is.
Vec3 revolution_point(const Revolution<double, Vec3>& body, const Spin& spin, const Vec3& n,
                      double& support) {
  const double along = dot(n, body.axis);
  const Vec3 image =
      (spin.axial * spin.axial * along) * body.axis + body.lateral * (n - along * body.axis);
  support = std::sqrt(dot(n, image));
  return image / support;
}

// A gap that opens is taken for a part of the gap that counts as contact at least, so that the
// search gets away from it. Returns it as it is then.
template <class Bound>
double held_open(Bound& bound, double gap, double contact_gap) {
  constexpr double kLeast = 0.1;
  const double lift = std::max(0.0, kLeast * contact_gap - gap);
  bound.raise(lift * bound.length());
  return gap + lift;
}

// From the center of body i to that of its partner, another body or an image, at t.
Vec3 between_centers(const Bodies& bodies, std::int32_t i, const Partner& partner, double t) {
  if (partner.body == i) return partner.shift;
  const Flight& a = bodies.flight[static_cast<std::size_t>(i)];
  const Flight& b = bodies.flight[static_cast<std::size_t>(partner.body)];
  return (b.center - a.center) + partner.shift + (t - b.clock) * b.velocity -
         (t - a.clock) * a.velocity;
}

// The plane that separates by most.
RevolutionPlane<double, Vec3> best_plane(const Revolution<double, Vec3>& a,
                                         const Revolution<double, Vec3>& b, const Vec3& r,
                                         double l) {
  constexpr int kMostPlaneSteps = 40;
  // The step that is still taken squares what is left.
  constexpr double kConverged = 1e-5;
  RevolutionPlane<double, Vec3> plane = plane_step(a, b, r, l);
  for (int k = 1; k < kMostPlaneSteps; ++k) {
    const double moved = std::abs(plane.l - l);
    l = plane.l;
    if (moved <= kConverged * std::min(l, 1.0 - l)) break;
    plane = plane_step(a, b, r, l);
  }
  return plane;
}

}  // namespace

// Two bodies, or a body and a wall, at one instant.
struct ContactSearch::Instant {
  PosedBody a, b;
  Vec3 r;         // From center to center; for walls from the center to its foot on the wall.
  Vec3 velocity;  // Of b seen from a.
  Vec3 angular_a, angular_b;
  double size = 1.0;
  bool wall = false;
  bool smooth = true;  // Kernels of ellipsoids do.

  [[nodiscard]] Vec3 normal(double min_gap, const Vec3& known, Effort effort) const {
    return wall ? r : find_plane(a, b, r, min_gap, known, effort);
  }

  // How fast the points where both touch approach, but for their growth.
  [[nodiscard]] double approach(const Contact& contact) const {
    const Vec3 speed = velocity + cross(angular_b, contact.arm_b) - cross(angular_a, contact.arm_a);
    return -dot(contact.normal, speed);
  }

  void set_arms(Contact& contact, const Vec3& toward) const {
    if (wall) {
      contact.arm_a = touching_point(a, contact.normal, toward);
      return;
    }
    const TouchingPoints points = touching_points(a, b, r, contact.normal, toward);
    contact.arm_a = points.of_a;
    contact.arm_b = points.of_b;
  }
};

ContactSearch::ContactSearch(const Bodies& bodies, const Cell& cell)
    : bodies_(bodies),
      cell_(cell),
      coordinate_gap_(kCoordinateGap * std::max({cell.size.x, cell.size.y, cell.size.z})) {}

double ContactSearch::contact_gap(std::int32_t i, const Partner& partner, double t) const {
  const auto k = static_cast<std::size_t>(i);
  double reach = bodies_.reach[k];
  bool smooth = is_ellipsoid(bodies_.form[k]);
  if (!is_wall(partner.body)) {
    const auto j = static_cast<std::size_t>(partner.body);
    reach += bodies_.reach[j];
    smooth = smooth && is_ellipsoid(bodies_.form[j]) && bodies_.min_gap == 0.0;
  }
  const double relative = smooth ? kSmoothContactGap : kGeneralContactGap;
  return std::max(relative * reach * bodies_.size_at(t), coordinate_gap_);
}

ContactSearch::Instant ContactSearch::instant(std::int32_t i, const Partner& partner,
                                              double t) const {
  const auto k = static_cast<std::size_t>(i);
  Instant now;
  now.size = bodies_.size_at(t);
  const Pose pose = bodies_.pose(i, t);
  now.a = posed(bodies_, i, pose, now.size);
  now.angular_a = bodies_.spin[k].angular;
  now.velocity = -bodies_.flight[k].velocity;
  if (is_wall(partner.body)) {
    const int number = -1 - partner.body;
    const auto axis = static_cast<std::size_t>(number / 2);
    const double place = number % 2 == 1 ? cell_.size[axis] : 0.0;
    now.r[axis] = place - pose.center[axis];
    now.wall = true;
    now.smooth = is_ellipsoid(now.a.form);
    return now;
  }
  const auto j = static_cast<std::size_t>(partner.body);
  const Pose other = partner.body == i ? pose : bodies_.pose(partner.body, t);
  now.b = posed(bodies_, partner.body, other, now.size);
  now.angular_b = bodies_.spin[j].angular;
  now.r = partner.body == i ? partner.shift : other.center + partner.shift - pose.center;
  now.velocity += bodies_.flight[j].velocity;
  now.smooth = is_ellipsoid(now.a.form) && is_ellipsoid(now.b.form) && bodies_.min_gap == 0.0;
  return now;
}

double ContactSearch::gap(std::int32_t i, const Partner& partner, double t) const {
  const Instant now = instant(i, partner, t);
  const Vec3 normal = now.normal(bodies_.min_gap, {}, Effort::touch);
  const double supports = support(now.a, normal) + (now.wall ? 0.0 : support(now.b, normal));
  return (dot(normal, now.r) - supports) / norm(normal) - (now.wall ? 0.0 : bodies_.min_gap);
}

// One of a pair of revolution, on its way from the clock it was stored at.
struct ContactSearch::Turning {
  const Spin& spin;
  double turn;
  double clock;
  double reach;
  Form form;

  Turning(const Bodies& bodies, std::int32_t i)
      : spin(bodies.spin[static_cast<std::size_t>(i)]),
        turn(bodies.flight[static_cast<std::size_t>(i)].turn),
        clock(bodies.flight[static_cast<std::size_t>(i)].clock),
        reach(bodies.reach[static_cast<std::size_t>(i)]),
        form(bodies.form[static_cast<std::size_t>(i)]) {}

  [[nodiscard]] Revolution<double, Vec3> at(double t) const {
    const double lateral = spin.lateral * spin.lateral;
    return {turn > 0.0 ? turned_across(spin.axis, spin.angular, turn, t - clock) : spin.axis,
            spin.angular, lateral, spin.axial * spin.axial - lateral, turn};
  }
};

Contact ContactSearch::contact(std::int32_t i, const Partner& partner, double t,
                               const Vec3& normal) const {
  const Instant now = instant(i, partner, t);
  Contact contact;
  contact.normal = normalized(now.normal(bodies_.min_gap, normal, Effort::touch));
  contact.between = now.r;
  const double supports =
      support(now.a, contact.normal) + (now.wall ? 0.0 : support(now.b, contact.normal));
  contact.growth_speed = bodies_.growth / now.size * supports;
  now.set_arms(contact, {});
  contact.approach = contact.growth_speed + now.approach(contact);
  if (contact.approach > 0.0) return contact;
  // Where the middle of a shared side opens an end of it may close.
  now.set_arms(contact, cross(contact.normal, now.angular_a - now.angular_b));
  contact.approach = contact.growth_speed + now.approach(contact);
  return contact;
}

Contact ContactSearch::contact_of_revolution(std::int32_t i, const Partner& partner, double t,
                                             double l) const {
  const Turning a(bodies_, i), b(bodies_, partner.body);
  const Flight& flight_a = bodies_.flight[static_cast<std::size_t>(i)];
  const Flight& flight_b = bodies_.flight[static_cast<std::size_t>(partner.body)];
  Contact contact;
  contact.between = between_centers(bodies_, i, partner, t);
  const double size = bodies_.size_at(t);
  const Revolution<double, Vec3> now_a = a.at(t), now_b = b.at(t);
  const bool balls = a.form == Form::ball && b.form == Form::ball;
  contact.normal =
      normalized(balls ? contact.between : best_plane(now_a, now_b, contact.between, l).normal);
  double support_a = 0.0, support_b = 0.0;
  contact.arm_a = size * revolution_point(now_a, a.spin, contact.normal, support_a);
  contact.arm_b = -size * revolution_point(now_b, b.spin, contact.normal, support_b);
  contact.growth_speed = bodies_.growth * (support_a + support_b);
  const Vec3 speed = (flight_b.velocity + cross(now_b.angular, contact.arm_b)) -
                     (flight_a.velocity + cross(now_a.angular, contact.arm_a));
  contact.approach = contact.growth_speed - dot(contact.normal, speed);
  return contact;
}

Found ContactSearch::first_contact_of_balls(std::int32_t i, const Partner& partner, double t,
                                            double horizon) {
  const Instant now = instant(i, partner, t);
  const double radii = bodies_.spin[static_cast<std::size_t>(i)].lateral +
                       bodies_.spin[static_cast<std::size_t>(partner.body)].lateral;
  const double contact_gap = this->contact_gap(i, partner, t);
  const double growth = bodies_.growth * radii;
  const double range = now.size * radii + bodies_.min_gap;
  const double distance = norm(now.r);
  count_.least_gap = std::min(count_.least_gap, distance - range);
  const double rate = dot(now.r, now.velocity) / distance - growth;
  if (rate >= 0.0) return {};
  const double gap = distance - (range + kAimedPart * contact_gap);
  if (gap <= 0.0) return {Finding::contact, t};
  const double a = norm_sq(now.velocity) - growth * growth;
  const double b = dot(now.r, now.velocity) - (range + kAimedPart * contact_gap) * growth;
  const double c = gap * (distance + range + kAimedPart * contact_gap);
  const double discriminant = b * b - a * c;
  if (b >= 0.0 && a >= 0.0) return {};
  if (discriminant < 0.0) return {};
  const double after =
      b < 0.0 ? c / (std::sqrt(discriminant) - b) : -(b + std::sqrt(discriminant)) / a;
  if (t + after >= horizon) return {};
  return {Finding::contact, t + after};
}

// From time to time, each of them proven free, until a plane holds to the horizon or the pair
// touches.
template <class Pair>
Found ContactSearch::march(Pair& pair, double time, double horizon, double contact_gap) {
  ++count_.searches;
  for (int step = 0; step < kMostSteps; ++step) {
    ++count_.steps;
    pair.go_to(time);
    auto bound = pair.bound();
    double gap = bound.now() / bound.length();
    if (gap <= contact_gap && pair.refine()) {
      bound = pair.bound();
      gap = bound.now() / bound.length();
    }
    if (step == 0) count_.least_gap = std::min(count_.least_gap, gap);
    if (gap <= contact_gap) {
      if (pair.closes(bound)) return {Finding::contact, time};
      gap = held_open(bound, gap, contact_gap);
    }
    const double rest = horizon - time;
    if (bound.at(rest) >= 0.0) return {};
    const double aim = std::min(kAimedPart * contact_gap, 0.5 * gap) * bound.length();
    const double later = time + safe_time(bound, rest, aim);
    // A plane known from before may be too bad to get on with.
    if (later <= time && step > 0) break;
    time = later;
  }
  return {Finding::look_again, time};
}

// Two bodies of revolution on their way, and the plane between them.
class ContactSearch::PairOfRevolution {
 public:
  PairOfRevolution(const ContactSearch& search, std::int32_t i, const Partner& partner, double t,
                   double l)
      : bodies_(search.bodies_),
        a_(bodies_, i),
        b_(bodies_, partner.body),
        start_(t),
        from_(between_centers(bodies_, i, partner, t)),
        moving_{a_.reach, b_.reach, 0.0, bodies_.growth,
                bodies_.flight[static_cast<std::size_t>(partner.body)].velocity -
                    bodies_.flight[static_cast<std::size_t>(i)].velocity},
        plane_{{}, l} {}

  void go_to(double time) {
    moving_.size = bodies_.size_at(time);
    now_a_ = a_.at(time);
    now_b_ = b_.at(time);
    r_ = from_ + (time - start_) * moving_.velocity;
    plane_ = plane_step(now_a_, now_b_, r_, plane_.l);
  }
  bool refine() {
    plane_ = best_plane(now_a_, now_b_, r_, plane_.l);
    return true;
  }
  [[nodiscard]] RevolutionBound bound() const {
    return {plane_.normal, now_a_, now_b_, r_, moving_};
  }
  [[nodiscard]] bool closes(const RevolutionBound& bound) const { return bound.slope_now() < 0.0; }

 private:
  const Bodies& bodies_;
  Turning a_, b_;
  double start_;
  Vec3 from_;
  RevolutionBound::Moving moving_;
  Revolution<double, Vec3> now_a_{}, now_b_{};
  Vec3 r_;
  RevolutionPlane<double, Vec3> plane_;
};

Found ContactSearch::first_contact_of_revolution(std::int32_t i, const Partner& partner, double t,
                                                 double horizon, const Suspicion& suspicion) {
  const double time = t + suspicion.clear;
  if (time >= horizon) return {};
  PairOfRevolution pair(*this, i, partner, t, suspicion.l);
  return march(pair, time, horizon, contact_gap(i, partner, t));
}

// Two bodies of any shape, or a body and a wall, and the plane between them.
class ContactSearch::AnyPair {
 public:
  AnyPair(const ContactSearch& search, std::int32_t i, const Partner& partner, Vec3& normal)
      : search_(search), bodies_(search.bodies_), i_(i), partner_(partner), normal_(normal) {}

  void go_to(double time) {
    time_ = time;
    now_ = search_.instant(i_, partner_, time);
    // The plane that is known to begin with is tried as it is.
    const bool known = std::exchange(fresh_, false) && !(normal_ == Vec3{});
    if (!known) normal_ = now_.normal(bodies_.min_gap, normal_, effort_);
  }
  bool refine() {
    if (effort_ == Effort::touch) return false;
    effort_ = Effort::touch;
    normal_ = now_.normal(bodies_.min_gap, normal_, effort_);
    return true;
  }
  [[nodiscard]] PlaneBound bound() const {
    MovingPlane plane{normal_, {}};
    if (!now_.smooth && !now_.wall) {
      plane.rate = normal_rate(now_.a, now_.b, now_.angular_a, now_.angular_b, normal_);
    }
    PlaneBound bound(plane, now_.r, now_.velocity, now_.wall ? 0.0 : bodies_.min_gap);
    add_body(bound, i_, now_.a);
    if (!now_.wall) add_body(bound, partner_.body, now_.b);
    return bound;
  }
  [[nodiscard]] bool closes(const PlaneBound& bound) const {
    if (now_.smooth) return bound.slope(0.0) < 0.0;
    return search_.contact(i_, partner_, time_, normal_).approach > 0.0;
  }

 private:
  void add_body(PlaneBound& bound, std::int32_t i, const PosedBody& body) const {
    const auto k = static_cast<std::size_t>(i);
    bound.add_body(body.form, bodies_.spin[k], body.pose, bodies_.second_semi_axis(k),
                   bodies_.reach[k], now_.size, bodies_.growth);
  }

  const ContactSearch& search_;
  const Bodies& bodies_;
  std::int32_t i_;
  const Partner& partner_;
  Vec3& normal_;
  double time_ = 0.0;
  Instant now_;
  Effort effort_ = Effort::step;
  bool fresh_ = true;
};

Found ContactSearch::first_contact(std::int32_t i, const Partner& partner, double t, double horizon,
                                   Vec3& normal) {
  const auto is_ball = [&](std::int32_t k) {
    return bodies_.form[static_cast<std::size_t>(k)] == Form::ball;
  };
  if (!is_wall(partner.body) && is_ball(i) && is_ball(partner.body)) {
    ++count_.searches;
    return first_contact_of_balls(i, partner, t, horizon);
  }
  AnyPair pair(*this, i, partner, normal);
  return march(pair, t, horizon, contact_gap(i, partner, t));
}

}  // namespace packstone::event_driven
