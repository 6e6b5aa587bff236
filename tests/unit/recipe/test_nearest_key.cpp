#include <catch2/catch.hpp>

#include "recipe/nearest_key.hpp"

using packstone::recipe::edit_distance;
using packstone::recipe::nearest_key;

TEST_CASE("the edit distance counts insertions, deletions, exchanges and swaps of neighbors") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("seed", "seed") == 0);
  CHECK(edit_distance("sed", "seed") == 1);
  CHECK(edit_distance("seeed", "seed") == 1);
  CHECK(edit_distance("seek", "seed") == 1);
  CHECK(edit_distance("sede", "seed") == 1);
  CHECK(edit_distance("", "seed") == 4);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("the edit distance is symmetric") {
  for (const char* a : {"fraction", "fractoin", "count", "x", ""}) {
    for (const char* b : {"fraction", "min_gap", "cuont"}) {
      CHECK(edit_distance(a, b) == edit_distance(b, a));
    }
  }
}

TEST_CASE("the nearest key is told for a slip, and none for another word") {
  const std::vector<std::string_view> known{"count", "fraction", "aspect", "orientation", "seed"};
  CHECK(nearest_key("cuont", known) == "count");
  CHECK(nearest_key("fractoin", known) == "fraction");
  CHECK(nearest_key("orient", known) == "orientation");
  CHECK(nearest_key("sed", known) == "seed");
  CHECK_FALSE(nearest_key("temperature", known).has_value());
  CHECK_FALSE(nearest_key("q", known).has_value());
}
