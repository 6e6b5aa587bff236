#include "packstone/io/checkpoint_file.hpp"

#include <hdf5.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <string>

#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/io/packing_file.hpp"
#include "support/random_packing.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

Vec3 random_vector(RandomStream& random) {
  return {random.normal(), -random.uniform() * 1e-300, random.bits() % 2 == 0 ? 0.0 : -0.0};
}

MovingPacking random_motion(int dimension, int count, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test, 7);
  MovingPacking moving;
  moving.packing = test::random_packing(dimension, count, seed);
  moving.size_factor = random.uniform() + 1e-9;
  for (int i = 0; i < count; ++i) {
    moving.velocity.push_back(random_vector(random));
    moving.angular_velocity.push_back(random_vector(random));
  }
  moving.numbers = {{"time", random.uniform()}, {"never", INFINITY}, {"zero", -0.0}, {"", 1e-310}};
  return moving;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const auto bits = [](const Vec3& v, std::size_t axis) {
    return std::bit_cast<std::uint64_t>(v[axis]);
  };
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (bits(a[i], axis) != bits(b[i], axis)) return false;
    }
  }
  return true;
}

bool same_bits(const MovingPacking& a, const MovingPacking& b) {
  if (a.numbers.size() != b.numbers.size()) return false;
  for (std::size_t i = 0; i < a.numbers.size(); ++i) {
    if (a.numbers[i].first != b.numbers[i].first) return false;
    if (std::bit_cast<std::uint64_t>(a.numbers[i].second) !=
        std::bit_cast<std::uint64_t>(b.numbers[i].second)) {
      return false;
    }
  }
  return test::same_bits(a.packing, b.packing) && a.size_factor == b.size_factor &&
         same_bits(a.velocity, b.velocity) && same_bits(a.angular_velocity, b.angular_velocity);
}

TEST_CASE("inclusions in motion come back from their checkpoint bit for bit") {
  const test::TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MovingPacking moving = random_motion(seed % 2 == 0 ? 2 : 3, 30, seed);
    write_checkpoint(folder / "c.h5", moving);
    REQUIRE(same_bits(read_checkpoint(folder / "c.h5"), moving));
  }
  MovingPacking bare = random_motion(3, 0, 1);
  bare.packing.provenance.reset();
  bare.packing.certificate.reset();
  bare.numbers.clear();
  write_checkpoint(folder / "c.h5", bare);
  CHECK(same_bits(read_checkpoint(folder / "c.h5"), bare));
}

TEST_CASE("a checkpoint and a packing are not taken for each other") {
  const test::TemporaryFolder folder;
  const MovingPacking moving = random_motion(3, 5, 3);
  write_checkpoint(folder / "c.h5", moving);
  write_packing(folder / "p.h5", moving.packing);
  CHECK_THROWS_WITH(read_packing(folder / "c.h5"),
                    Catch::Contains("c.h5: format is 'packstone-checkpoint', not a packing file"));
  CHECK_THROWS_WITH(read_checkpoint(folder / "p.h5"),
                    Catch::Contains("p.h5: format is 'packstone-packing', not a checkpoint"));
}

TEST_CASE("checkpoints end in .h5, are there, and are HDF5") {
  const test::TemporaryFolder folder;
  CHECK(is_checkpoint_file_name("x/c.h5"));
  CHECK_FALSE(is_checkpoint_file_name("c.json"));
  CHECK_THROWS_WITH(write_checkpoint("c.json", random_motion(2, 1, 1)),
                    "c.json: checkpoints end in .h5");
  CHECK_THROWS_AS(read_checkpoint("c.json"), FileError);
  CHECK_THROWS_WITH(read_checkpoint(folder / "none.h5"),
                    Catch::Contains("none.h5: cannot be read: No such file"));
  std::ofstream(folder / "text.h5") << "hello";
  CHECK_THROWS_WITH(read_checkpoint(folder / "text.h5"),
                    Catch::Contains("text.h5: not a checkpoint"));
  CHECK_THROWS_WITH(read_checkpoint(std::string(PACKSTONE_FUZZ_CORPUS) + "packing_hdf5/by_h5py.h5"),
                    Catch::Contains("by_h5py.h5: not a checkpoint: no HDF5 with checksums"));
}

