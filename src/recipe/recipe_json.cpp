#include <nlohmann/json.hpp>

#include "packstone/core/overloaded.hpp"
#include "packstone/recipe/recipe.hpp"
#include "recipe/packing_words.hpp"
#include "recipe/read_distribution.hpp"

namespace packstone {
namespace {

using Json = nlohmann::ordered_json;

template <class Law>
void add_bounds(Json& table, const Law& law) {
  if (law.min > Law{}.min) table["min"] = law.min;
  if (law.max < recipe::kNoBound) table["max"] = law.max;
}

Json law_json(const Distribution& law);

Json mixture_json(const MixtureLaw& mixture) {
  Json parts = Json::array();
  for (std::size_t i = 0; i < mixture.parts.size(); ++i) {
    Json part{{"weight", mixture.weights[i]}};
    part.update(law_json(mixture.parts[i]));
    parts.push_back(std::move(part));
  }
  return parts;
}

// { "uniform": [lo, hi] } and its kin.
Json law_json(const Distribution& law) {
  Json text = Json::object();
  std::visit(Overloaded{[&](const ConstantLaw& l) { text["value"] = l.value; },
                        [&](const UniformLaw& l) {
                          text["uniform"] = {l.lo, l.hi};
                        },
                        [&](const NormalLaw& l) {
                          text["normal"] = {{"mean", l.mean}, {"std", l.std}};
                          add_bounds(text["normal"], l);
                        },
                        [&](const LognormalLaw& l) {
                          text["lognormal"] = {{"mu", l.mu}, {"sigma", l.sigma}};
                          add_bounds(text["lognormal"], l);
                        },
                        [&](const WeibullLaw& l) {
                          text["weibull"] = {{"shape", l.shape}, {"scale", l.scale}};
                          add_bounds(text["weibull"], l);
                        },
                        [&](const TableLaw& l) {
                          text["table"] = {{"values", l.values}, {"weights", l.weights}};
                        },
                        [&](const MixtureLaw& l) { text["mixture"] = mixture_json(l); }},
             law.law);
  return text;
}

// A number where the law is constant, a table otherwise.
Json distribution_json(const Distribution& law) {
  const bool by_volume = law.by == Weighting::volume;
  const auto* const constant = std::get_if<ConstantLaw>(&law.law);
  if (constant != nullptr && !by_volume) return constant->value;
  Json text = law_json(law);
  if (by_volume) text["by"] = "volume";
  return text;
}

Json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }

Json tensor_json(const SymMat3& t, bool plane) {
  if (plane) return Json::array({Json{t.xx, t.xy}, Json{t.xy, t.yy}});
  return Json::array({Json{t.xx, t.xy, t.xz}, Json{t.xy, t.yy, t.yz}, Json{t.xz, t.yz, t.zz}});
}

Json orientation_json(const OrientationLaw& law, bool plane) {
  return std::visit(Overloaded{[](const RandomOrientation&) -> Json { return "random"; },
                               [&](const AlignedOrientation& l) -> Json {
                                 const Json plane_axis = Json::array({l.axis.x, l.axis.y});
                                 return {{"axis", plane ? plane_axis : vector_json(l.axis)}};
                               },
                               [](const PlanarOrientation& l) -> Json {
                                 return {{"planar", {{"normal", vector_json(l.normal)}}}};
                               },
                               [&](const TensorOrientation& l) -> Json {
                                 const bool bingham = l.family == TensorFamily::bingham;
                                 return {{"tensor", tensor_json(l.tensor, plane)},
                                         {"family", bingham ? "bingham" : "acg"}};
                               },
                               [](const AngleOrientation& l) -> Json {
                                 return {{"degrees", distribution_json(l.degrees)}};
                               }},
                    law);
}

void add_dimensions(Json& text, ShapeKind shape, const Vec3& d) {
  if (shape == ShapeKind::ellipsoid) {
    text["semi_axes"] = vector_json(d);
  } else if (shape == ShapeKind::ellipse) {
    text["semi_axes"] = {d.x, d.y};
  } else {
    text["radius"] = d.x;
    text["half_length"] = d.y;
  }
}

std::string size_key(const InclusionGroup& group) {
  switch (group.measure) {
    case SizeMeasure::volume:
      return dimension(group.shape) == 2 ? "area" : "volume";
    case SizeMeasure::radius:
      return "radius";
    case SizeMeasure::half_length:
      return "half_length";
    default:
      return "size";
  }
}

void add_size(Json& text, const InclusionGroup& group) {
  if (group.dimensions) return add_dimensions(text, group.shape, *group.dimensions);
  if (!is_round(group.shape)) {
    const bool pair = group.shape == ShapeKind::ellipsoid && !group.spheroid;
    const Json first = distribution_json(group.aspect);
    text["aspect"] = pair ? Json::array({first, distribution_json(group.aspect_second)}) : first;
  }
  text[size_key(group)] = distribution_json(group.size);
}

Json group_json(const InclusionGroup& group) {
  Json text{{"name", group.name}, {"shape", std::string(name(group.shape))}};
  if (group.count) text["count"] = *group.count;
  if (group.fraction) text["fraction"] = *group.fraction;
  add_size(text, group);
  if (is_round(group.shape)) return text;
  text["orientation"] = orientation_json(group.orientation, dimension(group.shape) == 2);
  return text;
}

Json cell_json(const Cell& cell) {
  Json size = Json::array();
  Json periodic = Json::array();
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    size.push_back(cell.size[axis]);
    periodic.push_back(cell.periodic[axis]);
  }
  return {{"size", size}, {"periodic", periodic}};
}

