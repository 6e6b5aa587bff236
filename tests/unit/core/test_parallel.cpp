#include <atomic>
#include <catch2/catch.hpp>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "packstone/core/parallel.hpp"

namespace packstone {
namespace {

TEST_CASE("every index is visited once, for any number of threads and any grain") {
  for (int threads : {0, 1, 2, 3, 8}) {
    for (std::int64_t grain : {1, 7, 1000}) {
      std::vector<std::atomic<int>> visits(777);
      parallel_for(777, threads, grain, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
      });
      for (const auto& count : visits) REQUIRE(count == 1);
    }
  }
}

TEST_CASE("no work means no call") {
  parallel_for(0, 4, 1, [](std::int64_t, std::int64_t) { FAIL("called"); });
}

TEST_CASE("an exception in a worker reaches the caller") {
  CHECK_THROWS_AS(parallel_for(100, 2, 1,
                               [](std::int64_t begin, std::int64_t) {
                                 if (begin > 50) throw std::runtime_error("at work");
                               }),
                  std::runtime_error);
}

}  // namespace
}  // namespace packstone
