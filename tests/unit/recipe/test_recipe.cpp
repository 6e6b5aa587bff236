#include <unistd.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/recipe/recipe.hpp"

using namespace packstone;

namespace {

// A recipe of one group in a cubic or square cell.
Recipe one_group(const std::string& group, const std::string& size = "[1, 1, 1]") {
  return recipe_from_toml("[cell]\nsize = " + size + "\n[[inclusions]]\n" + group, "test.toml");
}

InclusionGroup group_of(const std::string& group, const std::string& size = "[1, 1, 1]") {
  return one_group(group, size).groups.at(0);
}

template <class Law>
Law law_of(const std::string& size) {
  const InclusionGroup group = group_of("shape = \"sphere\"\ncount = 5\nradius = " + size + "\n");
  REQUIRE(std::holds_alternative<Law>(group.size.law));
  return std::get<Law>(group.size.law);
}

OrientationLaw orientation_of(const std::string& text) {
  return group_of("shape = \"cylinder\"\naspect = 3\ncount = 9\nfraction = 0.1\norientation = " +
                  text + "\n")
      .orientation;
}

OrientationLaw orientation_2d_of(const std::string& text) {
  return group_of("shape = \"ellipse\"\naspect = 3\ncount = 9\nfraction = 0.1\norientation = " +
                      text + "\n",
                  "[1, 1]")
      .orientation;
}

double seconds_of(const std::string& text) {
  return *one_group("shape = \"sphere\"\nradius = 0.1\n[packing]\ntime_limit = " + text + "\n")
              .time_limit;
}

// A folder that is removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("packstone_recipe_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  [[nodiscard]] std::filesystem::path write(const std::string& name,
                                            const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace

TEST_CASE("the recipe of the design is read as it stands") {
  const Recipe recipe = recipe_from_toml(R"(
[cell]
size     = [1, 1, 1]
periodic = true
[[inclusions]]
name     = "fibers"
shape    = "cylinder"
aspect   = 5
count    = 200
fraction = 0.40
orientation = "random"
[[inclusions]]
name     = "beads"
shape    = "sphere"
count    = 40
fraction = 0.10
size     = { lognormal = { mean = 1.0, std = 0.4, min = 0.3, max = 3.0 } }
[packing]
method     = "auto"
min_gap    = 0.0
seed       = 1
time_limit = "10 min"
)",
                                         "design.toml");
  CHECK(recipe.origin == "design.toml");
  CHECK(recipe.cell == Cell{});
  REQUIRE(recipe.groups.size() == 2);
  const InclusionGroup& fibers = recipe.groups[0];
  CHECK(fibers.name == "fibers");
  CHECK(fibers.shape == ShapeKind::cylinder);
  CHECK(fibers.count == 200);
  CHECK(fibers.fraction == 0.40);
  CHECK(fibers.measure == SizeMeasure::relative);
  CHECK(std::get<ConstantLaw>(fibers.aspect.law).value == 5.0);
  CHECK(std::holds_alternative<RandomOrientation>(fibers.orientation));
  const auto& sizes = std::get<LognormalLaw>(recipe.groups[1].size.law);
  // Mean m and deviation s: sigma^2 = log(1 + s^2 / m^2), mu = log m - sigma^2 / 2.
  CHECK(sizes.sigma == Approx(std::sqrt(std::log(1.16))).epsilon(1e-14));
  CHECK(sizes.mu == Approx(-0.5 * std::log(1.16)).epsilon(1e-14));
  CHECK(sizes.min == 0.3);
  CHECK(sizes.max == 3.0);
  CHECK(recipe.method == PackMethod::automatic);
  CHECK(recipe.min_gap == 0.0);
  CHECK(recipe.seed == 1);
  CHECK(recipe.time_limit == 600.0);
}

