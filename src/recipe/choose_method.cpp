#include "recipe/choose_method.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <variant>

#include "packstone/core/overloaded.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/standing.hpp"
#include "recipe/draw_mix.hpp"
#include "recipe/rod_order.hpp"

namespace packstone::recipe {
namespace {

using std::numbers::pi;

// Area, perimeter and their like of convex bodies.
struct Functionals {
  double volume = 0.0;
  double surface = 0.0;
  double curvature = 0.0;  // integral of the mean curvature; in the plane not used

  Functionals& operator+=(const Functionals& other) {
    volume += other.volume;
    surface += other.surface;
    curvature += other.curvature;
    return *this;
  }
};

double curvature(const Body& body) {
  return std::visit(
      Overloaded{[](const Sphere& b) { return 4 * pi * b.radius; },
                 [](const Ellipsoid& b) {
                   // 4 pi times the mean of the support function, which is the surface of the
                   // ellipsoid of the reciprocal axes but for a factor.
                   const Vec3& s = b.semi_axes;
                   return s.x * s.y * s.z * surface(Ellipsoid{{1 / s.x, 1 / s.y, 1 / s.z}, {}});
                 },
                 [](const Cylinder& b) { return 2 * pi * b.half_length + pi * pi * b.radius; },
                 [](const Spherocylinder& b) { return 2 * pi * b.half_length + 4 * pi * b.radius; },
                 [](const auto&) { return 0.0; }},
      body);
}

// Of the body with a shell of thickness t, by Steiner's formulas.
Functionals functionals(const Body& body, double t) {
  const double s = surface(body);
  if (dimension(kind(body)) == 2) {
    return {volume(body) + s * t + pi * t * t, s + 2 * pi * t, 0.0};
  }
  const double m = curvature(body);
  return {volume(body) + s * t + m * t * t + 4 * pi / 3 * t * t * t, s + 2 * m * t + 4 * pi * t * t,
          m + 4 * pi * t};
}

// Sum over `count` bodies, whose functionals sum to `sum`, of the volume that each excludes.
double excluded(const Functionals& sum, double count, const Functionals& body, int dimension) {
  const double mixed =
      dimension == 2 ? sum.surface * body.surface / (2 * pi)
                     : (sum.surface * body.curvature + sum.curvature * body.surface) / (4 * pi);
  return sum.volume + count * body.volume + mixed;
}

// The volume of the places that a body may have between the walls.
double center_room(const Cell& cell, const Body& body) {
  const CenterBox box = centers_inside_walls(cell, half_extents(body));
  double room = 1.0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    room *= std::max(0.0, box.hi[axis] - box.lo[axis]);
  }
  return room;
}

std::vector<Body> in_order(const std::vector<OrderedBody>& bodies, RsaOrder order) {
  std::vector<Body> sorted;
  sorted.reserve(bodies.size());
  for (const OrderedBody& b : bodies) sorted.push_back(b.body);
  if (order != RsaOrder::largest_first) return sorted;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Body& a, const Body& b) { return volume(a) > volume(b); });
  return sorted;
}

void refuse_open_count(const InclusionMix& mix, PackMethod method) {
  const auto open = std::find(mix.open_count.begin(), mix.open_count.end(), true);
  if (open == mix.open_count.end()) return;
  throw InvalidGroup(
      "", static_cast<int>(open - mix.open_count.begin()), GroupField::size, "",
      "a size alone leaves the count open, and " + std::string(name(method)) +
          " moves a number of inclusions that is known; give a count or a fraction too, or order "
          "method = \"rsa\" or \"advancing-layer\" and goal = \"target\"");
}

// Up to this crowding relaxations of all shapes tried came to rest at the first attempt.
constexpr double kRelaxedCrowding = 3.2;

// Collisions may turn all bodies that have an axis.
bool all_turn_freely(const Recipe& recipe) {
  return std::all_of(recipe.groups.begin(), recipe.groups.end(), [](const InclusionGroup& group) {
    return is_round(group.shape) || std::holds_alternative<RandomOrientation>(group.orientation);
  });
}

