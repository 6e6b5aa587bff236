#pragma once

/// @file
/// Recipe: what is ordered, as plain data, and its reading from TOML.
///
/// docs/recipe.md lists every key with its unit, default and range.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/generate/advancing_layer.hpp"
#include "packstone/generate/drop_and_roll.hpp"
#include "packstone/generate/event_driven.hpp"
#include "packstone/generate/published_advancing_layer.hpp"
#include "packstone/generate/published_time_driven.hpp"
#include "packstone/generate/relaxation.hpp"
#include "packstone/generate/relaxed_growth.hpp"
#include "packstone/generate/rsa.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/packing.hpp"

namespace packstone {

/// Who places the inclusions.
enum class PackMethod {
  automatic,        ///< pack() chooses and says which and why.
  rsa,              ///< Random sequential adsorption, rsa.hpp.
  event_driven,     ///< Molecular dynamics of bodies that collide and grow, event_driven.hpp.
  relaxation,       ///< Bodies that overlap push each other apart, relaxation.hpp.
  time_driven,      ///< The published relaxation, to compare with, published_time_driven.hpp.
  advancing_layer,  ///< Each where it comes to lie lowest, advancing_layer.hpp.
  drop_and_roll,    ///< Dropped and rolling, to compare with, drop_and_roll.hpp.
  /// The published advancing layers, to compare with, published_advancing_layer.hpp.
  published_advancing_layer,
};

/// "auto", "rsa", "event-driven", "relaxation", "time-driven", "advancing-layer", "drop-and-roll",
/// "published-advancing-layer": the word used in recipes.
[[nodiscard]] std::string_view name(PackMethod method) noexcept;

/// `[packing.rsa]`: the fields of RsaOptions that a recipe may set.
struct RsaSettings {
  RsaOrder order = RsaOrder::largest_first;
  /// true: the orientations of every group whose law is random are redrawn with each trial.
  bool redraw_orientations = false;
  std::int64_t max_trials = RsaOptions{}.max_trials;      ///< >= 1.
  std::int64_t max_restarts = RsaOptions{}.max_restarts;  ///< >= 0.
};

/// Whose orientations the dynamics may change.
enum class Rotation {
  automatic,  ///< Of the groups whose law is random; the others keep what was drawn.
  all,        ///< Of all groups.
  none,       ///< Of none.
};

/// Where the bodies of event-driven dynamics grow from.
enum class GrowthStart {
  points,  ///< Points at random places.
  rsa,     ///< Smaller bodies that random sequential adsorption has placed.
};

/// `[packing.event-driven]`: the fields of EventDrivenOptions that a recipe may set, and where the
/// bodies start.
struct EventDrivenSettings {
  EventDrivenGoal goal = EventDrivenGoal::target;
  double growth_rate = EventDrivenOptions{}.growth_rate;        ///< In (0, 10].
  double slowest_growth = EventDrivenOptions{}.slowest_growth;  ///< In (0, growth_rate].
  Rotation rotate = Rotation::automatic;
  double collisions_per_body = EventDrivenOptions{}.collisions_per_body;  ///< > 0.
  bool published_stagnation = false;
  bool check_every_event = false;
  GrowthStart start = GrowthStart::points;
  /// start = rsa: the volume fraction at which the bodies begin to grow [-], in (0, 1). Absent:
  /// 0.2, or less where random sequential adsorption does not surely reach that.
  std::optional<double> start_fraction;
};

/// What a relaxation is to reach.
enum class RelaxationGoal {
  target,   ///< The sizes ordered.
  densest,  ///< Sizes all scaled by one factor, as large as they come to rest.
};

/// Where the bodies of a relaxation are first.
enum class RelaxationFrom {
  rsa,     ///< Where random sequential adsorption has placed them at a smaller size.
  random,  ///< Anywhere.
};

/// `[packing.relaxation]`: the fields of RelaxationOptions and RelaxedGrowthOptions that a recipe
/// may set, and where the bodies start.
struct RelaxationSettings {
  RelaxationGoal goal = RelaxationGoal::target;
  RelaxationTurn rotate = RelaxationTurn::hold_tensor;                 ///< Of all groups.
  double inflation = RelaxationOptions{}.inflation;                    ///< In (0, 0.1].
  std::int64_t patience = RelaxationOptions{}.patience;                ///< >= 1.
  double relocated_share = RelaxationOptions{}.relocated_share;        ///< In [0, 1].
  std::int64_t max_relocations = RelaxationOptions{}.max_relocations;  ///< >= 0.
  std::int64_t max_restarts = RelaxationOptions{}.max_restarts;        ///< >= 0.
  RelaxationFrom start = RelaxationFrom::rsa;
  /// start = rsa: the volume fraction of the bodies placed first [-], in (0, 1). Absent: what
  /// random sequential adsorption surely reaches.
  std::optional<double> start_fraction;
  double first_step = RelaxedGrowthOptions{}.first_step;  ///< goal = densest: in (0, 1].
  double least_step = RelaxedGrowthOptions{}.least_step;  ///< goal = densest: in (0, first_step].
};

/// `[packing.advancing-layer]`: the fields of AdvancingLayerOptions that a recipe may set.
struct AdvancingLayerSettings {
  double top_layer = AdvancingLayerOptions{}.top_layer;  ///< >= 2.
  std::optional<int> candidates = {};                    ///< >= 1.
  std::optional<double> held_back = {};                  ///< In [0, 1].
  bool close_top = AdvancingLayerOptions{}.close_top;
  std::int64_t max_restarts = AdvancingLayerOptions{}.max_restarts;  ///< >= 0.
};

/// `[packing.drop-and-roll]`.
struct DropAndRollSettings {
  int drops = DropAndRollOptions{}.drops;  ///< In [1, 10000].
};

/// `[packing.published-advancing-layer]`.
struct PublishedLayerSettings {
  double spacing = PublishedLayerOptions{}.spacing;      ///< In [0.01, 1].
  double top_layer = PublishedLayerOptions{}.top_layer;  ///< > 0.
};

/// Everything that a packing is made from. The same recipe and seed give the same packing.
struct Recipe {
  std::string origin;  ///< The file it was read from; stands in messages. May be empty.
  Cell cell;
  std::vector<InclusionGroup> groups;  ///< At least one; names differ.
  PackMethod method = PackMethod::automatic;
  double min_gap = 0.0;              ///< Least gap between any two inclusions [L]. >= 0.
  std::uint64_t seed = 1;            ///< Key of every random stream. A file holds up to 2^63 - 1.
  std::optional<double> time_limit;  ///< Then keep what is valid [s]. > 0; absent: none.
  RsaSettings rsa;
  EventDrivenSettings event_driven;
  RelaxationSettings relaxation;
  TimeDrivenOptions time_driven;  ///< `[packing.time-driven]`, its seed apart.
  AdvancingLayerSettings advancing_layer;
  DropAndRollSettings drop_and_roll;
  PublishedLayerSettings published_advancing_layer;
  /// Where what was ordered stands, for messages: by key ("inclusions[0].count", "packing.min_gap",
  /// "packing.method") the words "fibers.toml:7: inclusions[0].count = 20". The size of a group
  /// stands under "inclusions[0].size", whichever key gives it. Empty for a recipe that was not
  /// read.
  std::map<std::string, std::string> places;
};

/// Changes a recipe before it is read: "packing.seed=7", "inclusions.fibers.count=20",
/// "inclusions[0].fraction=0.1", "cell.size=[2, 2, 2]". The value is TOML; a bare word or phrase
/// stands for a string.
using Override = std::string;

/// The seconds of "30 s", "10 min", "1.5 h" or "90" (seconds), blanks optional; nothing for
/// anything else, or for a time that is not > 0.
[[nodiscard]] std::optional<double> seconds_in(std::string_view text);

/// Reads a `.toml` recipe; or from a `.json` or `.h5` packing the recipe that made it; or a `.json`
/// recipe as recipe_to_json() writes it.
///
/// Errors:  throws FileError when the file cannot be read, InvalidArgument with one line per
///          mistake, all mistakes at once: file, line, key, value and allowed range.
[[nodiscard]] Recipe read_recipe(const std::filesystem::path& path,
                                 const std::vector<Override>& overrides = {});

/// Reads the TOML text of a recipe. `origin` stands for the file in messages; tables of a
/// distribution (`table = "sizes.csv"`) are looked for beside it. Errors as read_recipe().
[[nodiscard]] Recipe recipe_from_toml(std::string_view text, const std::string& origin,
                                      const std::vector<Override>& overrides = {});

/// Reads what recipe_to_json() wrote. Errors as read_recipe(), without lines.
[[nodiscard]] Recipe recipe_from_json(std::string_view text, const std::string& origin,
                                      const std::vector<Override>& overrides = {});

/// The recipe that a packing holds in its provenance. `origin` stands for its file in messages.
/// Errors as read_recipe(); InvalidArgument too when it holds none.
[[nodiscard]] Recipe recipe_of_packing(const Packing& packing, const std::string& origin,
                                       const std::vector<Override>& overrides = {});

/// The recipe as a JSON object with the keys of the TOML form, overrides applied and tables
/// included: recipe_from_json() gives the same recipe back, to the last bit.
[[nodiscard]] std::string recipe_to_json(const Recipe& recipe);

}  // namespace packstone
