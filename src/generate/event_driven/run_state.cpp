#include "generate/event_driven/run_state.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "generate/event_driven/collision.hpp"
#include "packstone/core/random.hpp"

namespace packstone::event_driven {
namespace {

using Member = double Progressed::*;
constexpr std::array<std::pair<std::string_view, Member>, 10> kNumbers{{
    {"growth_rate", &Progressed::growth_rate},
    {"time", &Progressed::time},
    {"collisions", &Progressed::collisions},
    {"since_slower", &Progressed::since_slower},
    {"grown", &Progressed::grown},
    {"energy", &Progressed::energy},
    {"still_collisions", &Progressed::still_collisions},
    {"virial", &Progressed::virial},
    {"pressure", &Progressed::pressure},
    {"still_time", &Progressed::still_time},
}};

bool keeps_orientation(const EventDrivenOptions& options, int group) {
  const auto g = static_cast<std::size_t>(group);
  return g < options.fixed_orientation.size() && options.fixed_orientation[g];
}

bool turns(const Bodies& bodies, std::size_t k) { return !(bodies.inverse_inertia[k] == Vec3{}); }

// Angular velocity of variance 1 over the moments of inertia, about the axes of the body.
Vec3 thermal_turn(const Bodies& bodies, std::size_t k, int dimension, RandomStream& random) {
  const Vec3& inverse = bodies.inverse_inertia[k];
  const Vec3& axis = bodies.spin[k].axis;
  const Vec3 drawn{random.normal(), random.normal(), random.normal()};
  if (dimension == 2) return {0.0, 0.0, std::sqrt(inverse.z) * drawn.z};
  const Vec3 second =
      bodies.form[k] == Form::scalene ? bodies.second[k].axis : any_perpendicular(axis);
  return std::sqrt(inverse.x) * drawn.x * axis + std::sqrt(inverse.y) * drawn.y * second +
         std::sqrt(inverse.z) * drawn.z * cross(axis, second);
}

}  // namespace

Progressed read_numbers(const MovingPacking& state) {
  Progressed progressed;
  for (const auto& [name, value] : state.numbers) {
    for (const auto& [known, member] : kNumbers) {
      if (name == known) progressed.*member = value;
    }
  }
  return progressed;
}

void write_numbers(const Progressed& progressed, MovingPacking& state) {
  state.numbers.clear();
  for (const auto& [name, member] : kNumbers) {
    state.numbers.emplace_back(std::string(name), progressed.*member);
  }
}

Bodies bodies_of(const MovingPacking& state, const EventDrivenOptions& options) {
  Bodies bodies;
  bodies.size = state.size_factor;
  bodies.min_gap = options.min_gap;
  for (const Inclusion& inclusion : state.packing.inclusions) {
    add_body(bodies, inclusion.body, inclusion.center,
             !keeps_orientation(options, inclusion.group));
  }
  if (!bodies.second.empty()) bodies.second.resize(bodies.flight.size());
  for (std::size_t k = 0; k < state.velocity.size(); ++k) {
    bodies.flight[k].velocity = state.velocity[k];
    if (turns(bodies, k)) bodies.set_angular(k, state.angular_velocity[k]);
  }
  return bodies;
}

void store(const Bodies& bodies, MovingPacking& state) {
  state.size_factor = bodies.size;
  for (std::int32_t i = 0; i < bodies.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    Inclusion& inclusion = state.packing.inclusions[k];
    inclusion.center = bodies.flight[k].center;
    inclusion.body = turned_body(bodies, i, inclusion.body);
    state.velocity[k] = bodies.flight[k].velocity;
    state.angular_velocity[k] = bodies.spin[k].angular;
  }
}

void draw_velocities(std::uint64_t seed, const EventDrivenOptions& options, MovingPacking& state) {
  state.velocity.clear();
  state.angular_velocity.clear();
  const Bodies bodies = bodies_of(state, options);
  const int dimension = state.packing.cell.dimension;
  for (std::size_t k = 0; k < bodies.flight.size(); ++k) {
    RandomStream random(seed, StreamId::event_driven_velocities, k);
    Vec3 velocity{random.normal(), random.normal(), random.normal()};
    if (dimension == 2) velocity.z = 0.0;
    state.velocity.push_back(velocity);
    state.angular_velocity.push_back(turns(bodies, k) ? thermal_turn(bodies, k, dimension, random)
                                                      : Vec3{});
  }
}

Freedom freedom_of(const Bodies& bodies, int dimension) {
  Freedom freedom;
  for (std::size_t k = 0; k < bodies.flight.size(); ++k) {
    freedom.translation += dimension;
    if (!turns(bodies, k)) continue;
    freedom.rotation += dimension == 2 ? 1 : bodies.form[k] == Form::scalene ? 3 : 2;
  }
  return freedom;
}

double total_energy(const Bodies& bodies) {
  double sum = 0.0;
  for (std::int32_t i = 0; i < bodies.count(); ++i) {
    const Energy e = energy(bodies, i, bodies.size);
    sum += e.translation + e.rotation;
  }
  return sum;
}

double rescale_velocities(Bodies& bodies, int dimension) {
  const Freedom freedom = freedom_of(bodies, dimension);
  Energy sum;
  for (std::int32_t i = 0; i < bodies.count(); ++i) {
    const Energy e = energy(bodies, i, bodies.size);
    sum.translation += e.translation;
    sum.rotation += e.rotation;
  }
  const auto factor = [](double wanted, double now) {
    return now > 0.0 ? std::sqrt(0.5 * wanted / now) : 1.0;
  };
  const double flying = factor(freedom.translation, sum.translation);
  const double turning = factor(freedom.rotation, sum.rotation);
  for (std::size_t k = 0; k < bodies.flight.size(); ++k) {
    bodies.flight[k].velocity *= flying;
    bodies.set_angular(k, turning * bodies.spin[k].angular);
  }
  return (sum.translation + sum.rotation) / (0.5 * (freedom.translation + freedom.rotation));
}

}  // namespace packstone::event_driven
