#include <catch2/catch.hpp>
#include <filesystem>

#include "support/reader_oracles.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

// Seeds are valid files; what the fuzzers once found has a name that begins with "found_".
template <class Holds>
void replay(const std::string& corpus, Holds holds) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PACKSTONE_FUZZ_CORPUS + corpus)) {
    INFO(entry.path().string());
    const bool accepted = holds(test::content_of(entry.path()));
    const bool seed = entry.path().filename().string().rfind("found_", 0) != 0;
    CHECK((accepted || !seed));
    ++files;
  }
  CHECK(files >= 9);
}

TEST_CASE("the JSON reader holds on the kept corpus of its fuzz target") {
  replay("packing_json", test::json_reader_holds);
}

TEST_CASE("the HDF5 reader holds on the kept corpus of its fuzz target") {
  replay("packing_hdf5", test::hdf5_reader_holds);
}

TEST_CASE("the HDF5 reader refuses a file cut short anywhere") {
  const std::string whole =
      test::content_of(std::string(PACKSTONE_FUZZ_CORPUS) + "packing_hdf5/mixed_3d.h5");
  REQUIRE(test::hdf5_reader_holds(whole));
  for (std::size_t bytes = 0; bytes < whole.size(); bytes += 97) {
    CHECK_FALSE(test::hdf5_reader_holds(std::string_view(whole).substr(0, bytes)));
  }
}

TEST_CASE("the JSON reader refuses a text cut short anywhere") {
  const std::string whole =
      test::content_of(std::string(PACKSTONE_FUZZ_CORPUS) + "packing_json/mixed_3d.json");
  const std::size_t end = whole.rfind('}');
  for (std::size_t bytes = 0; bytes <= end; bytes += 7) {
    CHECK_FALSE(test::json_reader_holds(std::string_view(whole).substr(0, bytes)));
  }
}

}  // namespace
}  // namespace packstone
