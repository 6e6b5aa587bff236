#include <catch2/catch.hpp>

#include "packstone/io/packing_file.hpp"
#include "support/random_packing.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

Packing through_file(const Packing& packing) {
  const test::TemporaryFolder folder;
  write_packing(folder / "packing.h5", packing);
  return read_packing(folder / "packing.h5");
}

TEST_CASE("a packing of any shape comes back from its HDF5 file bit for bit") {
  for (int shape = 0; shape < 6; ++shape) {
    const auto kind = static_cast<ShapeKind>(shape);
    const Packing packing = test::random_packing(dimension(kind), 200, 300 + shape, kind);
    REQUIRE(test::same_bits(through_file(packing), packing));
  }
}

TEST_CASE("mixed packings come back from their HDF5 file bit for bit") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Packing packing = test::random_packing(seed % 2 == 0 ? 2 : 3, 20, 400 + seed);
    REQUIRE(test::same_bits(through_file(packing), packing));
  }
}

TEST_CASE("a packing without inclusions, certificate and provenance comes back from HDF5") {
  for (int dimension = 2; dimension <= 3; ++dimension) {
    Packing packing = test::random_packing(dimension, 0, 5);
    packing.certificate.reset();
    packing.provenance.reset();
    REQUIRE(test::same_bits(through_file(packing), packing));
    packing.groups.clear();
    REQUIRE(test::same_bits(through_file(packing), packing));
  }
}

TEST_CASE("the same packing makes the same HDF5 file, byte for byte") {
  const test::TemporaryFolder folder;
  const Packing packing = test::random_packing(3, 50, 6);
  write_packing(folder / "a.h5", packing);
  write_packing(folder / "b.h5", packing);
  REQUIRE(test::content_of(folder / "a.h5") == test::content_of(folder / "b.h5"));
}

}  // namespace
}  // namespace packstone
