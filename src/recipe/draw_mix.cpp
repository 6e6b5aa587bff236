#include "recipe/draw_mix.hpp"

#include "packstone/core/memory.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/images.hpp"
#include "packstone/structure/standing.hpp"

namespace packstone::recipe {
namespace {

// The words for the first of `keys` that was read, or for the recipe as a whole.
std::string place_of(const Recipe& recipe, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    if (const auto found = recipe.places.find(key); found != recipe.places.end()) {
      return found->second + "; ";
    }
  }
  return recipe.origin.empty() ? "" : recipe.origin + ": ";
}

// Bytes that an inclusion takes at the peak, at least: measured were 360 (disks at fraction 0.3) to
// 590 (ellipses), and up to 2500 for equal spheres in a nearly empty cell.
constexpr double kLeastBytes = 350;

InclusionLimit limit_of_machine() {
  const double fit = physical_memory() / kLeastBytes;
  const InclusionLimit any;
  if (fit >= static_cast<double>(any.most)) return any;
  return {static_cast<std::int64_t>(fit), kLeastBytes};
}

// Equal spheres or disks that fill the cell: how many there will be is known, some percent less
// than random sequential adsorption leaves room for.
void refuse_too_many_to_fill(const Recipe& recipe) {
  const double radius = saturating_radius(recipe);
  if (!(radius > 0.0)) return;
  const bool plane = recipe.cell.dimension == 2;
  const double grown = radius + 0.5 * recipe.min_gap;
  const double ball = volume(plane ? Body{Disk{grown}} : Body{Sphere{grown}});
  const double count = (plane ? 0.5 : 0.35) * volume(recipe.cell) / ball;
  const InclusionLimit limit = limit_of_machine();
  if (count <= static_cast<double>(limit.most)) return;
  throw InvalidGroup(
      "", 0, GroupField::size, "",
      "to fill the cell takes some " + number_text(count, 3) + "; " + limit.why_not(count));
}

// The bodies ordered, and the first one of a group of open count, can stand and have room.
void refuse_unplaceable(const Recipe& recipe, const InclusionMix& mix,
                        const std::vector<bool>& turned) {
  check_standing(recipe.cell, mix.bodies, recipe.min_gap, turned);
  for (std::size_t g = 0; g < recipe.groups.size(); ++g) {
    if (!mix.open_count[g]) continue;
    const auto first =
        draw_open_group(recipe.cell, recipe.groups[g], static_cast<int>(g), 0, 1, recipe.seed);
    check_standing(recipe.cell, first, recipe.min_gap, turned);
  }
  check_room(recipe.cell, mix.bodies, 0.0);
}

// Bodies that are turned may come to lie along any axis; of what meets too many images of itself
// there no method would see an end.
void refuse_too_long(const Recipe& recipe, const InclusionMix& mix,
                     const std::vector<bool>& turned) {
  std::vector<std::int64_t> count(recipe.groups.size());  // of the bodies of each group so far
  for (const OrderedBody& ordered : mix.bodies) {
    const auto g = static_cast<std::size_t>(ordered.group);
    const double reach = circum_radius(ordered.body);
    const auto why = why_too_many_own_images(recipe.cell, {reach, reach, reach});
    if (turned[g] && why) {
      throw InvalidGroup(
          "", ordered.group, GroupField::size, "",
          "inclusion " + std::to_string(count[g]) + " cannot stand in the cell: " + *why);
    }
    ++count[g];
  }
}

void refuse_too_large_gap(const Recipe& recipe, const std::vector<OrderedBody>& bodies) {
  if (recipe.min_gap == 0.0) return;
  try {
    check_room(recipe.cell, bodies, recipe.min_gap);
  } catch (const InvalidGroup& problem) {
    throw InvalidArgument(place_of(recipe, {"packing.min_gap"}) + problem.why());
  }
}

// Bodies of which little more than the gaps between them is left.
std::vector<OrderedBody> nearly_points(std::vector<OrderedBody> bodies) {
  constexpr double kTiny = 1e-6;
  for (OrderedBody& b : bodies) b.body = scaled(b.body, kTiny);
  return bodies;
}

}  // namespace

