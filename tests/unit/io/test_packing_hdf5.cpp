#include <hdf5.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "packstone/core/error.hpp"
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

TEST_CASE("the same packing makes the same HDF5 file, byte for byte, a second later too") {
  const test::TemporaryFolder folder;
  const Packing packing = test::random_packing(3, 50, 6);
  write_packing(folder / "a.h5", packing);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
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

// Replaces a dataset by one of `type` and `sizes` that holds zeros, or `data`.
void put(hid_t file, const char* name, hid_t type, const std::vector<hsize_t>& sizes,
         const void* data = nullptr) {
  if (H5Lexists(file, name, H5P_DEFAULT) > 0) H5Ldelete(file, name, H5P_DEFAULT);
  const hid_t space = sizes.empty()
                          ? H5Screate(H5S_SCALAR)
                          : H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr);
  const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (data != nullptr) H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
  H5Dclose(set);
  H5Sclose(space);
}

void put_attribute(hid_t file, const char* name, hid_t type, const std::vector<hsize_t>& sizes) {
  H5Adelete(file, name);
  const hid_t space = sizes.empty()
                          ? H5Screate(H5S_SCALAR)
                          : H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr);
  H5Aclose(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
  H5Sclose(space);
}

// An enumeration that gives a word another number.
hid_t swapped_flags() {
  const hid_t type = H5Tenum_create(H5T_NATIVE_INT8);
  std::int8_t value = 1;
  H5Tenum_insert(type, "FALSE", &value);
  value = 0;
  H5Tenum_insert(type, "TRUE", &value);
  return type;
}

// The longest that the library knows; takes no room in the file as long as nothing is written.
hid_t longest_text() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, std::numeric_limits<std::uint32_t>::max());
  return type;
}

struct Damage {
  const char* what;
  std::function<void(hid_t file)> make;
  const char* message;
};

