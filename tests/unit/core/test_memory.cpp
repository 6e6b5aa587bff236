#include "packstone/core/memory.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <string>

TEST_CASE("physical memory is what the kernel says, in bytes") {
  std::ifstream file("/proc/meminfo");
  std::string word;
  double kilobytes = 0.0;
  file >> word >> kilobytes;
  REQUIRE(word == "MemTotal:");
  CHECK(packstone::physical_memory() == Approx(1024.0 * kilobytes).epsilon(1e-3));
}
