#include "packstone/core/shuffle.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <vector>

namespace packstone {

TEST_CASE("every order is as likely as any other") {
  constexpr int kRounds = 24000;
  std::map<std::vector<int>, int> seen;
  RandomStream random(5, StreamId::test);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<int> things{1, 2, 3, 4};
    shuffle(things, random);
    ++seen[things];
  }
  REQUIRE(seen.size() == 24);
  double chi_sq = 0.0;
  for (const auto& [order, count] : seen) chi_sq += std::pow(count - 1000.0, 2) / 1000.0;
  CHECK(chi_sq < 49.7);  // 23 degrees of freedom, 0.1 %.
}

TEST_CASE("nothing, and a single thing, stay as they are and take no numbers") {
  RandomStream random(5, StreamId::test), other(5, StreamId::test);
  std::vector<int> none, one{7};
  shuffle(none, random);
  shuffle(one, random);
  CHECK(none.empty());
  CHECK(one == std::vector<int>{7});
  CHECK(random.bits() == other.bits());
}

}  // namespace packstone
