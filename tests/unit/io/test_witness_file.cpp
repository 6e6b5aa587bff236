#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>
#include <vector>

#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"
#include "packstone/io/packing_file.hpp"
#include "packstone/io/witness_file.hpp"
#include "packstone/structure/check_packing.hpp"
#include "support/random_body.hpp"
#include "support/temporary_folder.hpp"

using namespace packstone;

namespace {

constexpr const char* kHead = "# packstone-witness 1\n";

// As many random bodies as `throws` leave apart, of all shapes.
Packing certified_packing(int dimension, int throws) {
  RandomStream random(5, StreamId::test, static_cast<std::uint64_t>(dimension));
  Packing packing;
  if (dimension == 2) packing.cell = cell_2d(1, 1);
  packing.groups = {"all"};
  for (int k = 0; k < throws; ++k) {
    const Vec3 center{random.uniform(), random.uniform(), dimension == 3 ? random.uniform() : 0.0};
    const Body body = test::random_body(test::random_shape(dimension, random), random,
                                        [&] { return random.uniform(0.03, 0.25); });
    packing.inclusions.push_back({center, body, 0});
    if (!check_packing(packing).passed()) packing.inclusions.pop_back();
  }
  return packing;
}

// A Python that has NumPy; empty where there is none.
std::string python_with_numpy() {
  for (const std::string python : {"python3", "/usr/bin/python3"}) {
    if (std::system((python + " -c 'import numpy' >/dev/null 2>&1").c_str()) == 0) return python;
  }
  return {};
}

int recheck(const std::string& python, const test::TemporaryFolder& folder, const Packing& packing,
            const std::vector<PairWitness>& witnesses) {
  write_packing(folder / "packing.json", packing);
  write_witnesses(folder / "witnesses.csv", witnesses);
  const std::string command = python + " '" + PACKSTONE_RECHECK + "' '" +
                              (folder / "packing.json").string() + "' '" +
                              (folder / "witnesses.csv").string() + "' >/dev/null";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("witness files come back to the last bit") {
  const test::TemporaryFolder folder;
  const auto written = separating_directions(certified_packing(3, 60));
  REQUIRE(written.size() > 10);
  write_witnesses(folder / "w.csv", written);
  const auto read = read_witnesses(folder / "w.csv");
  REQUIRE(read.size() == written.size());
  for (std::size_t k = 0; k < read.size(); ++k) {
    CHECK(read[k].a == written[k].a);
    CHECK(read[k].b == written[k].b);
    CHECK(read[k].image == written[k].image);
    CHECK(read[k].direction == written[k].direction);
    CHECK(read[k].gap == written[k].gap);
  }
}

TEST_CASE("the reader of witness files names the line that is wrong") {
  const auto read = [](const std::string& text) { return witnesses_from_text(text, "w.csv"); };
  CHECK(read(std::string(kHead) + "# remark\n\n0,1,0,0,0,1,0,0,0.5").size() == 1);
  CHECK_THROWS_WITH(read("0,1,0,0,0,1,0,0,0.5\n"), Catch::Contains("first line"));
  const auto refused = [&](const std::string& line, const std::string& why) {
    CAPTURE(line);
    CHECK_THROWS_AS(read(kHead + line), FileError);
    CHECK_THROWS_WITH(read(kHead + line), Catch::Contains("w.csv: line 2") && Catch::Contains(why));
  };
  refused("0,1,0,0,0,1,0,0\n", "fewer than 9");
  refused("0,1,0,0,0,1,0,0,0.5,1\n", "more than 9");
  refused("0,1,0,0,0.5,1,0,0,0.5\n", "'0.5'");
  refused("0,1,0,0,0,1,0,x,0.5\n", "'x'");
  refused("0,1,0,0,0,1,0,,0.5\n", "''");
  refused("0,99999999999999999999,0,0,0,1,0,0,0.5\n", "not a number of its kind");
  refused("2,1,0,0,0,1,0,0,0.5\n", "a <= b");
  refused("-1,1,0,0,0,1,0,0,0.5\n", "a <= b");
  refused("0,1,0,0,0,1,0.1,0,0.5\n", "length 1");
  refused("0,1,0,0,0,nan,0,0,0.5\n", "length 1");
  refused("0,1,0,0,0,1,0,0,inf\n", "not finite");
  CHECK_THROWS_AS(read_witnesses("/no/such/file.csv"), FileError);
}

TEST_CASE("the Python reader re-checks a packing, and notices what is wrong or missing") {
  const std::string python = python_with_numpy();
  if (python.empty()) {
    WARN("skipped: no python3 with NumPy here");
    return;
  }
  const test::TemporaryFolder folder;
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    Packing packing = certified_packing(dimension, 300);
    const auto witnesses = separating_directions(packing);
    REQUIRE(witnesses.size() > 5);
    CHECK(recheck(python, folder, packing, witnesses) == 0);

    auto turned = witnesses;
    turned[3].direction = -turned[3].direction;
    CHECK(recheck(python, folder, packing, turned) == 1);

    // The closest boxes certainly meet; a box pair at the very margin may be listed needlessly.
    auto missing = witnesses;
    missing.erase(std::min_element(missing.begin(), missing.end(),
                                   [](const auto& x, const auto& y) { return x.gap < y.gap; }));
    CHECK(recheck(python, folder, packing, missing) == 1);

    packing.inclusions[witnesses[0].b] = packing.inclusions[witnesses[0].a];
    CHECK(recheck(python, folder, packing, separating_directions(packing)) == 1);
  }
}
