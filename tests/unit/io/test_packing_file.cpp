#include "packstone/io/packing_file.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "packstone/core/error.hpp"
#include "support/random_packing.hpp"

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

}  // namespace
}  // namespace packstone
