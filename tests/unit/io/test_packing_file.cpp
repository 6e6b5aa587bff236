#include "packstone/io/packing_file.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/error.hpp"
#include "support/random_packing.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

TEST_CASE("a packing of any shape comes back from its JSON text bit for bit") {
  for (int shape = 0; shape < 6; ++shape) {
    const auto kind = static_cast<ShapeKind>(shape);
    const Packing packing = test::random_packing(dimension(kind), 200, 100 + shape, kind);
    REQUIRE(test::same_bits(packing_from_json(packing_to_json(packing), "text"), packing));
  }
}

TEST_CASE("mixed packings come back from their JSON text bit for bit") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Packing packing = test::random_packing(seed % 2 == 0 ? 2 : 3, 20, seed);
    REQUIRE(test::same_bits(packing_from_json(packing_to_json(packing), "text"), packing));
  }
}

TEST_CASE("groups keep their order, empty ones included; without a list they come as they appear") {
  Packing packing;
  packing.groups = {"empty", "b", "a", "last"};
  packing.inclusions = {{{0.1, 0.1, 0.1}, Sphere{0.1}, 2}, {{0.5, 0.5, 0.5}, Sphere{0.1}, 1}};
  const std::string text = packing_to_json(packing);
  CHECK(test::same_bits(packing_from_json(text, "text"), packing));
  const std::string list = "  \"groups\": [\"empty\", \"b\", \"a\", \"last\"],\n";
  const auto place = text.find(list);
  REQUIRE(place != std::string::npos);
  const Packing read = packing_from_json(std::string(text).erase(place, list.size()), "text");
  CHECK(read.groups == std::vector<std::string>{"a", "b"});
  CHECK(read.inclusions[0].group == 0);
  CHECK(read.inclusions[1].group == 1);
}

TEST_CASE("members may stand in any order, as other programs write them") {
  const Packing packing = packing_from_json(
      R"({"inclusions": [{"radius": 2e-1, "center": [0, 0.5], "shape": "disk", "group": "g"}],
          "cell": {"periodic": [true, false], "size": [1, 2]},
          "version": 1, "format": "packstone-packing"})",
      "text");
  CHECK(packing.cell == cell_2d(1, 2, true, false));
  CHECK(packing.inclusions == std::vector<Inclusion>{{{0, 0.5, 0}, Disk{0.2}, 0}});
}

TEST_CASE("the zero with a sign and the least and greatest numbers come back") {
  Packing packing;
  packing.groups = {"g"};
  packing.inclusions = {
      {{0.0, -0.0, 5e-324}, Cylinder{5e-324, 1.7976931348623157e308, {-0.0, 0.0, -1.0}}, 0},
      {{0.5, 0.5, 0.5}, Sphere{12345678901234567168.0}, 0},
      {{0.5, 0.5, 0.5}, Sphere{9007199254740993.0}, 0}};
  CHECK(test::same_bits(packing_from_json(packing_to_json(packing), "text"), packing));
}

TEST_CASE("a unit vector that is off by rounding is kept bit for bit, not normalized again") {
  Packing packing;
  packing.groups = {"g"};
  packing.inclusions = {{{0, 0, 0}, Cylinder{1, 1, {0, 0.6, 0.8 + 5e-13}}, 0}};
  CHECK(test::same_bits(packing_from_json(packing_to_json(packing), "text"), packing));
}

/// A valid file, a change to it, and what the message must say.
struct Damage {
  const char* what;
  const char* with;
  const char* message;
};

