#include <catch2/catch.hpp>
#include <string>

#include "support/corpus.hpp"
#include "support/recipe_oracle.hpp"

namespace packstone {
namespace {

TEST_CASE("the reader of recipes holds on the kept corpus of its fuzz target") {
  test::replay_corpus(PACKSTONE_FUZZ_CORPUS "recipe", 12, test::recipe_reader_holds);
}

TEST_CASE("the reader of recipes holds on a text cut short anywhere") {
  const std::string whole = test::content_of(PACKSTONE_FUZZ_CORPUS "recipe/all_3d.toml");
  REQUIRE(test::recipe_reader_holds(whole));
  const std::size_t first_group = whole.find("[[inclusions]]");
  const std::size_t second_group = whole.find("[[inclusions]]", first_group + 1);
  CHECK(test::recipe_reader_holds(whole.substr(0, second_group)));
  for (std::size_t bytes = 0; bytes < whole.size(); bytes += 7) {
    const bool accepted = test::recipe_reader_holds(whole.substr(0, bytes));
    if (bytes <= first_group) CHECK_FALSE(accepted);
  }
}

}  // namespace
}  // namespace packstone