TEST_CASE("what a recipe leaves out takes the documented default") {
  const Recipe recipe = one_group("shape = \"sphere\"\nradius = 0.1\n");
  CHECK(recipe.cell.periodic == std::array{true, true, true});
  CHECK(recipe.groups[0].name == "sphere");
  CHECK(recipe.method == PackMethod::automatic);
  CHECK(recipe.min_gap == 0.0);
  CHECK(recipe.seed == 1);
  CHECK_FALSE(recipe.time_limit.has_value());
  CHECK(recipe.rsa.order == RsaOrder::largest_first);
  CHECK_FALSE(recipe.rsa.redraw_orientations);
  CHECK(recipe.rsa.max_trials == RsaOptions{}.max_trials);
  CHECK(recipe.rsa.max_restarts == RsaOptions{}.max_restarts);
  const EventDrivenSettings& dynamics = recipe.event_driven;
  CHECK(dynamics.goal == EventDrivenGoal::target);
  CHECK(dynamics.growth_rate == EventDrivenOptions{}.growth_rate);
  CHECK(dynamics.slowest_growth == EventDrivenOptions{}.slowest_growth);
  CHECK(dynamics.rotate == Rotation::automatic);
  CHECK(dynamics.collisions_per_body == EventDrivenOptions{}.collisions_per_body);
  CHECK_FALSE(dynamics.published_stagnation);
  CHECK_FALSE(dynamics.check_every_event);
  CHECK(dynamics.start == GrowthStart::points);
  CHECK_FALSE(dynamics.start_fraction.has_value());
}

TEST_CASE("a cell is 2D or 3D by its size and periodic per axis") {
  const std::string group = "[[inclusions]]\nshape = \"disk\"\nradius = 0.1\n";
  const auto cell_of = [&](const std::string& text) {
    return recipe_from_toml("[cell]\n" + text + "\n" + group, "t").cell;
  };
  CHECK(cell_of("size = [2, 3.5]") == cell_2d(2, 3.5));
  CHECK(cell_of("size = [2, 3]\nperiodic = false") == cell_2d(2, 3, false, false));
  CHECK(cell_of("size = [2, 3]\nperiodic = [true, false]") == cell_2d(2, 3, true, false));
  const Recipe walls = recipe_from_toml(
      "[cell]\nsize = [1, 2, 3]\nperiodic = [true, false, true]\n[[inclusions]]\n"
      "shape = \"sphere\"\nradius = 0.1",
      "t");
  CHECK(walls.cell == Cell{3, {1, 2, 3}, {true, false, true}});
}

TEST_CASE("every size key gives the measure it stands for") {
  const std::string sphere = "shape = \"sphere\"\ncount = 3\n";
  CHECK(group_of(sphere + "radius = 0.2").measure == SizeMeasure::radius);
  CHECK(std::get<ConstantLaw>(group_of(sphere + "radius = 0.2").size.law).value == 0.2);
  CHECK(std::get<ConstantLaw>(group_of(sphere + "diameter = 0.2").size.law).value == 0.1);
  CHECK(group_of(sphere + "volume = 0.2").measure == SizeMeasure::volume);
  CHECK(group_of(sphere + "size = 0.2").measure == SizeMeasure::equivalent);
  const std::string rod = "shape = \"spherocylinder\"\ncount = 3\naspect = 4\n";
  CHECK(group_of(rod + "diameter = 0.2").measure == SizeMeasure::radius);
  CHECK(std::get<ConstantLaw>(group_of(rod + "diameter = 0.2").size.law).value == 0.1);
  CHECK(group_of(rod + "length = 0.2").measure == SizeMeasure::half_length);
  CHECK(std::get<ConstantLaw>(group_of(rod + "length = 0.2").size.law).value == 0.1);
  CHECK(group_of(rod + "half_length = 0.2").measure == SizeMeasure::half_length);
  CHECK(group_of(rod + "radius = 0.2").measure == SizeMeasure::radius);
  CHECK(group_of(rod + "volume = 0.2").measure == SizeMeasure::volume);
  const InclusionGroup fixed =
      group_of("shape = \"cylinder\"\ncount = 3\ndiameter = 0.2\nlength = 0.6");
  CHECK(fixed.dimensions == Vec3{0.1, 0.3, 0});
  const InclusionGroup lengths = group_of(
      "shape = \"cylinder\"\ncount = 3\ndiameter = 0.1\n"
      "length = { weibull = { shape = 2, scale = 0.5, min = 0.2 }, by = \"volume\" }");
  CHECK_FALSE(lengths.dimensions.has_value());
  CHECK(lengths.measure == SizeMeasure::radius);
  CHECK(std::get<ConstantLaw>(lengths.size.law).value == 0.05);
  CHECK(lengths.aspect.by == Weighting::volume);
  CHECK(std::get<WeibullLaw>(lengths.aspect.law).scale == Approx(5.0));
  CHECK(std::get<WeibullLaw>(lengths.aspect.law).min == Approx(2.0));
  CHECK(group_of("shape = \"ellipsoid\"\ncount = 3\nsemi_axes = [0.3, 0.2, 0.1]").dimensions ==
        Vec3{0.3, 0.2, 0.1});
  CHECK(group_of("shape = \"ellipse\"\ncount = 3\nsemi_axes = [0.3, 0.2]", "[1, 1]").dimensions ==
        Vec3{0.3, 0.2, 0});
  CHECK(group_of("shape = \"disk\"\ncount = 3\narea = 0.01", "[1, 1]").measure ==
        SizeMeasure::volume);
}

