#include <catch2/catch.hpp>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/recipe/recipe.hpp"

using namespace packstone;

namespace {

const std::string kText = R"([cell]
size = [1, 1, 1]
[[inclusions]]
name = "fibers"
shape = "cylinder"
aspect = 5
count = 10
fraction = 0.1
[[inclusions]]
name = "round beads"
shape = "sphere"
count = 10
fraction = 0.1
)";

Recipe with(const std::vector<Override>& overrides) {
  return recipe_from_toml(kText, "r.toml", overrides);
}

std::string message_of(const Override& text) {
  try {
    std::ignore = with({text});
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("an override sets a key by its path, tables on the way are made") {
  CHECK(with({"packing.seed=7"}).seed == 7);
  CHECK(with({"packing.rsa.max_trials = 5"}).rsa.max_trials == 5);
  CHECK(with({"packing.min_gap=0.5", "packing.min_gap=0.25"}).min_gap == 0.25);
  CHECK(with({"cell.size=[2,3,4]"}).cell.size == Vec3{2, 3, 4});
  CHECK(with({"cell.size[1]=3"}).cell.size == Vec3{1, 3, 1});
  CHECK(with({"cell.periodic=false"}).cell.periodic == std::array{false, false, false});
}

TEST_CASE("an override finds a group by name or number") {
  CHECK(with({"inclusions.fibers.count=20"}).groups[0].count == 20);
  CHECK(with({"inclusions[0].fraction=0.2"}).groups[0].fraction == 0.2);
  CHECK(with({"inclusions.\"round beads\".count=30"}).groups[1].count == 30);
  const auto law = with({"inclusions[1].size={ uniform = [1, 2] }"}).groups[1].size.law;
  CHECK(std::get<UniformLaw>(law).hi == 2.0);
  const Recipe turned = with({"inclusions.fibers.orientation={ axis = [1, 0, 0] }"});
  CHECK(std::get<AlignedOrientation>(turned.groups[0].orientation).axis == Vec3{1, 0, 0});
}

TEST_CASE("a word or phrase without quotes stands for a string, as shells take the quotes off") {
  CHECK(with({"packing.method=rsa"}).method == PackMethod::rsa);
  CHECK(with({"packing.time_limit=10 min"}).time_limit == 600.0);
  CHECK(with({"packing.time_limit=\"10 min\""}).time_limit == 600.0);
  CHECK(with({"packing.rsa.order=largest-first"}).rsa.order == RsaOrder::largest_first);
}

TEST_CASE("a mistake in an override names the override") {
  CHECK(message_of("packing.seed=-1") ==
        "--set packing.seed=-1: packing.seed = -1; allowed is an integer >= 0");
  CHECK_THAT(message_of("packing.sed=1"), Catch::StartsWith("--set packing.sed=1: ") &&
                                              Catch::Contains("did you mean \"seed\"?"));
  CHECK_THAT(message_of("inclusions.fibres.count=1"),
             Catch::Contains("no group \"fibres\"; groups: \"fibers\", \"round beads\""));
  CHECK_THAT(message_of("inclusions[2].count=1"), Catch::Contains("no item [2]; the list has 2"));
  CHECK_THAT(message_of("cell.size[3]=1"), Catch::Contains("no item [3]; the list has 3"));
  CHECK_THAT(message_of("inclusions.fibers=3"), Catch::Contains("key by key"));
  CHECK_THAT(message_of("cell.size.x=1"), Catch::Contains("--set cell.size.x=1"));
  CHECK_THAT(message_of("packing.seed[0]=1"), Catch::Contains("--set packing.seed[0]=1"));
  CHECK_THAT(message_of("cell.size=[1,"), Catch::Contains("the value is not TOML"));
  CHECK_THAT(message_of("cell.size=1\nx=2"), Catch::Contains("the value is not TOML"));
  for (const char* text : {"seed", "=3", ".=3", "a..b=3", "a.=3", "a[x]=3", "a[1=3", "\"a=3", ""}) {
    CAPTURE(text);
    CHECK_THAT(message_of(text), Catch::StartsWith("--set ") && Catch::Contains("key=value"));
  }
}

TEST_CASE("an override repairs a recipe that is wrong without it") {
  CHECK_THROWS_AS(
      recipe_from_toml("[cell]\nsize = [1, 1, 1]\n[[inclusions]]\nshape = \"sphere\"\n", "r.toml"),
      InvalidArgument);
  CHECK_NOTHROW(recipe_from_toml("[cell]\nsize = [1, 1, 1]\n[[inclusions]]\nshape = \"sphere\"\n",
                                 "r.toml", {"inclusions[0].radius=0.1"}));
}
