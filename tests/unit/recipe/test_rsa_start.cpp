#include "recipe/rsa_start.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/structure/orientation_law.hpp"

namespace packstone::recipe {
namespace {

Recipe fibers(double aspect, double fraction, const SymMat3& tensor, double length = 0.5) {
  InclusionGroup group;
  group.name = "fibers";
  group.shape = ShapeKind::spherocylinder;
  group.dimensions = Vec3{0.5 * length / aspect, 0.5 * length, 0};
  group.fraction = fraction;
  group.orientation = TensorOrientation{tensor};
  Recipe recipe;
  recipe.groups = {group};
  return recipe;
}

std::vector<OrderedBody> bodies_of(const Recipe& recipe) {
  return draw_inclusions(recipe.cell, recipe.groups, 1).bodies;
}

constexpr SymMat3 kRandom{1.0 / 3, 1.0 / 3, 1.0 / 3, 0, 0, 0};
constexpr SymMat3 kAligned{0.9, 0.05, 0.05, 0, 0, 0};

}  // namespace

TEST_CASE("long rods start where one meets about six others, balls where it meets two") {
  const Recipe rods = fibers(50, 0.10, kRandom, 0.8);
  const double of_rods = start_factor(rods, bodies_of(rods), {}, 1.0);
  // At random a rod of aspect x meets 2 phi (x + 4 + ...) others.
  CHECK(0.10 * std::pow(of_rods, 3) == Approx(0.058).margin(0.006));

  Recipe spheres;
  const std::vector<OrderedBody> balls(400, OrderedBody{Sphere{0.0668}, 0});
  const double of_balls = start_factor(spheres, balls, {}, 1.0);
  const double fraction = 400 * 4.18879 * std::pow(of_balls * 0.0668, 3);
  CHECK(fraction == Approx(0.22).margin(0.02));

  CHECK(start_factor(rods, bodies_of(rods), 0.0125, 1.0) == Approx(0.5).margin(1e-3));
  CHECK(start_factor(rods, bodies_of(rods), {}, 0.0125) == Approx(0.5).margin(1e-3));
}

TEST_CASE("a start that takes too many trials is made with smaller bodies") {
  Recipe recipe = fibers(20, 0.35, kAligned);
  const std::vector<OrderedBody> bodies = bodies_of(recipe);
  const double dense = std::cbrt(0.30 / 0.35);
  recipe.rsa.max_trials = 1000;
  const SmallerPlaced placed = place_smaller(recipe, bodies, dense, false, 1, {});
  CHECK(placed.rsa.stop == RsaStop::target_reached);
  CHECK(placed.rsa.packing.inclusions.size() == bodies.size());
  CHECK(placed.factor < dense);
  CHECK(placed.factor > 0.6 * dense);

  recipe.rsa.max_restarts = 0;
  const SmallerPlaced ordered = place_smaller(recipe, bodies, dense, true, 1, {});
  CHECK(ordered.rsa.stop == RsaStop::given_up);
  CHECK(ordered.factor == dense);
}

}  // namespace packstone::recipe
