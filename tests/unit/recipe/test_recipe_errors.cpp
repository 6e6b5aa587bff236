#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/recipe/recipe.hpp"
#include "support/temporary_folder.hpp"

using namespace packstone;

namespace {

// A wrong recipe and what its message must say.
struct Wrong {
  std::string what;
  std::string text;
  std::vector<std::string> parts;
};

const std::string kCell = "[cell]\nsize = [1, 1, 1]\n";      // lines 1, 2
const std::string kFlat = "[cell]\nsize = [1, 1]\n";         // lines 1, 2
const std::string kGroup = "[[inclusions]]\n";               // line 3
const std::string kSphere = "shape = \"sphere\"\n";          // line 4
const std::string kRod = "shape = \"cylinder\"\n";           // line 4
const std::string kBoth = "count = 3\nfraction = 0.1\n";     // two lines more
const std::string kFine = kCell + kGroup + kSphere + kBoth;  // six lines

std::string message_of(const std::string& text) {
  try {
    std::ignore = recipe_from_toml(text, "bad.toml");
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "accepted";
}

std::string spheres(const std::string& line) { return kCell + kGroup + kSphere + line; }
std::string rods(const std::string& line) { return kCell + kGroup + kRod + line; }

std::vector<Wrong> wrong_recipes() {
  return {
      {"not TOML", "[cell]\nsize = [1, 1\n", {"bad.toml:", "column", "not TOML"}},
      {"a key twice", "[cell]\nsize = [1, 1]\nsize = [2, 2]\n", {"bad.toml:3:", "not TOML"}},
      {"no cell", kGroup + kSphere + "radius = 0.1\n", {"bad.toml: [cell] is missing"}},
      {"cell is a number",
       "cell = 3\n" + kGroup + kSphere + "radius = 0.1\n",
       {"bad.toml:1: cell = 3; allowed is a table [cell]"}},
      {"no size",
       "[cell]\nperiodic = true\n" + kGroup + kSphere + "radius = 0.1\n",
       {"bad.toml:1: cell.size is missing; allowed is a list of 2 or 3 numbers"}},
      {"four edges",
       "[cell]\nsize = [1, 1, 1, 1]\n" + kGroup + kSphere + "radius = 0.1\n",
       {"bad.toml:2: cell.size = [1, 1, 1, 1]", "2 or 3"}},
      {"an edge of zero",
       "[cell]\nsize = [1, 0, 1]\n" + kGroup + kSphere + "radius = 0.1\n",
       {"bad.toml:2: cell.size[1] = 0; allowed is a number > 0"}},
      {"an infinite edge",
       "[cell]\nsize = [1, 1, inf]\n" + kGroup + kSphere + "radius = 0.1\n",
       {"bad.toml:2: cell.size[2] = inf; allowed is a number > 0"}},
      {"two flags in 3D",
       "[cell]\nsize = [1, 1, 1]\nperiodic = [true, false]\n" + kGroup + kSphere + "radius = 0.1\n",
       {"bad.toml:3: cell.periodic", "3 flags, one per axis"}},
      {"a flag that is none",
       "[cell]\nsize = [1, 1]\nperiodic = [true, 1]\n" + kGroup +
           "shape = \"disk\"\nradius = 0.1\n",
       {"bad.toml:3: cell.periodic[1] = 1; allowed is true or false"}},
      {"misspelled key in cell",
       "[cell]\nsize = [1, 1, 1]\nperiodc = true\n" + kGroup + kSphere + "radius = 0.1\n",
       {"bad.toml:3: unknown key \"cell.periodc\"; did you mean \"periodic\"?"}},
      {"misspelled table",
       kFine + "[packng]\nseed = 1\n",
       {"bad.toml:7: unknown key \"packng\"; did you mean \"packing\"?"}},
      {"right key, wrong table",
       kFine + "seed = 1\n",
       {"bad.toml:7: unknown key \"inclusions[0].seed\"; it belongs in [packing]"}},
      {"a key nothing is near to",
       kFine + "temperature = 1\n",
       {"bad.toml:7: unknown key \"inclusions[0].temperature\"; known here: name, shape"}},
      {"no inclusions", kCell, {"bad.toml: [[inclusions]] is missing"}},
      {"inclusions as one table", kCell + "[inclusions]\n" + kSphere, {"[[inclusions]]"}},
      {"no shape",
       kCell + kGroup + "radius = 0.1\n",
       {"bad.toml:3: inclusions[0].shape is missing; allowed is one of \"sphere\""}},
      {"a shape there is not",
       kCell + kGroup + "shape = \"cube\"\n",
       {"bad.toml:4: inclusions[0].shape = \"cube\"; allowed is one of \"sphere\", \"ellipsoid\""}},
      {"a disk in 3D",
       kCell + kGroup + "shape = \"disk\"\nradius = 0.1\n",
       {"bad.toml:4: inclusions[0].shape = \"disk\"; allowed is one of \"sphere\""}},
      {"a sphere in 2D",
       kFlat + kGroup + kSphere + "radius = 0.1\n",
       {"bad.toml:4: inclusions[0].shape = \"sphere\"; allowed is one of \"disk\", \"ellipse\""}},
      {"an empty name",
       kFine + "name = \"\"\n",
       {"bad.toml:7: inclusions[0].name = \"\"", "empty"}},
      {"a name twice",
       kFine + "name = \"a\"\n[[inclusions]]\nname = \"a\"\n" + kSphere +
           "count = 1\nradius = 0.1\n",
       {"bad.toml:9: inclusions[1].name = \"a\"; allowed is a name that no other group has"}},
      {"count of zero",
       spheres("count = 0\nradius = 0.1\n"),
       {"bad.toml:5: inclusions[0].count = 0; allowed is an integer >= 1"}},
      {"count that is no integer",
       spheres("count = 2.5\nradius = 0.1\n"),
       {"bad.toml:5: inclusions[0].count = 2.5; allowed is an integer >= 1"}},
      {"fraction of one",
       spheres("count = 5\nfraction = 1.0\n"),
       {"bad.toml:6: inclusions[0].fraction = 1.0; allowed is a number > 0 and < 1"}},
      {"fraction in words",
       spheres("count = 5\nfraction = \"half\"\n"),
       {"bad.toml:6: inclusions[0].fraction = \"half\"; allowed is a number > 0 and < 1"}},
      {"fractions above one together",
       spheres("count = 5\nfraction = 0.6\n[[inclusions]]\n" + kSphere +
               "count = 5\nfraction = 0.5\n"),
       {"bad.toml:7: inclusions[1].fraction makes the fractions sum to 1.1", "< 1"}},
      {"count alone",
       spheres("count = 5\n"),
       {"bad.toml:3: inclusions[0] needs two of count, fraction and a size (radius, diameter",
        "only count is given"}},
      {"fraction alone", spheres("fraction = 0.2\n"), {"bad.toml:3:", "only fraction is given"}},
      {"nothing ordered", spheres(""), {"bad.toml:3:", "none is given"}},
      {"all three",
       spheres(kBoth + "radius = 0.1\n"),
       {"bad.toml:7: inclusions[0].radius is too much: count and fraction already fix the size"}},
      {"two sizes",
       spheres("count = 3\nradius = 0.1\ndiameter = 0.2\n"),
       {"inclusions[0].diameter is too much: radius already gives the size"}},
      {"a size of another shape",
       spheres("count = 3\nlength = 0.1\n"),
       {"bad.toml:6: inclusions[0].length does not belong to a sphere; its size keys are radius, "
        "diameter, volume, size"}},
      {"a negative radius",
       spheres("count = 3\nradius = -0.1\n"),
       {"bad.toml:6: inclusions[0].radius = -0.1; allowed is a number > 0"}},
      {"a radius that is not a number",
       spheres("count = 3\nradius = nan\n"),
       {"bad.toml:6: inclusions[0].radius = nan; allowed is a number > 0"}},
      {"a radius in words",
       spheres("count = 3\nradius = \"big\"\n"),
       {"bad.toml:6: inclusions[0].radius = \"big\"; allowed is a number, { uniform"}},
      {"aspect missing",
       rods(kBoth),
       {"bad.toml:3: inclusions[0].aspect is missing; a cylinder needs its length / diameter"}},
      {"aspect of a sphere",
       kFine + "aspect = 2\n",
       {"bad.toml:7: inclusions[0].aspect is too much: a sphere has none"}},
      {"aspect beside both sizes",
       rods("count = 3\ndiameter = 0.1\nlength = 0.2\naspect = 2\n"),
       {"bad.toml:8: inclusions[0].aspect is too much: the size keys already give it"}},
      {"a law beside another size",
       rods("count = 3\ndiameter = { uniform = [1, 2] }\nlength = 0.2\n"),
       {"bad.toml:6: inclusions[0].diameter", "give one of them and aspect"}},
      {"a length by volume where caps count too",
       kCell + kGroup +
           "shape = \"spherocylinder\"\ncount = 3\ndiameter = 0.1\n"
           "length = { uniform = [1, 2], by = \"volume\" }\n",
       {"bad.toml:7: inclusions[0].length.by = \"volume\"; allowed is \"number\""}},
      {"lengths beyond all diameters",
       rods("count = 3\ndiameter = 1e-300\nlength = { uniform = [1, 1e300] }\n"),
       {"bad.toml:7: inclusions[0].length", "over the diameter are finite"}},
      {"a triple aspect",
       kCell + kGroup + "shape = \"ellipsoid\"\naspect = [1, 2, 3]\n" + kBoth,
       {"bad.toml:5: inclusions[0].aspect = [1, 2, 3]", "a pair [a/b, a/c]"}},
      {"two semi-axes",
       kCell + kGroup + "shape = \"ellipsoid\"\nsemi_axes = [1, 2]\ncount = 1\n",
       {"bad.toml:5: inclusions[0].semi_axes = [1, 2]; allowed is a list of 3 numbers"}},
      {"an empty law",
       spheres("count = 3\nradius = {}\n"),
       {"bad.toml:6: inclusions[0].radius", "one law"}},
      {"two laws",
       spheres("count = 3\nradius = { value = 1, uniform = [1, 2] }\n"),
       {"bad.toml:6: inclusions[0].radius", "one law"}},
      {"a misspelled law",
       spheres("count = 3\nradius = { unifrom = [1, 2] }\n"),
       {"unknown key \"inclusions[0].radius.unifrom\"; did you mean \"uniform\"?"}},
      {"uniform the wrong way round",
       spheres("count = 3\nradius = { uniform = [2, 1] }\n"),
       {"inclusions[0].radius.uniform = [2, 1]; allowed is [lo, hi] with lo <= hi"}},
      {"uniform from zero",
       spheres("count = 3\nradius = { uniform = [0, 1] }\n"),
       {"inclusions[0].radius.uniform[0] = 0; allowed is a number > 0"}},
      {"normal below zero",
       spheres("count = 3\nradius = { normal = { mean = 1, std = 1 } }\n"),
       {"bad.toml:6: inclusions[0].radius", "give it a min > 0"}},
      {"normal without std",
       spheres("count = 3\nradius = { normal = { mean = 1 } }\n"),
       {"inclusions[0].radius.normal.std is missing; allowed is a number >= 0"}},
      {"min above max",
       spheres("count = 3\nradius = { lognormal = { mean = 1, std = 1, min = 3, max = 2 } }\n"),
       {"inclusions[0].radius.lognormal.max = 2; allowed is min < max, here min = 3"}},
      {"both pairs of parameters",
       spheres("count = 3\nradius = { lognormal = { mean = 1, std = 1, mu = 1 } }\n"),
       {"inclusions[0].radius.lognormal", "either mean and std, or mu and sigma"}},
      {"weibull of no shape",
       spheres("count = 3\nradius = { weibull = { shape = 0, scale = 1 } }\n"),
       {"inclusions[0].radius.weibull.shape = 0; allowed is a number > 0"}},
      {"a part without weight",
       spheres("count = 3\nradius = { mixture = [ { value = 1 } ] }\n"),
       {"inclusions[0].radius.mixture[0].weight is missing"}},
      {"no part has weight",
       spheres("count = 3\nradius = { mixture = [ { weight = 0, value = 1 } ] }\n"),
       {"inclusions[0].radius.mixture", "sum to more than 0"}},
      {"a law without parameters",
       spheres("count = 3\nradius = { normal = 3 }\n"),
       {"bad.toml:6: inclusions[0].radius.normal = 3; allowed is a table such as { mean = 1"}},
      {"a width of zero outside the bounds",
       spheres("count = 3\nradius = { normal = { mean = 1, std = 0, min = 2, max = 3 } }\n"),
       {"bad.toml:6: inclusions[0].radius has the one value 1"}},
      {"a mixture of nothing",
       spheres("count = 3\nradius = { mixture = [] }\n"),
       {"inclusions[0].radius.mixture = []; allowed is a list of parts"}},
      {"a part that is a number",
       spheres("count = 3\nradius = { mixture = [3] }\n"),
       {"inclusions[0].radius.mixture[0] = 3; allowed is a part such as { weight"}},
      {"a table that is a number",
       spheres("count = 3\nradius = { table = 3 }\n"),
       {"inclusions[0].radius.table = 3; allowed is the name of a file"}},
      {"a table without weights",
       spheres("count = 3\nradius = { table = { values = [1] } }\n"),
       {"inclusions[0].radius.table.weights is missing; allowed is a list of numbers"}},
      {"a table of a negative size",
       spheres("count = 3\nradius = { table = { values = [1, -2], weights = [1, 1] } }\n"),
       {"inclusions[0].radius.table", "each a number > 0; value 2 is -2.0"}},
      {"a table without weight",
       spheres("count = 3\nradius = { table = { values = [1], weights = [0] } }\n"),
       {"inclusions[0].radius.table", "weights that sum to more than 0"}},
      {"a table that is not there",
       spheres("count = 3\nradius = { table = \"none.csv\" }\n"),
       {"bad.toml:6: inclusions[0].radius.table = \"none.csv\"; cannot read none.csv"}},
      {"a table out of step",
       spheres("count = 3\nradius = { table = { values = [1, 2], weights = [1] } }\n"),
       {"inclusions[0].radius.table.weights", "a list of 2 numbers"}},
      {"a law by mass",
       spheres(kBoth + "size = { uniform = [1, 2], by = \"mass\" }\n"),
       {"bad.toml:7: inclusions[0].size.by = \"mass\"; allowed is one of \"number\", \"volume\""}},
      {"an aspect by volume",
       rods(kBoth + "aspect = { uniform = [1, 2], by = \"volume\" }\n"),
       {"bad.toml:7: inclusions[0].aspect.by = \"volume\"; allowed is \"number\""}},
      {"a turned sphere",
       kFine + "orientation = \"random\"\n",
       {"bad.toml:7: inclusions[0].orientation is too much"}},
      {"an orientation there is not",
       rods(kBoth + "aspect = 2\norientation = \"isotropic\"\n"),
       {"bad.toml:8: inclusions[0].orientation = \"isotropic\"; allowed is \"random\", { axis"}},
      {"no direction",
       rods(kBoth + "aspect = 2\norientation = { axis = [0, 0, 0] }\n"),
       {"bad.toml:8: inclusions[0].orientation.axis", "a direction, not zero"}},
      {"a plane there is not",
       rods(kBoth + "aspect = 2\norientation = { planar = \"yx\" }\n"),
       {"inclusions[0].orientation.planar = \"yx\"; allowed is one of \"xy\", \"xz\", \"yz\""}},
      {"a plane without normal",
       rods(kBoth + "aspect = 2\norientation = { planar = {} }\n"),
       {"inclusions[0].orientation.planar.normal is missing; allowed is a direction"}},
      {"a tensor of two rows in 3D",
       rods(kBoth + "aspect = 2\norientation = { tensor = [[1, 0], [0, 0]] }\n"),
       {"inclusions[0].orientation.tensor", "three rows of three numbers"}},
      {"a tensor that is not symmetric",
       rods(kBoth + "aspect = 2\norientation = { tensor = [[1, 1, 0], [0, 0, 0], [0, 0, 0]] }\n"),
       {"bad.toml:8: inclusions[0].orientation.tensor", "a symmetric tensor"}},
      {"a tensor of another trace",
       rods(kBoth + "aspect = 2\norientation = { tensor = [[1, 0, 0], [0, 1, 0], [0, 0, 0]] }\n"),
       {"bad.toml:8:", "inclusions[0].orientation.tensor", "trace"}},
      {"degrees in 3D",
       rods(kBoth + "aspect = 2\norientation = { degrees = 3 }\n"),
       {"bad.toml:8: unknown key \"inclusions[0].orientation.degrees\""}},
      {"planar in 2D",
       kFlat + kGroup + "shape = \"ellipse\"\naspect = 2\n" + kBoth +
           "orientation = { planar = \"xy\" }\n",
       {"bad.toml:8: unknown key \"inclusions[0].orientation.planar\""}},
      {"a method there is not",
       kFine + "[packing]\nmethod = \"pour\"\n",
       {"bad.toml:8: packing.method = \"pour\"; allowed is one of \"auto\", \"rsa\", "
        "\"event-driven\""}},
      {"a negative gap",
       kFine + "[packing]\nmin_gap = -0.1\n",
       {"bad.toml:8: packing.min_gap = -0.1; allowed is a number >= 0"}},
      {"a negative seed",
       kFine + "[packing]\nseed = -1\n",
       {"bad.toml:8: packing.seed = -1; allowed is an integer >= 0"}},
      {"a time in words",
       kFine + "[packing]\ntime_limit = \"a while\"\n",
       {"bad.toml:8: packing.time_limit = \"a while\"; allowed is a time > 0", "\"10 min\""}},
      {"options of a method there is not",
       kFine + "[packing.annealing]\nsteps = 3\n",
       {"bad.toml:7: unknown key \"packing.annealing\""}},
      {"a share above 1",
       kFine + "[packing.relaxation]\nrelocated_share = 1.5\n",
       {"bad.toml:8: packing.relaxation.relocated_share = 1.5", "a number >= 0 and <= 1"}},
      {"a way to turn there is not",
       kFine + "[packing.relaxation]\nrotate = \"fre\"\n",
       {"bad.toml:8: packing.relaxation.rotate = \"fre\"", "did you mean \"free\"?"}},
      {"a goal there is not",
       kFine + "[packing.relaxation]\ngoal = \"denser\"\n",
       {"bad.toml:8: packing.relaxation.goal = \"denser\"", "\"target\", \"densest\""}},
      {"a least step above the first",
       kFine + "[packing.relaxation]\nfirst_step = 0.01\nleast_step = 0.02\n",
       {"bad.toml:9: packing.relaxation.least_step = 0.02",
        "a number > 0 and <= first_step = 0.01"}},
      {"too much inflation",
       kFine + "[packing.relaxation]\ninflation = 0.2\n",
       {"bad.toml:8: packing.relaxation.inflation = 0.2", "a number > 0 and <= 0.1"}},
      {"misspelled option",
       kFine + "[packing.rsa]\nmax_trails = 3\n",
       {"bad.toml:8: unknown key \"packing.rsa.max_trails\"; did you mean \"max_trials\"?"}},
      {"an order there is not",
       kFine + "[packing.rsa]\norder = \"smallest-first\"\n",
       {"bad.toml:8: packing.rsa.order = \"smallest-first\"; allowed is one of \"largest-first\""}},
      {"no trials",
       kFine + "[packing.rsa]\nmax_trials = 0\n",
       {"bad.toml:8: packing.rsa.max_trials = 0; allowed is an integer >= 1"}},
      {"a misspelled method of two words",
       kFine + "[packing]\nmethod = \"event driven\"\n",
       {"bad.toml:8: packing.method = \"event driven\"", "did you mean \"event-driven\"?"}},
      {"dynamics that are no table",
       kFine + "[packing]\nevent-driven = 3\n",
       {"bad.toml:8: packing.event-driven = 3; allowed is a table [packing.event-driven]"}},
      {"an option of dynamics at home elsewhere",
       kFine + "[packing]\ngrowth_rate = 0.1\n",
       {"bad.toml:8: unknown key \"packing.growth_rate\"; it belongs in [packing.event-driven]"}},
      {"a misspelled option of dynamics",
       kFine + "[packing.event-driven]\ngrowthrate = 0.1\n",
       {"bad.toml:8: unknown key \"packing.event-driven.growthrate\"; did you mean "
        "\"growth_rate\"?"}},
      {"a goal there is not",
       kFine + "[packing.event-driven]\ngoal = \"jam\"\n",
       {"bad.toml:8: packing.event-driven.goal = \"jam\"; allowed is one of \"target\", "
        "\"densest\", \"equilibrium\""}},
      {"no growth",
       kFine + "[packing.event-driven]\ngrowth_rate = 0\n",
       {"bad.toml:8: packing.event-driven.growth_rate = 0; allowed is a number > 0 and <= 10"}},
      {"too fast growth",
       kFine + "[packing.event-driven]\ngrowth_rate = 10.5\n",
       {"bad.toml:8: packing.event-driven.growth_rate = 10.5; allowed is a number > 0 and <= 10"}},
      {"a slowest growth that is the faster one",
       kFine + "[packing.event-driven]\ngrowth_rate = 0.01\nslowest_growth = 0.02\n",
       {"bad.toml:9: packing.event-driven.slowest_growth = 0.02; allowed is a number > 0 and <= "
        "growth_rate = 0.01"}},
      {"rotation in words",
       kFine + "[packing.event-driven]\nrotate = \"yes\"\n",
       {"bad.toml:8: packing.event-driven.rotate = \"yes\"; allowed is true, false or \"auto\""}},
      {"no collisions",
       kFine + "[packing.event-driven]\ncollisions_per_body = 0\n",
       {"bad.toml:8: packing.event-driven.collisions_per_body = 0; allowed is a number > 0"}},
      {"a flag in words",
       kFine + "[packing.event-driven]\ncheck_every_event = \"no\"\n",
       {"bad.toml:8: packing.event-driven.check_every_event = \"no\"; allowed is true or false"}},
      {"a start there is not",
       kFine + "[packing.event-driven]\nstart = \"lattice\"\n",
       {"bad.toml:8: packing.event-driven.start = \"lattice\"; allowed is one of \"points\", "
        "\"rsa\""}},
      {"a start with all the room",
       kFine + "[packing.event-driven]\nstart_fraction = 1\n",
       {"bad.toml:8: packing.event-driven.start_fraction = 1; allowed is a number > 0 and < 1"}},
      {"a misspelled shape",
       kCell + kGroup + "shape = \"Spere\"\n" + kBoth,
       {"bad.toml:4: inclusions[0].shape = \"Spere\"", "did you mean \"sphere\"?"}},
      {"a shape of the plane in space",
       kCell + kGroup + "shape = \"disk\"\n" + kBoth,
       {"bad.toml:4: inclusions[0].shape = \"disk\"", "in a 3D cell"}},
      {"a misspelled method",
       kFine + "[packing]\nmethod = \"rsq\"\n",
       {"bad.toml:8: packing.method = \"rsq\"", "did you mean \"rsa\"?"}},
      {"a count with a point",
       spheres("count = 10.0\nfraction = 0.1\n"),
       {"bad.toml:5: inclusions[0].count = 10.0", "an integer >= 1, without point or exponent"}},
      {"a tensor of trace 2",
       rods("aspect = 5\n" + kBoth +
            "orientation = { tensor = [[1, 0, 0], [0, 1, 0], [0, 0, 0]] }\n"),
       {"bad.toml:8: inclusions[0].orientation.tensor has trace 2, allowed is 1"}},
      {"a tensor of negative eigenvalue",
       rods("aspect = 5\n" + kBoth +
            "orientation = { tensor = [[1.2, 0, 0], [0, -0.2, 0], [0, 0, 0]] }\n"),
       {"bad.toml:8: inclusions[0].orientation.tensor has the eigenvalue -0.2"}},
      {"two groups of open count",
       spheres("radius = 0.1\n[[inclusions]]\n" + kSphere + "radius = 0.05\n"),
       {"bad.toml:6: inclusions[1] is the second group with a size alone"}},
  };
}

}  // namespace

TEST_CASE("a wrong recipe is refused with file, line, key, value and allowed range") {
  REQUIRE(message_of(kFine).starts_with("accepted"));
  for (const Wrong& wrong : wrong_recipes()) {
    const std::string message = message_of(wrong.text);
    CAPTURE(wrong.what, wrong.text, message);
    for (const std::string& part : wrong.parts) CHECK_THAT(message, Catch::Contains(part));
    // One mistake makes one message.
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("all mistakes of a recipe are told at once, each with its line") {
  const std::string message = message_of(
      "[cell]\nsize = [1, -1, 1]\n[[inclusions]]\nshape = \"sphere\"\ncuont = 3\n"
      "fraction = 1.5\n[packing]\nmin_gap = \"none\"\n");
  CHECK_THAT(message, Catch::Contains("bad.toml:2: cell.size[1] = -1"));
  CHECK_THAT(message, Catch::Contains("bad.toml:5: unknown key \"inclusions[0].cuont\""));
  CHECK_THAT(message, Catch::Contains("bad.toml:6: inclusions[0].fraction = 1.5"));
  CHECK_THAT(message, Catch::Contains("bad.toml:8: packing.min_gap = \"none\""));
}

TEST_CASE("a table of sizes that is none is named, cut short and made printable") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sizes");
  std::ofstream(folder / "noise.csv") << "1, 2\n\x1b[31m\xff" << std::string(500, 'x') << ",1,2\n";
  const auto with = [&](const std::string& table) {
    std::ofstream(folder / "r.toml") << kFine << "size = { table = \"" << table << "\" }\n";
    try {
      std::ignore = read_recipe(folder / "r.toml");
    } catch (const InvalidArgument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(with("sizes"), Catch::Contains("r.toml:7: ") && Catch::Contains("is a folder"));
  const std::string message = with("noise.csv");
  CHECK_THAT(message, Catch::Contains("noise.csv:2: ?[31m?xxx") && Catch::Contains("..."));
  CHECK(message.find('\x1b') == std::string::npos);
}

TEST_CASE("what cannot be read as a recipe at all is said") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH(read_recipe(folder.path()), Catch::Contains("it is a folder, not a recipe"));
  CHECK_THROWS_WITH(read_recipe(folder / "no.toml"), Catch::Contains("there is no such file"));
  std::ofstream(folder / "p.json")
      << R"({ "format": "packstone-packing", "version": 1, "groups": [], "inclusions": [],
              "cell": { "size": [1, 1], "periodic": [true, true] } })";
  CHECK_THROWS_WITH(read_recipe(folder / "p.json"),
                    Catch::Contains("does not hold the recipe it came from"));
}