std::string complaint(const Recipe& recipe, const InvalidGroup& problem) {
  if (recipe.places.empty()) return place_of(recipe, {}) + problem.what();
  const std::string group = "inclusions[" + std::to_string(problem.group()) + "]";
  std::vector<std::string> keys;
  // What a size follows from may stand in its place.
  for (const GroupField field : {problem.field(), GroupField::fraction, GroupField::count}) {
    if (field != GroupField::group) keys.push_back(group + "." + std::string(name(field)));
    if (problem.field() == GroupField::group) break;
  }
  keys.push_back(group);
  return place_of(recipe, keys) + problem.why();
}

std::vector<std::string> group_names(const Recipe& recipe) {
  std::vector<std::string> names;
  for (const InclusionGroup& group : recipe.groups) names.push_back(group.name);
  return names;
}

std::vector<bool> redrawn_groups(const Recipe& recipe) {
  std::vector<bool> redrawn;
  if (!recipe.rsa.redraw_orientations) return redrawn;
  for (const InclusionGroup& group : recipe.groups) {
    const bool random = std::holds_alternative<RandomOrientation>(group.orientation);
    redrawn.push_back(random && !is_round(group.shape));
  }
  return redrawn;
}

double saturating_radius(const Recipe& recipe) {
  if (recipe.groups.size() != 1) return 0.0;
  const InclusionGroup& group = recipe.groups.front();
  const bool open = !group.count && !group.fraction;
  if (!open || !is_round(group.shape) || !is_constant(group.size)) return 0.0;
  return circum_radius(draw_open_group(recipe.cell, group, 0, 0, 1, recipe.seed).front().body);
}

std::vector<bool> fixed_orientations(const Recipe& recipe) {
  const Rotation rotate = recipe.event_driven.rotate;
  std::vector<bool> fixed;
  if (rotate == Rotation::all) return fixed;
  for (const InclusionGroup& group : recipe.groups) {
    fixed.push_back(rotate == Rotation::none ||
                    !std::holds_alternative<RandomOrientation>(group.orientation));
  }
  return fixed;
}

std::vector<bool> turned_groups(const Recipe& recipe, PackMethod method) {
  if (method == PackMethod::rsa) return redrawn_groups(recipe);
  std::vector<bool> fixed;
  if (method == PackMethod::event_driven) fixed = fixed_orientations(recipe);
  if (is_constructive(method)) fixed.assign(recipe.groups.size(), true);
  const bool locked = recipe.relaxation.rotate == RelaxationTurn::locked;
  if (method == PackMethod::relaxation && locked) fixed.assign(recipe.groups.size(), true);
  std::vector<bool> turned;
  for (std::size_t g = 0; g < recipe.groups.size(); ++g) {
    turned.push_back(!is_round(recipe.groups[g].shape) && (fixed.empty() || !fixed[g]));
  }
  return turned;
}

bool is_constructive(PackMethod method) {
  return method == PackMethod::advancing_layer || method == PackMethod::drop_and_roll ||
         method == PackMethod::published_advancing_layer;
}

bool is_any_size(const Recipe& recipe, PackMethod method) {
  if (method == PackMethod::relaxation) return recipe.relaxation.goal == RelaxationGoal::densest;
  return method == PackMethod::event_driven && recipe.event_driven.goal == EventDrivenGoal::densest;
}

InclusionMix draw_mix(const Recipe& recipe) {
  return for_recipe(recipe, [&] {
    return draw_inclusions(recipe.cell, recipe.groups, recipe.seed, limit_of_machine());
  });
}

void refuse_impossible(const Recipe& recipe, const InclusionMix& mix, PackMethod method) {
  if (is_any_size(recipe, method)) return refuse_too_large_gap(recipe, nearly_points(mix.bodies));
  for_recipe(recipe, [&] {
    const std::vector<bool> turned = turned_groups(recipe, method);
    refuse_unplaceable(recipe, mix, turned);
    refuse_too_many_to_fill(recipe);
    if (method != PackMethod::rsa) refuse_too_long(recipe, mix, turned);
  });
  refuse_too_large_gap(recipe, mix.bodies);
}

}  // namespace packstone::recipe