constexpr const char* kValid = R"({
  "format": "packstone-packing",
  "version": 1,
  "cell": { "size": [1, 1, 1], "periodic": [true, true, false] },
  "groups": ["a", "b"],
  "inclusions": [
    { "group": "a", "shape": "sphere", "center": [0.5, 0.5, 0.5], "radius": 0.125 },
    { "group": "b", "shape": "cylinder", "center": [0.1, 0.2, 0.3], "radius": 0.25, "half_length": 0.5, "axis": [0, 0, 1] },
    { "group": "b", "shape": "ellipsoid", "center": [0.4, 0.4, 0.4], "axes": [0.1, 0.2, 0.3], "quaternion": [1, 0, 0, 0] }
  ],
  "certificate": { "count": 3, "fraction": 0.5, "groups": [ { "name": "a", "count": 1, "fraction": 0.1 } ],
    "min_gap": 0, "smallest_gap": null, "smallest_gap_error": 1e-16, "worst_pair": [0, 1], "worst_image": [0, 0, -1],
    "overlaps": 0, "gaps_below": 0, "outside_walls": 0, "pairs_checked": 3 },
  "provenance": { "recipe": { "x": [1] }, "seed": 7, "method": "rsa", "version": "0.1", "stop": "done", "seconds": 1.5 }
})";

