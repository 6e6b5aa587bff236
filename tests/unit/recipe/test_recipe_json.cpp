#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/recipe/recipe.hpp"

using namespace packstone;

namespace {

// Everything a 3D recipe can hold.
const std::string kSpace = R"([cell]
size = [1, 2, 3]
periodic = [true, false, true]
[[inclusions]]
name = "a"
shape = "cylinder"
aspect = { mixture = [ { weight = 1, value = 2 }, { weight = 2, normal = { mean = 3, std = 0.1, min = 1 } } ] }
diameter = { lognormal = { mean = 0.1, std = 0.03, max = 0.3 }, by = "volume" }
count = 4
orientation = { tensor = [[0.6, 0.1, 0.01], [0.1, 0.3, 0.02], [0.01, 0.02, 0.1]], family = "bingham" }
[[inclusions]]
name = "b"
shape = "spherocylinder"
length = { weibull = { shape = 2, scale = 0.1, min = 0.01 } }
aspect = 3
fraction = 0.05
orientation = { axis = [1, 2, 3] }
[[inclusions]]
name = "c"
shape = "ellipsoid"
aspect = [2, { uniform = [1, 3] }]
volume = { table = { values = [0.01, 0.02], weights = [1, 3] } }
count = 2
orientation = { planar = { normal = [1, 1, 0] } }
[[inclusions]]
name = "d"
shape = "ellipsoid"
aspect = { uniform = [0.2, 0.4] }
count = 3
fraction = 0.01
[[inclusions]]
name = "e"
shape = "cylinder"
diameter = 0.1
length = 0.3
count = 1
[[inclusions]]
name = "f"
shape = "sphere"
radius = 0.02
[packing]
method = "rsa"
min_gap = 0.001
seed = 9223372036854775807
time_limit = "2 min"
[packing.rsa]
order = "group"
redraw_orientations = true
max_trials = 1000
max_restarts = 3
[packing.event-driven]
goal = "densest"
growth_rate = 0.0123
slowest_growth = 1e-6
rotate = false
collisions_per_body = 77.5
published_stagnation = true
check_every_event = true
start = "rsa"
start_fraction = 0.123
[packing.relaxation]
goal = "densest"
rotate = "free"
first_step = 0.0321
least_step = 1e-3
)";

const std::string kPlane = R"([cell]
size = [1, 2]
[[inclusions]]
shape = "ellipse"
aspect = 2
area = 0.01
count = 3
orientation = { degrees = { normal = { mean = 10, std = 3 } } }
[[inclusions]]
shape = "ellipse"
semi_axes = [0.1, 0.2]
count = 3
orientation = { axis = [1, 2] }
[[inclusions]]
shape = "ellipse"
aspect = 3
size = 0.1
fraction = 0.1
orientation = { tensor = [[0.7, 0.1], [0.1, 0.3]] }
[[inclusions]]
shape = "disk"
size = { uniform = [1, 2] }
count = 10
fraction = 0.1
)";

}  // namespace

TEST_CASE("a recipe written as JSON and read again is the same to the last bit") {
  for (const std::string& text : {kSpace, kPlane}) {
    const std::string written = recipe_to_json(recipe_from_toml(text, "r.toml"));
    const Recipe again = recipe_from_json(written, "r.json");
    CHECK(recipe_to_json(again) == written);
  }
}

TEST_CASE("lengths of one diameter are written as radius and aspect, and read back") {
  const std::string text =
      "[cell]\nsize = [1, 1, 1]\n[[inclusions]]\nshape = \"cylinder\"\ncount = 3\n"
      "diameter = 0.02\nlength = { uniform = [0.1, 0.3], by = \"volume\" }\n";
  const std::string written = recipe_to_json(recipe_from_toml(text, "r.toml"));
  CHECK(nlohmann::json::parse(written)["inclusions"][0]["aspect"]["by"] == "volume");
  CHECK(recipe_to_json(recipe_from_json(written, "r.json")) == written);
}

TEST_CASE("the JSON form holds what was read, with overrides applied") {
  const Recipe recipe =
      recipe_from_toml(kSpace, "r.toml", {"packing.seed=5", "inclusions.a.count=7"});
  const auto json = nlohmann::json::parse(recipe_to_json(recipe));
  CHECK(json["cell"]["periodic"] == nlohmann::json({true, false, true}));
  CHECK(json["packing"]["seed"] == 5);
  CHECK(json["packing"]["time_limit"] == 120.0);
  CHECK(json["packing"]["rsa"]["order"] == "group");
  CHECK(json["packing"]["event-driven"]["goal"] == "densest");
  CHECK(json["packing"]["event-driven"]["rotate"] == false);
  CHECK(json["packing"]["relaxation"]["goal"] == "densest");
  CHECK(json["packing"]["relaxation"]["first_step"] == 0.0321);
  CHECK(json["packing"]["relaxation"]["least_step"] == 1e-3);
  CHECK(json["inclusions"][0]["count"] == 7);
  CHECK(json["inclusions"][0]["radius"]["by"] == "volume");
  CHECK(json["inclusions"][4]["half_length"] == 0.15);
  CHECK_FALSE(json["inclusions"][5].contains("count"));
}

TEST_CASE("a JSON recipe is read with the same care as a TOML one") {
  CHECK_THROWS_WITH(recipe_from_json("[1, 2]", "r.json"), "r.json: not a JSON object");
  CHECK_THROWS_WITH(recipe_from_json("{", "r.json"), "r.json: not a JSON object");
  CHECK_THROWS_WITH(recipe_from_json(R"({"cell": {"size": [1, 1, 1]}, "inclusions": [
        {"shape": "sphere", "count": 3.5, "fraction": 0.1}]})",
                                     "r.json"),
                    "r.json: inclusions[0].count = 3.5; allowed is an integer >= 1");
}