// Rods so long block each other as they grow: at random directions those of aspect 5 jam at 0.56
// and come to rest at 0.60 when they are relaxed, those of aspect 10 at 0.43 and 0.51.
bool are_long_rods(const std::vector<OrderedBody>& bodies) {
  constexpr double kLong = 5.0;
  const std::optional<RodOrder> rods = rod_order(bodies);
  return rods && rods->aspect >= kLong;
}

MethodChoice choice_by_crowding(double crowded, bool all_turn, bool long_rods) {
  if (crowded <= 1.0) {
    return {PackMethod::rsa, "auto: it surely places them all", false, crowded};
  }
  if (crowded <= kRelaxedCrowding) {
    return {PackMethod::relaxation, "auto: denser than rsa surely reaches", all_turn, crowded};
  }
  // Infinite: some have no room between walls as they are turned, and have to turn a long way.
  if (long_rods && std::isfinite(crowded)) {
    return {PackMethod::relaxation, "auto: dense, and long rods block each other as they grow",
            all_turn, crowded};
  }
  if (!all_turn) {
    return {PackMethod::relaxation, "auto: dense, and it keeps the orientations ordered", false,
            crowded};
  }
  return {PackMethod::event_driven, "auto: denser than a relaxation surely reaches", false,
          crowded};
}

MethodChoice automatic_choice(const Recipe& recipe, const InclusionMix& mix) {
  if (recipe.event_driven.goal != EventDrivenGoal::target) {
    return {PackMethod::event_driven, "auto: the goal is for inclusions that move"};
  }
  if (recipe.relaxation.goal != RelaxationGoal::target) {
    return {PackMethod::relaxation, "auto: the goal is one of relaxations"};
  }
  if (std::find(mix.open_count.begin(), mix.open_count.end(), true) != mix.open_count.end()) {
    return {PackMethod::rsa, "auto: it fills the cell"};
  }
  return choice_by_crowding(crowding(recipe.cell, mix.bodies, recipe.min_gap, recipe.rsa.order),
                            all_turn_freely(recipe), are_long_rods(mix.bodies));
}

}  // namespace

MethodChoice choose_method(const Recipe& recipe, const InclusionMix& mix) {
  MethodChoice choice = recipe.method == PackMethod::automatic
                            ? automatic_choice(recipe, mix)
                            : MethodChoice{recipe.method, "as ordered"};
  if (choice.method != PackMethod::rsa && !is_constructive(choice.method)) {
    refuse_open_count(mix, choice.method);
  }
  return choice;
}

double crowding(const Cell& cell, const std::vector<OrderedBody>& bodies, double min_gap,
                RsaOrder order) {
  // Sums over free volume of 0.30 of equal spheres and 0.45 of equal disks: 2^d c / (1 - c).
  const bool plane = cell.dimension == 2;
  const double sure = plane ? 4 * 0.45 / 0.55 : 8 * 0.30 / 0.70;
  const double of_balls = plane ? 4.0 : 8.0;
  const double space = volume(cell);
  Functionals before;
  double count = 0.0;
  double most = 0.0;
  for (const Body& body : in_order(bodies, order)) {
    const Functionals own = functionals(body, 0.5 * min_gap);
    const double taken = excluded(before, count, own, cell.dimension) / center_room(cell, body);
    const double itself = excluded(own, 1.0, own, cell.dimension) / own.volume;
    const double free = 1.0 - before.volume / space;
    if (!(free > 0.0) || !std::isfinite(taken)) return std::numeric_limits<double>::infinity();
    most = std::max(most, taken / free / (sure * std::pow(itself / of_balls, 0.2)));
    before += own;
    count += 1.0;
  }
  return most;
}

double fraction_with_gaps(const Cell& cell, const std::vector<OrderedBody>& bodies,
                          double min_gap) {
  double sum = 0.0;
  for (const OrderedBody& b : bodies) {
    sum += min_gap > 0.0 ? functionals(b.body, 0.5 * min_gap).volume : volume(b.body);
  }
  return sum / volume(cell);
}

}  // namespace packstone::recipe
