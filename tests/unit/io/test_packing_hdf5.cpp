#include <catch2/catch.hpp>

#include "packstone/io/packing_file.hpp"
#include "support/python.hpp"
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

TEST_CASE("h5py reads from the HDF5 file what the JSON file says") {
  const test::TemporaryFolder folder;
  for (int dimension = 2; dimension <= 3; ++dimension) {
    const Packing packing = test::random_packing(dimension, 100, 7);
    write_packing(folder / "packing.h5", packing);
    write_packing(folder / "packing.json", packing);
    test::run_python("compare_h5.py",
                     (folder / "packing.h5").string() + " " + (folder / "packing.json").string());
  }
}

TEST_CASE("a file that h5py wrote the plain way is read") {
  const Packing packing =
      read_packing(std::string(PACKSTONE_FUZZ_CORPUS) + "packing_hdf5/by_h5py.h5");
  CHECK(packing.cell == Cell{3, {1, 2, 3}, {true, true, false}});
  CHECK(packing.groups == std::vector<std::string>{"balls", "rods"});
  const std::vector<Inclusion> expected{{{0.1, 0.2, 0.3}, Sphere{0.1}, 0},
                                        {{0.5, 0.5, 0.5}, Cylinder{0.05, 0.2, {0, 0, 1}}, 1}};
  CHECK(packing.inclusions == expected);
}

}  // namespace
}  // namespace packstone