// Replaces what stands at `name` by a list of `rows` numbers, a single one for 0.
void put_numbers(hid_t file, const char* name, const std::vector<hsize_t>& sizes, double value) {
  if (H5Lexists(file, name, H5P_DEFAULT) > 0) H5Ldelete(file, name, H5P_DEFAULT);
  hsize_t count = 1;
  for (const hsize_t size : sizes) count *= size;
  const hid_t space = sizes.empty()
                          ? H5Screate(H5S_SCALAR)
                          : H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr);
  const hid_t set =
      H5Dcreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const std::vector<double> values(count, value);
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Dclose(set);
  H5Sclose(space);
}

TEST_CASE("malformed checkpoints are refused with the file and the field") {
  struct Damage {
    std::function<void(hid_t)> make;
    const char* message;
  };
  const auto gone = [](const char* name) {
    return [name](hid_t file) { H5Ldelete(file, name, H5P_DEFAULT); };
  };
  const auto put = [](const char* name, const std::vector<hsize_t>& sizes, double value) {
    return [=](hid_t file) { put_numbers(file, name, sizes, value); };
  };
  const Damage damages[] = {
      {gone("motion"), "motion: is missing"},
      {gone("motion/velocity"), "motion/velocity: is missing"},
      {gone("motion/numbers/value"), "motion/numbers/value: is missing"},
      {gone("inclusions/center"), "inclusions/center: is missing"},
      {put("motion/extra", {}, 1.0), "motion/extra: unknown field"},
      {put("motion/size_factor", {}, 0.0), "size_factor = 0, allowed are finite numbers > 0"},
      {put("motion/size_factor", {2}, 1.0), "motion/size_factor: must have size a single value"},
      {put("motion/velocity", {3, 3}, 1.0), "motion/velocity: must have size 4 x 3, found 3 x 3"},
      {put("motion/velocity", {4, 3}, NAN), "inclusion 0: velocity[0] = nan"},
      {put("motion/angular_velocity", {4, 2}, 1.0), "motion/angular_velocity: must have size"},
      {put("motion/numbers/value", {3}, 1.0), "motion/numbers/value: must have size 4, found 3"},
  };
  const test::TemporaryFolder folder;
  for (const Damage& damage : damages) {
    write_checkpoint(folder / "c.h5", random_motion(3, 4, 5));
    const hid_t file = H5Fopen((folder / "c.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    damage.make(file);
    H5Fclose(file);
    INFO(damage.message);
    CHECK_THROWS_AS(read_checkpoint(folder / "c.h5"), FileError);
    CHECK_THROWS_WITH(read_checkpoint(folder / "c.h5"),
                      Catch::Contains("c.h5: ") && Catch::Contains(damage.message));
  }
}

TEST_CASE("what a checkpoint could not give back is not written, and the old one stays") {
  const test::TemporaryFolder folder;
  const MovingPacking good = random_motion(2, 3, 9);
  write_checkpoint(folder / "c.h5", good);
  const auto refused = [&](auto&& change, const char* message) {
    MovingPacking moving = good;
    change(moving);
    CHECK_THROWS_AS(write_checkpoint(folder / "c.h5", moving), InvalidArgument);
    CHECK_THROWS_WITH(write_checkpoint(folder / "c.h5", moving), Catch::Contains(message));
  };
  refused([](MovingPacking& m) { m.velocity.pop_back(); }, "velocity: has 2 vectors");
  refused([](MovingPacking& m) { m.size_factor = 0.0; }, "size_factor = 0");
  refused([](MovingPacking& m) { m.numbers[1].first = std::string("a\0b", 3); },
          "numbers[1] holds a zero byte");
  refused([](MovingPacking& m) { m.packing.groups[1] = m.packing.groups[0]; }, "stands twice");
  CHECK(same_bits(read_checkpoint(folder / "c.h5"), good));
}

}  // namespace
}  // namespace packstone