TEST_CASE("count and fraction together make the size relative") {
  const InclusionGroup group =
      group_of("shape = \"sphere\"\ncount = 3\nfraction = 0.1\nsize = { uniform = [1, 2] }");
  CHECK(group.measure == SizeMeasure::relative);
  CHECK(std::holds_alternative<UniformLaw>(group.size.law));
}

TEST_CASE("an aspect is a number, a pair or a distribution") {
  const std::string start = "shape = \"ellipsoid\"\ncount = 3\nfraction = 0.1\naspect = ";
  const InclusionGroup spheroid = group_of(start + "2.5");
  CHECK(spheroid.spheroid);
  CHECK(std::get<ConstantLaw>(spheroid.aspect.law).value == 2.5);
  const InclusionGroup triaxial = group_of(start + "[1.5, { uniform = [2, 3] }]");
  CHECK_FALSE(triaxial.spheroid);
  CHECK(std::get<ConstantLaw>(triaxial.aspect.law).value == 1.5);
  CHECK(std::get<UniformLaw>(triaxial.aspect_second.law).hi == 3.0);
  CHECK(std::holds_alternative<NormalLaw>(
      group_of(start + "{ normal = { mean = 3, std = 1, min = 1 } }").aspect.law));
}

TEST_CASE("every form of distribution is read") {
  CHECK(law_of<ConstantLaw>("0.25").value == 0.25);
  CHECK(law_of<ConstantLaw>("{ value = 1 }").value == 1.0);
  CHECK(law_of<UniformLaw>("{ uniform = [0.1, 0.2] }").lo == 0.1);
  const auto normal = law_of<NormalLaw>("{ normal = { mean = 1, std = 0.1, min = 0.5 } }");
  CHECK(normal.mean == 1.0);
  CHECK(normal.std == 0.1);
  CHECK(normal.min == 0.5);
  CHECK(normal.max == NormalLaw{}.max);
  const auto logarithmic = law_of<LognormalLaw>("{ lognormal = { mu = -2, sigma = 0.3 } }");
  CHECK(logarithmic.mu == -2.0);
  CHECK(logarithmic.sigma == 0.3);
  const auto weibull = law_of<WeibullLaw>("{ weibull = { shape = 3, scale = 0.1, max = 0.2 } }");
  CHECK(weibull.shape == 3.0);
  CHECK(weibull.scale == 0.1);
  CHECK(weibull.max == 0.2);
  const auto mixture = law_of<MixtureLaw>(
      "{ mixture = [ { weight = 3, value = 0.1 }, { weight = 1, uniform = [0.2, 0.3] } ] }");
  CHECK(mixture.weights == std::vector<double>{3, 1});
  CHECK(std::holds_alternative<UniformLaw>(mixture.parts[1].law));
  const auto table = law_of<TableLaw>("{ table = { values = [0.1, 0.2], weights = [1, 2] } }");
  CHECK(table.values == std::vector<double>{0.1, 0.2});
  CHECK(table.weights == std::vector<double>{1, 2});
}

TEST_CASE("a distribution counts numbers unless it says volume") {
  const std::string start = "shape = \"sphere\"\ncount = 3\nfraction = 0.1\n";
  CHECK(group_of(start + "size = { uniform = [1, 2] }").size.by == Weighting::number);
  CHECK(group_of(start + "size = { uniform = [1, 2], by = \"number\" }").size.by ==
        Weighting::number);
  CHECK(group_of(start + "size = { uniform = [1, 2], by = \"volume\" }").size.by ==
        Weighting::volume);
}

TEST_CASE("a diameter's law is that of the radius with every length halved") {
  const auto of = [](const std::string& law) {
    return group_of("shape = \"sphere\"\ncount = 3\ndiameter = " + law).size.law;
  };
  CHECK(std::get<UniformLaw>(of("{ uniform = [0.2, 0.4] }")).hi == 0.2);
  const auto normal = std::get<NormalLaw>(of("{ normal = { mean = 1, std = 0.2, min = 0.5 } }"));
  CHECK(normal.mean == 0.5);
  CHECK(normal.std == 0.1);
  CHECK(normal.min == 0.25);
  CHECK(normal.max == NormalLaw{}.max);
  const auto lognormal =
      std::get<LognormalLaw>(of("{ lognormal = { mu = 1, sigma = 0.2, max = 4 } }"));
  CHECK(lognormal.mu == Approx(1 - std::log(2.0)).epsilon(1e-15));
  CHECK(lognormal.sigma == 0.2);
  CHECK(lognormal.max == 2.0);
  CHECK(std::get<WeibullLaw>(of("{ weibull = { shape = 2, scale = 1 } }")).scale == 0.5);
  const auto mixture = std::get<MixtureLaw>(of("{ mixture = [ { weight = 1, value = 1 } ] }"));
  CHECK(std::get<ConstantLaw>(mixture.parts[0].law).value == 0.5);
}