constexpr Damage kDamages[] = {
    {"\"packstone-packing\"", "\"other\"", "packing.json: format is 'other', not a packing file"},
    {"\"version\": 1,", "\"version\": 2,", "version 2 is unknown; this program reads version 1"},
    {"\"version\": 1,", "\"version\": 1.0,", "version: must be an integer"},
    {"\"version\": 1,", "\"version\": \"1\",", "version: must be an integer"},
    {"\"packstone-packing\"", "[1]", "the packing.format: must be text"},
    {"\"version\": 1,", "", "field 'version' is missing"},
    {"\"format\": \"packstone-packing\",", "", "field 'format' is missing"},
    {"\"version\": 1,", "\"version\": 1, \"version\": 1,", "field 'version' stands twice"},
    {"\"version\": 1,", "\"version\": 1, \"comment\": \"x\",", "unknown field 'comment'"},
    {"\"size\": [1, 1, 1]", "\"size\": [1, 1]", "cell.periodic: must have as many flags"},
    {"\"size\": [1, 1, 1]", "\"size\": [1]", "cell.size: must have 2 or 3 numbers"},
    {"\"size\": [1, 1, 1]", "\"size\": [1, 1, -1]", "cell.size[2] = -1"},
    {"\"size\": [1, 1, 1]", "\"size\": [1, 1, \"1\"]", "cell.size: must be a number"},
    {"\"size\": [1, 1, 1], ", "", "cell: field 'size' is missing"},
    {"[true, true, false]", "[true, 1, false]", "cell.periodic: must be true or false"},
    {"\"size\": [1, 1, 1]", "\"size\": [1, 1, 1], \"angle\": 90", "cell: unknown field 'angle'"},
    {"[\"a\", \"b\"]", "[\"a\", \"b\", \"a\"]", "groups[2] = 'a' stands twice"},
    {"[\"a\", \"b\"]", "[\"a\"]", "inclusion 1: group 'b' is not in the list"},
    {"[\"a\", \"b\"]", "[\"a\", 5]", "groups[1]: must be text"},
    {"\"radius\": 0.125", "\"radius\": -0.125", "packing.json: inclusion 0: radius = -0.125"},
    {"\"radius\": 0.125", "\"radius\": 0", "inclusion 0: radius = 0"},
    {"\"radius\": 0.125", "\"radius\": 1e999", "number overflow parsing '1e999' (in inclusion 0)"},
    {"\"radius\": 0.125", "\"radius\": NaN", "(in inclusion 0)"},
    {"\"radius\": 0.125", "\"radius\": null", "inclusion 0: radius must be a number"},
    {"\"radius\": 0.125", "\"radius\": [0.125]", "inclusion 0: radius must be a number"},
    {"\"radius\": 0.125", "\"radius\": \"0.125\"", "inclusion 0: radius must be a number"},
    {"\"radius\": 0.125", "\"radius\": {}", "inclusion 0: radius must be a number"},
    {"\"radius\": 0.125", "\"radius\": 1, \"radius\": 1",
     "inclusion 0: field 'radius' stands twice"},
    {"\"radius\": 0.125", "\"radus\": 0.125", "inclusion 0: unknown field 'radus'; known are"},
    {", \"radius\": 0.125", "", "inclusion 0: field 'radius' of a sphere is missing"},
    {"\"radius\": 0.125", "\"radius\": 0.125, \"axis\": [0, 0, 1]",
     "inclusion 0: field 'axis' does not belong to a sphere"},
    {"[0.5, 0.5, 0.5]", "[0.5, 0.5]",
     "inclusion 0: center of a sphere must have 3 numbers, found 2"},
    {"[0.5, 0.5, 0.5]", "[0.5, 0.5, 0.5, 0.5, 0.5]", "inclusion 0: center has too many numbers"},
    {"[0.5, 0.5, 0.5]", "[0.5, [0.5], 0.5]", "inclusion 0: center must be an array of numbers"},
    {"[0.5, 0.5, 0.5]", "[]", "inclusion 0: center is empty"},
    {"[0.5, 0.5, 0.5]", "0.5", "inclusion 0: center must be an array of numbers"},
    {"[0.5, 0.5, 0.5]", "[1, 0.5, 0.5]", "inclusion 0: center[0] = 1"},
    {"\"sphere\"", "\"ball\"", "inclusion 0: unknown shape 'ball'; known are sphere"},
    {"\"sphere\"", "\"disk\"", "inclusion 0: center of a disk must have 2 numbers, found 3"},
    {"\"sphere\"", "3", "inclusion 0: shape must be text"},
    {"\"shape\": \"sphere\", ", "", "inclusion 0: field 'shape' is missing"},
    {"\"group\": \"a\", ", "", "inclusion 0: field 'group' is missing"},
    {"\"group\": \"a\"", "\"group\": 0", "inclusion 0: group must be text"},
    {"\"half_length\": 0.5", "\"half_length\": -0.5", "inclusion 1: half_length = -0.5"},
    {"[0, 0, 1]", "[0, 0, 1.00001]", "inclusion 1: axis has length"},
    {"[0, 0, 1]", "[0, 0, 0]", "inclusion 1: axis has length 0"},
    {"[1, 0, 0, 0]", "[1, 0, 0.1, 0]", "inclusion 2: quaternion has length"},
    {"[0.1, 0.2, 0.3], \"q", "[0.1, 0, 0.3], \"q", "inclusion 2: axes[1] = 0"},
    {"    { \"group\": \"a\"", "    5, { \"group\": \"a\"", "inclusion 0: must be an object"},
    {"\"inclusions\": [", "\"inclusions\": 3, \"x\": [", "inclusions: must be an array"},
    {"\"count\": 3,", "", "certificate: field 'count' is missing"},
    {"\"count\": 3", "\"count\": 3.5", "certificate.count: must be an integer"},
    {"\"count\": 3", "\"count\": -3", "certificate.count = -3"},
    {"\"count\": 1", "\"count\": 1, \"x\": 1", "certificate.groups[0]: unknown field 'x'"},
    {"\"smallest_gap\": null", "\"smallest_gap\": \"inf\"",
     "certificate.smallest_gap: must be a number"},
    {"[0, 1], \"worst_image\"", "[0, -2], \"worst_image\"", "certificate.worst_pair[1] = -2"},
    {"[0, 0, -1]", "[0, 0, 3000000000]", "certificate.worst_image = 3000000000 is out of range"},
    {"\"seed\": 7", "\"seed\": -7", "provenance.seed: must be an integer, 0 to 2^64 - 1"},
    {"\"seconds\": 1.5", "\"seconds\": -1.5", "provenance.seconds = -1.5"},
    {"{ \"x\": [1] }", "\"x\"", "provenance.recipe: must be an object"},
    {"\"rsa\"", "\"r\\u0000sa\"", "provenance.method holds a zero byte"},
    {"{ \"x\": [1] }", "{ \"x\": [1], \"x\": 2 }", "field 'x' stands twice"},
    {"0.125 },", "0.125 }", "packing.json, line 8, column 5: syntax error"},
    {"\"groups\": [\"a\"", "\"groups\": [\"\xff\"", "line 5, column 15: syntax error"},
};