std::vector<Damage> damages() {
  const auto gone = [](const char* name) {
    return [name](hid_t file) { H5Ldelete(file, name, H5P_DEFAULT); };
  };
  const auto zeros = [](const char* name, hid_t type, std::vector<hsize_t> sizes) {
    return [=](hid_t file) { put(file, name, type, sizes); };
  };
  return {
      {"no format", [](hid_t f) { H5Adelete(f, "format"); }, "attribute 'format' is missing"},
      {"two versions", [](hid_t f) { put_attribute(f, "version", H5T_NATIVE_INT, {2}); },
       "attribute 'version' must be a single value"},
      {"a format that is a number", [](hid_t f) { put_attribute(f, "format", H5T_NATIVE_INT, {}); },
       "attribute 'format' must be a short text"},
      {"a version that is no integer",
       [](hid_t f) { put_attribute(f, "version", H5T_NATIVE_DOUBLE, {}); },
       "version: must be an integer"},
      {"version 0", [](hid_t f) { put_attribute(f, "version", H5T_NATIVE_INT, {}); },
       "version 0 is unknown"},
      {"no center", gone("inclusions/center"), "inclusions/center: is missing"},
      {"no cell", gone("cell"), "cell: is missing"},
      {"a table of sizes", zeros("cell/size", H5T_NATIVE_DOUBLE, {3, 1}),
       "cell/size: must be a list"},
      {"a cube of sizes", zeros("cell/size", H5T_NATIVE_DOUBLE, {3, 1, 1}),
       "cell/size: must be a number, a list or a table"},
      {"integer sizes", zeros("cell/size", H5T_NATIVE_INT, {3}),
       "cell/size: must be of type double"},
      {"flags that are swapped", [](hid_t f) { put(f, "cell/periodic", swapped_flags(), {3}); },
       "the enumeration gives 'FALSE' the value 1"},
      {"flags of floats", zeros("cell/periodic", H5T_NATIVE_DOUBLE, {3}),
       "cell/periodic: must be of an integer type"},
      {"too few centers", zeros("inclusions/center", H5T_NATIVE_DOUBLE, {2, 3}),
       "inclusions/center: must have size 20 x 3, found 2 x 3"},
      {"an unknown shape",
       [](hid_t f) {
         const std::vector<std::int32_t> shapes(20, 9);
         put(f, "inclusions/shape", H5T_NATIVE_INT, {20}, shapes.data());
       },
       "inclusion 0: unknown shape 9"},
      {"a field too many", zeros("cell/color", H5T_NATIVE_INT, {}), "cell/color: unknown field"},
      {"a radius of what has none",
       [](hid_t f) {
         const std::vector<double> ones(20, 1.0);
         put(f, "inclusions/angle", H5T_NATIVE_DOUBLE, {20}, ones.data());
       },
       "inclusions/angle: unknown field"},
      {"a link",
       [](hid_t f) {
         H5Ldelete(f, "groups", H5P_DEFAULT);
         H5Lcreate_soft("/cell/size", f, "groups", H5P_DEFAULT, H5P_DEFAULT);
       },
       "groups: is a link"},
      {"a list longer than its file", zeros("inclusions/radius", H5T_NATIVE_DOUBLE, {1U << 31}),
       "inclusions/radius: is larger than its file"},
      {"a text longer than its file",
       [](hid_t f) { put(f, "provenance/method", longest_text(), {}); },
       "provenance/method: is larger than its file"},
      {"a negative seed",
       [](hid_t f) {
         const std::int64_t seed = -1;
         put(f, "provenance/seed", H5T_NATIVE_INT64, {}, &seed);
       },
       "provenance/seed: -1 is negative"},
      {"a count beyond all",
       [](hid_t f) {
         const std::uint64_t count = ~std::uint64_t{0};
         put(f, "certificate/count", H5T_NATIVE_UINT64, {}, &count);
       },
       "certificate/count: 18446744073709551615 is too large"},
      {"an image beyond all",
       [](hid_t f) {
         const std::int64_t image[] = {0, 0, std::int64_t{1} << 40};
         put(f, "certificate/worst_image", H5T_NATIVE_INT64, {3}, image);
       },
       "certificate/worst_image = 1099511627776 is out of range"},
      {"two fractions", zeros("certificate/fraction", H5T_NATIVE_DOUBLE, {2}),
       "certificate/fraction: must have size a single value, found 2"},
      {"a method that is a number", zeros("provenance/method", H5T_NATIVE_INT, {}),
       "provenance/method: must be text"},
      {"a filter of its own",
       [](hid_t f) {
         H5Ldelete(f, "inclusions/group", H5P_DEFAULT);
         const hsize_t size = 20;
         const hid_t space = H5Screate_simple(1, &size, nullptr);
         const hid_t plist = H5Pcreate(H5P_DATASET_CREATE);
         H5Pset_chunk(plist, 1, &size);
         H5Pset_scaleoffset(plist, H5Z_SO_INT, 0);
         H5Dclose(H5Dcreate2(f, "inclusions/group", H5T_NATIVE_INT, space, H5P_DEFAULT, plist,
                             H5P_DEFAULT));
       },
       "inclusions/group: is packed with a filter other than"},
      {"values in another file",
       [](hid_t f) {
         H5Ldelete(f, "inclusions/group", H5P_DEFAULT);
         const hsize_t size = 20;
         const hid_t space = H5Screate_simple(1, &size, nullptr);
         const hid_t plist = H5Pcreate(H5P_DATASET_CREATE);
         H5Pset_external(plist, "elsewhere.bin", 0, 80);
         H5Dclose(H5Dcreate2(f, "inclusions/group", H5T_NATIVE_INT, space, H5P_DEFAULT, plist,
                             H5P_DEFAULT));
       },
       "inclusions/group: keeps its values in another file"},
  };
}

TEST_CASE("HDF5 packings that are not as documented are refused with the file and the field") {
  const test::TemporaryFolder folder;
  const auto path = folder / "packing.h5";
  for (const Damage& damage : damages()) {
    write_packing(path, test::random_packing(3, 20, 11));
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    REQUIRE(file >= 0);
    damage.make(file);
    H5Fclose(file);
    INFO(damage.what);
    try {
      static_cast<void>(read_packing(path));
      FAIL_CHECK("accepted");
    } catch (const FileError& problem) {
      CHECK_THAT(problem.what(), Catch::StartsWith(path.string()));
      CHECK_THAT(problem.what(), Catch::Contains(damage.message));
    }
  }
}

}  // namespace
}  // namespace packstone
