#include <catch2/catch.hpp>
#include <string>

#include "support/corpus.hpp"
#include "support/reader_oracles.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

const std::string kCorpus = PACKSTONE_FUZZ_CORPUS;

TEST_CASE("the JSON reader holds on the kept corpus of its fuzz target") {
  test::replay_corpus(kCorpus + "packing_json", 10, test::json_reader_holds);
}

TEST_CASE("the HDF5 reader holds on the kept corpus of its fuzz target") {
  test::replay_corpus(kCorpus + "packing_hdf5", 12, test::hdf5_reader_holds);
}

TEST_CASE("the reader of checkpoints holds on the kept corpus of its fuzz target") {
  test::replay_corpus(kCorpus + "checkpoint", 5, test::checkpoint_reader_holds);
}

TEST_CASE("the HDF5 reader refuses a file cut short anywhere") {
  const std::string whole = test::content_of(kCorpus + "packing_hdf5/mixed_3d.h5");
  REQUIRE(test::hdf5_reader_holds(whole));
  for (std::size_t bytes = 0; bytes < whole.size(); bytes += 97) {
    CHECK_FALSE(test::hdf5_reader_holds(std::string_view(whole).substr(0, bytes)));
  }
}

TEST_CASE("the reader of checkpoints refuses a file cut short anywhere") {
  const std::string whole = test::content_of(kCorpus + "checkpoint/mixed_3d.h5");
  REQUIRE(test::checkpoint_reader_holds(whole));
  for (std::size_t bytes = 0; bytes < whole.size(); bytes += 97) {
    CHECK_FALSE(test::checkpoint_reader_holds(std::string_view(whole).substr(0, bytes)));
  }
}

TEST_CASE("the JSON reader refuses a text cut short anywhere") {
  const std::string whole = test::content_of(kCorpus + "packing_json/mixed_3d.json");
  const std::size_t end = whole.rfind('}');
  for (std::size_t bytes = 0; bytes <= end; bytes += 7) {
    CHECK_FALSE(test::json_reader_holds(std::string_view(whole).substr(0, bytes)));
  }
}

}  // namespace
}  // namespace packstone