TEST_CASE("a table of sizes is read beside the recipe, heading and comments passed over") {
  const TemporaryFolder folder;
  std::ignore =
      folder.write("sizes.csv", "diameter, share\n# coarse\n16, 0.25\n8; 0.5\n\n4 0.25\n2\n");
  const auto path = folder.write("r.toml",
                                 "[cell]\nsize = [99, 99, 99]\n[[inclusions]]\nshape = \"sphere\"\n"
                                 "fraction = 0.1\nradius = { table = \"sizes.csv\" }\n");
  const Recipe recipe = read_recipe(path);
  const auto& table = std::get<TableLaw>(recipe.groups[0].size.law);
  CHECK(table.values == std::vector<double>{16, 8, 4, 2});
  CHECK(table.weights == std::vector<double>{0.25, 0.5, 0.25, 1.0});
}

TEST_CASE("every form of orientation is read") {
  CHECK(std::holds_alternative<RandomOrientation>(orientation_of("\"random\"")));
  CHECK(std::get<AlignedOrientation>(orientation_of("{ axis = [0, 0, -3] }")).axis ==
        Vec3{0, 0, -1});
  CHECK(std::get<PlanarOrientation>(orientation_of("{ planar = \"xy\" }")).normal == Vec3{0, 0, 1});
  CHECK(std::get<PlanarOrientation>(orientation_of("{ planar = \"xz\" }")).normal == Vec3{0, 1, 0});
  CHECK(std::get<PlanarOrientation>(orientation_of("{ planar = \"yz\" }")).normal == Vec3{1, 0, 0});
  CHECK(std::get<PlanarOrientation>(orientation_of("{ planar = { normal = [0, 2, 0] } }")).normal ==
        Vec3{0, 1, 0});
  const auto tensor = std::get<TensorOrientation>(
      orientation_of("{ tensor = [[0.7, 0.1, 0], [0.1, 0.2, 0], [0, 0, 0.1]] }"));
  CHECK(tensor.tensor == SymMat3{0.7, 0.2, 0.1, 0, 0, 0.1});
  CHECK(tensor.family == TensorFamily::angular_central_gaussian);
  CHECK(std::get<TensorOrientation>(
            orientation_of("{ tensor = [[1, 0, 0], [0, 0, 0], [0, 0, 0]], family = \"bingham\" }"))
            .family == TensorFamily::bingham);
}

TEST_CASE("every form of orientation in the plane is read") {
  CHECK(std::holds_alternative<RandomOrientation>(orientation_2d_of("\"random\"")));
  const auto fixed = std::get<AngleOrientation>(orientation_2d_of("{ degrees = -30 }"));
  CHECK(std::get<ConstantLaw>(fixed.degrees.law).value == -30.0);
  const auto normal = std::get<AngleOrientation>(
      orientation_2d_of("{ degrees = { normal = { mean = 0, std = 20 } } }"));
  CHECK(std::holds_alternative<NormalLaw>(normal.degrees.law));
  CHECK(std::get<AlignedOrientation>(orientation_2d_of("{ axis = [0, 2] }")).axis == Vec3{0, 1, 0});
  CHECK(std::get<TensorOrientation>(orientation_2d_of("{ tensor = [[0.7, 0.1], [0.1, 0.3]] }"))
            .tensor == SymMat3{0.7, 0.3, 0, 0, 0, 0.1});
}

TEST_CASE("time limits are numbers of seconds or texts with a unit") {
  CHECK(seconds_of("12") == 12.0);
  CHECK(seconds_of("0.5") == 0.5);
  CHECK(seconds_of("\"30 s\"") == 30.0);
  CHECK(seconds_of("\"30s\"") == 30.0);
  CHECK(seconds_of("\"10 min\"") == 600.0);
  CHECK(seconds_of("\"1.5 h\"") == 5400.0);
  CHECK(seconds_of("\"2 hours\"") == 7200.0);
  CHECK(seconds_of("\"90\"") == 90.0);
  for (const char* text :
       {"", "min", "10 parsecs", "-3 s", "0", "inf", "nan s", "1e999", "3 s s"}) {
    CAPTURE(text);
    CHECK_FALSE(seconds_in(text).has_value());
  }
}

