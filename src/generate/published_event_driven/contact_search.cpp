#include "generate/published_event_driven/contact_search.hpp"

#include <algorithm>
#include <cmath>

#include "generate/published_event_driven/root_search.hpp"

namespace packstone::published {
namespace {

double largest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }
double least(const Vec3& v) { return std::min({v.x, v.y, v.z}); }

/// Equation (16b).
struct SphereEquation {
  double gamma_1, gamma_2, gamma_3;
};

SphereEquation sphere_equation(const MovingEllipsoid& a, const MovingEllipsoid& b) {
  const Vec3 r = a.center - b.center, v = a.velocity - b.velocity;
  const double reach = largest(a.semi_axes) + largest(b.semi_axes);
  const double growth = largest(a.growth) + largest(b.growth);
  return {norm_sq(v) - growth * growth, dot(r, v) - reach * growth, norm_sq(r) - reach * reach};
}

/// The bodies cannot meet before this time if their neighborhoods are apart: some plane then has
/// (mu - 1) times both support functions to spare, which motion, rotation and growth use up.
double time_from_neighborhoods(const MovingEllipsoid& a, const MovingEllipsoid& b, double horizon,
                               double mu) {
  const double spare = (mu - 1.0) * (least(a.semi_axes) + least(b.semi_axes));
  const auto surface_speed = [&](const MovingEllipsoid& m) {
    const double longest = largest(m.semi_axes) + horizon * largest(m.growth);
    return norm(m.angular_velocity) * longest + largest(m.growth);
  };
  return spare / (norm(a.velocity - b.velocity) + surface_speed(a) + surface_speed(b));
}

PublishedRelation neighborhoods(const MovingEllipsoid& a, const MovingEllipsoid& b,
                                const PublishedOptions& options) {
  const double mu = options.neighborhood;
  return published_relation({mu * a.semi_axes, a.orientation}, {mu * b.semi_axes, b.orientation},
                            b.center - a.center, options.table);
}

/// May the pair be set aside until the next event?
bool set_aside(const MovingEllipsoid& a, const MovingEllipsoid& b, double horizon,
               const PublishedOptions& options) {
  if (neighborhoods(a, b, options) != PublishedRelation::separate) return false;
  if (options.skipped_pairs == PublishedForm::printed) return true;
  return time_from_neighborhoods(a, b, horizon, options.neighborhood) >= horizon;
}

}  // namespace

std::optional<SphereContact> sphere_contact(const MovingEllipsoid& a, const MovingEllipsoid& b) {
  const auto [gamma_1, gamma_2, gamma_3] = sphere_equation(a, b);
  const double discriminant = gamma_2 * gamma_2 - gamma_1 * gamma_3;
  const bool apart = gamma_3 > 0.0;
  if (apart && (discriminant < 0.0 || (gamma_2 >= 0.0 && gamma_1 >= 0.0))) return std::nullopt;
  const double root = std::sqrt(std::max(0.0, discriminant));
  SphereContact contact;
  // The paper divides by gamma_1, which may be 0 where gamma_2 is not.
  if (apart) {
    contact.from = gamma_2 <= 0.0 ? gamma_3 / (root - gamma_2) : -(gamma_2 + root) / gamma_1;
  }
  if (gamma_1 > 0.0) contact.to = (root - gamma_2) / gamma_1;
  return contact;
}

Forecast collision_forecast(const MovingEllipsoid& a, const MovingEllipsoid& b, const Clock& clock,
                            const PublishedOptions& options, PublishedCounts& counts) {
  const std::optional<SphereContact> spheres = sphere_contact(a, b);
  if (!spheres) return {true, false, kNever};
  const double horizon = clock.horizon(options);
  if (clock.now + spheres->from >= clock.next) {
    ++counts.skipped;
    return none_before(clock.now + spheres->from, options);
  }
  if (set_aside(a, b, horizon, options)) {
    ++counts.skipped;
    return none_before(clock.now + horizon, options);
  }
  ++counts.searches;
  const std::optional<double> found = published_contact_time(a, b, horizon, options);
  if (found) return {true, true, clock.now + *found};
  return none_before(clock.now + horizon, options);
}

}  // namespace packstone::published

namespace packstone {

std::optional<double> published_contact_time(const MovingEllipsoid& a, const MovingEllipsoid& b,
                                             double horizon, const PublishedOptions& options) {
  const auto spheres = published::sphere_contact(a, b);
  if (!spheres || !(spheres->from < std::min(horizon, spheres->to))) return std::nullopt;
  const auto etas = [&](double dt) {
    const MovingEllipsoid later_a = published_moved(a, dt), later_b = published_moved(b, dt);
    return published_etas(
        published_quartic(body_of(later_a), body_of(later_b), later_b.center - later_a.center));
  };
  const published::RootSearch search{spheres->from, std::min(horizon, spheres->to), options.samples,
                                     options.parting_roots};
  return published::first_root([&](double dt) { return etas(dt).eta_1; }, search,
                               [&](double dt) { return published_touching(etas(dt)); });
}

}  // namespace packstone