TEST_CASE("malformed JSON packings are refused with the file, the place and the field") {
  CHECK(packing_from_json(kValid, "packing.json").inclusions.size() == 3);
  for (const Damage& damage : kDamages) {
    std::string text = kValid;
    const auto place = text.find(damage.what);
    REQUIRE(place != std::string::npos);
    text.replace(place, std::string(damage.what).size(), damage.with);
    INFO(damage.what << " -> " << damage.with);
    try {
      static_cast<void>(packing_from_json(text, "packing.json"));
      FAIL_CHECK("accepted");
    } catch (const FileError& problem) {
      CHECK_THAT(problem.what(), Catch::Contains(damage.message));
      CHECK_THAT(problem.what(), Catch::StartsWith("packing.json"));
    }
  }
}

TEST_CASE("texts that are not one JSON object are refused") {
  const std::string valid = kValid;
  const std::string deep(100'000, '[');
  for (const std::string& text : {std::string(), std::string("[]"), std::string("3"), valid + "x",
                                  valid + valid, deep, "{\"provenance\": " + deep}) {
    CHECK_THROWS_AS(packing_from_json(text, "text"), FileError);
  }
}

TEST_CASE("what a file could not give back is not written") {
  const Packing good = test::random_packing(3, 3, 1);
  const auto refused = [&](auto&& change, const char* message) {
    Packing packing = good;
    change(packing);
    CHECK_THROWS_AS(packing_to_json(packing), InvalidArgument);
    CHECK_THROWS_WITH(packing_to_json(packing), Catch::Contains(message));
  };
  refused([](Packing& p) { p.groups[1] = p.groups[0]; }, "groups[1] = 'first' stands twice");
  refused([](Packing& p) { p.groups[0] = std::string("\xff"); }, "groups[0] is not UTF-8");
  refused([](Packing& p) { p.groups[0].push_back('\0'); }, "groups[0] holds a zero byte");
  refused([](Packing& p) { p.inclusions[2].group = 9; }, "inclusion 2: group 9");
  refused([](Packing& p) { p.certificate->smallest_gap = NAN; }, "certificate.smallest_gap");
  refused([](Packing& p) { p.certificate->smallest_gap = -INFINITY; }, "certificate.smallest_gap");
  refused([](Packing& p) { p.certificate->smallest_gap_error = NAN; },
          "certificate.smallest_gap_error = nan, allowed are numbers >= 0");
  refused([](Packing& p) { p.inclusions[1].body = Disk{1}; },
          "shape disk does not belong in a 3D cell");
  refused([](Packing& p) { p.certificate->fraction = INFINITY; }, "certificate.fraction");
  refused([](Packing& p) { p.provenance->recipe_json = std::string("{"); }, "provenance.recipe");
  refused([](Packing& p) { p.provenance->recipe_json = "[1]"; }, "provenance.recipe");
  refused([](Packing& p) { p.provenance->seconds = NAN; }, "provenance.seconds");
}

TEST_CASE("files are chosen by their ending, and others are refused") {
  const test::TemporaryFolder folder;
  const Packing packing = test::random_packing(2, 5, 2);
  for (const char* name : {"a.json", "a.h5"}) {
    write_packing(folder / name, packing);
    CHECK(test::same_bits(read_packing(folder / name), packing));
  }
  CHECK(is_packing_file_name("x/a.h5"));
  CHECK_FALSE(is_packing_file_name("a.toml"));
  CHECK_THROWS_WITH(write_packing("a.toml", packing), "a.toml: packing files end in .json or .h5");
  CHECK_THROWS_WITH(read_packing(folder / "b.json"), Catch::Contains("No such file or directory"));
  CHECK_THROWS_WITH(read_packing(folder / "b.h5"), Catch::Contains("No such file or directory"));
  CHECK_THROWS_AS(read_packing(folder.path()), FileError);
}

}  // namespace
}  // namespace packstone