TEST_CASE("the options of rsa are read one to one") {
  const Recipe recipe = one_group(
      "shape = \"sphere\"\nradius = 0.1\n[packing]\nmethod = \"rsa\"\nmin_gap = 0.01\nseed = 9\n"
      "[packing.rsa]\norder = \"shuffled\"\nredraw_orientations = true\nmax_trials = 77\n"
      "max_restarts = 0\n");
  CHECK(recipe.method == PackMethod::rsa);
  CHECK(recipe.min_gap == 0.01);
  CHECK(recipe.seed == 9);
  CHECK(recipe.rsa.order == RsaOrder::shuffled);
  CHECK(recipe.rsa.redraw_orientations);
  CHECK(recipe.rsa.max_trials == 77);
  CHECK(recipe.rsa.max_restarts == 0);
  CHECK(one_group("shape = \"sphere\"\nradius = 0.1\n[packing.rsa]\norder = \"group\"").rsa.order ==
        RsaOrder::as_given);
}

TEST_CASE("the options of event-driven dynamics are read one to one") {
  const auto read = [](const std::string& keys) {
    return one_group(
        "shape = \"sphere\"\nradius = 0.1\ncount = 3\n[packing]\n"
        "method = \"event-driven\"\n[packing.event-driven]\n" +
        keys);
  };
  const Recipe recipe = read(
      "goal = \"equilibrium\"\ngrowth_rate = 0.5\nslowest_growth = 0.5\nrotate = true\n"
      "collisions_per_body = 20\npublished_stagnation = true\ncheck_every_event = true\n"
      "start = \"rsa\"\nstart_fraction = 0.05\n");
  CHECK(recipe.method == PackMethod::event_driven);
  CHECK(name(recipe.method) == "event-driven");
  const EventDrivenSettings& dynamics = recipe.event_driven;
  CHECK(dynamics.goal == EventDrivenGoal::equilibrium);
  CHECK(dynamics.growth_rate == 0.5);
  CHECK(dynamics.slowest_growth == 0.5);
  CHECK(dynamics.rotate == Rotation::all);
  CHECK(dynamics.collisions_per_body == 20.0);
  CHECK(dynamics.published_stagnation);
  CHECK(dynamics.check_every_event);
  CHECK(dynamics.start == GrowthStart::rsa);
  CHECK(dynamics.start_fraction == 0.05);
  CHECK(read("goal = \"densest\"").event_driven.goal == EventDrivenGoal::densest);
  CHECK(read("rotate = false").event_driven.rotate == Rotation::none);
  CHECK(read("rotate = \"auto\"").event_driven.rotate == Rotation::automatic);
  // A growth rate below the default of the slowest one takes that down with it.
  CHECK(read("growth_rate = 1e-7").event_driven.slowest_growth == 1e-7);
  const Recipe changed = recipe_from_toml(
      "[cell]\nsize = [1, 1, 1]\n[[inclusions]]\nshape = \"sphere\"\nradius = 0.1\n", "t",
      {"packing.event-driven.goal=densest", "packing.event-driven.growth_rate=0.2"});
  CHECK(changed.event_driven.goal == EventDrivenGoal::densest);
  CHECK(changed.event_driven.growth_rate == 0.2);
}

TEST_CASE("groups without a name take that of their shape, and never that of another group") {
  const Recipe recipe = recipe_from_toml(
      "[cell]\nsize = [1, 1, 1]\n"
      "[[inclusions]]\nshape = \"sphere\"\ncount = 1\nradius = 0.1\n"
      "[[inclusions]]\nname = \"sphere\"\nshape = \"sphere\"\ncount = 1\nradius = 0.1\n"
      "[[inclusions]]\nshape = \"sphere\"\ncount = 1\nradius = 0.1\n",
      "t");
  CHECK(recipe.groups[0].name == "sphere_2");
  CHECK(recipe.groups[1].name == "sphere");
  CHECK(recipe.groups[2].name == "sphere_3");
}

TEST_CASE("a recipe that is not there is a file error that names it") {
  CHECK_THROWS_AS(read_recipe("no/such/recipe.toml"), FileError);
  CHECK_THROWS_WITH(read_recipe("no/such/recipe.toml"), Catch::Contains("no/such/recipe.toml"));
}