template <class T>
std::string word_for(const recipe::Words<T>& words, T value) {
  return std::string(recipe::word_for(words, value));
}

Json rsa_json(const RsaSettings& rsa) {
  return {{"order", word_for(recipe::kRsaOrders, rsa.order)},
          {"redraw_orientations", rsa.redraw_orientations},
          {"max_trials", rsa.max_trials},
          {"max_restarts", rsa.max_restarts}};
}

Json event_driven_json(const EventDrivenSettings& settings) {
  Json text{{"goal", word_for(recipe::kGoals, settings.goal)},
            {"growth_rate", settings.growth_rate},
            {"slowest_growth", settings.slowest_growth},
            {"rotate", settings.rotate == Rotation::all},
            {"collisions_per_body", settings.collisions_per_body},
            {"published_stagnation", settings.published_stagnation},
            {"check_every_event", settings.check_every_event},
            {"start", word_for(recipe::kGrowthStarts, settings.start)}};
  if (settings.rotate == Rotation::automatic) text["rotate"] = "auto";
  if (settings.start_fraction) text["start_fraction"] = *settings.start_fraction;
  return text;
}

Json relaxation_json(const RelaxationSettings& settings) {
  Json text{{"goal", word_for(recipe::kRelaxationGoals, settings.goal)},
            {"rotate", word_for(recipe::kRelaxationTurns, settings.rotate)},
            {"inflation", settings.inflation},
            {"patience", settings.patience},
            {"relocated_share", settings.relocated_share},
            {"max_relocations", settings.max_relocations},
            {"max_restarts", settings.max_restarts},
            {"start", word_for(recipe::kRelaxationStarts, settings.start)},
            {"first_step", settings.first_step},
            {"least_step", settings.least_step}};
  if (settings.start_fraction) text["start_fraction"] = *settings.start_fraction;
  return text;
}

Json time_driven_json(const TimeDrivenOptions& options) {
  return {{"literal", options.literal},
          {"integrator", word_for(recipe::kIntegrators, options.integrator)},
          {"time_step", options.time_step},
          {"damping", options.damping},
          {"berendsen", options.berendsen},
          {"berendsen_temperature", options.berendsen_temperature},
          {"nose_hoover", options.nose_hoover},
          {"nose_hoover_temperature", options.nose_hoover_temperature},
          {"stagnation_steps", options.stagnation_steps},
          {"stagnation_drop", options.stagnation_drop},
          {"reshuffles", options.reshuffles},
          {"reshuffle_steps", options.reshuffle_steps},
          {"rescale", options.rescale},
          {"rescale_limit", options.rescale_limit},
          {"energy_threshold", options.energy_threshold},
          {"max_steps", options.max_steps},
          {"history_every", options.history_every},
          {"overlap_volume_every", options.overlap_volume_every},
          {"overlap_points", options.overlap_points}};
}

Json advancing_layer_json(const AdvancingLayerSettings& settings) {
  Json text{{"top_layer", settings.top_layer},
            {"close_top", settings.close_top},
            {"max_restarts", settings.max_restarts}};
  if (settings.candidates) text["candidates"] = *settings.candidates;
  if (settings.held_back) text["held_back"] = *settings.held_back;
  return text;
}

Json packing_json(const Recipe& recipe) {
  Json text{{"method", std::string(name(recipe.method))},
            {"min_gap", recipe.min_gap},
            {"seed", recipe.seed}};
  if (recipe.time_limit) text["time_limit"] = *recipe.time_limit;
  text["rsa"] = rsa_json(recipe.rsa);
  text["event-driven"] = event_driven_json(recipe.event_driven);
  text["relaxation"] = relaxation_json(recipe.relaxation);
  text["time-driven"] = time_driven_json(recipe.time_driven);
  text["advancing-layer"] = advancing_layer_json(recipe.advancing_layer);
  text["drop-and-roll"] = {{"drops", recipe.drop_and_roll.drops}};
  text["published-advancing-layer"] = {{"spacing", recipe.published_advancing_layer.spacing},
                                       {"top_layer", recipe.published_advancing_layer.top_layer}};
  return text;
}

}  // namespace

std::string recipe_to_json(const Recipe& recipe) {
  Json text;
  text["cell"] = cell_json(recipe.cell);
  text["inclusions"] = Json::array();
  for (const InclusionGroup& group : recipe.groups) text["inclusions"].push_back(group_json(group));
  text["packing"] = packing_json(recipe);
  return text.dump();
}

}  // namespace packstone
