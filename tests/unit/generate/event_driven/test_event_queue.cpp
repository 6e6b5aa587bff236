#include "generate/event_driven/event_queue.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <set>
#include <utility>

#include "packstone/core/random.hpp"

namespace packstone::event_driven {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// All bodies in the order of their times, of equal times the lower number first.
class SortedTimes {
 public:
  explicit SortedTimes(std::int32_t bodies) : time_(static_cast<std::size_t>(bodies), kNever) {
    for (std::int32_t i = 0; i < bodies; ++i) order_.insert({kNever, i});
  }
  void set(std::int32_t body, double time) {
    double& kept = time_[static_cast<std::size_t>(body)];
    order_.erase({kept, body});
    kept = time;
    order_.insert({time, body});
  }
  [[nodiscard]] std::int32_t next() const { return order_.begin()->second; }
  [[nodiscard]] double time(std::int32_t body) const {
    return time_[static_cast<std::size_t>(body)];
  }

 private:
  std::vector<double> time_;
  std::set<std::pair<double, std::int32_t>> order_;
};

}  // namespace

TEST_CASE("the queue of events names the earliest one, as a sorted list does") {
  for (const std::int32_t bodies : {1, 2, 3, 7, 8, 9, 64, 1000}) {
    CAPTURE(bodies);
    RandomStream random(1, StreamId::test, static_cast<std::uint64_t>(bodies));
    EventQueue queue;
    queue.reset(bodies);
    SortedTimes sorted(bodies);
    CHECK(queue.next() == 0);
    for (int k = 0; k < 5000; ++k) {
      const auto body = static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(bodies)));
      // One time of many is among a few that come up again and again, or never.
      const double time = random.below(4) == 0   ? static_cast<double>(random.below(3))
                          : random.below(9) == 0 ? kNever
                                                 : random.uniform();
      queue.set(body, time);
      sorted.set(body, time);
      REQUIRE(queue.next() == sorted.next());
      REQUIRE(queue.time(queue.next()) == sorted.time(sorted.next()));
    }
  }
}

TEST_CASE("the queue of events gives equal times to the lower number, whatever came first") {
  EventQueue queue;
  queue.reset(6);
  for (const std::int32_t body : {4, 1, 5, 2}) queue.set(body, 0.5);
  CHECK(queue.next() == 1);
  queue.set(1, kNever);
  CHECK(queue.next() == 2);
  queue.set(0, 0.5);
  CHECK(queue.next() == 0);
}

TEST_CASE("the queue of events takes them off in order, as a simulation does") {
  constexpr std::int32_t kBodies = 37;
  RandomStream random(2, StreamId::test);
  EventQueue queue;
  queue.reset(kBodies);
  for (std::int32_t i = 0; i < kBodies; ++i) queue.set(i, random.uniform());
  double now = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const std::int32_t i = queue.next();
    REQUIRE(queue.time(i) >= now);
    now = queue.time(i);
    queue.set(i, now + random.uniform());
    // Somebody else's event may come sooner, or be put off.
    queue.set(static_cast<std::int32_t>(random.below(kBodies)), now + random.uniform());
  }
}

TEST_CASE("an emptied queue of events remembers nothing") {
  EventQueue queue;
  queue.reset(5);
  queue.set(3, -1.0);
  queue.reset(9);
  CHECK(queue.next() == 0);
  for (std::int32_t i = 0; i < 9; ++i) CHECK(queue.time(i) == kNever);
}

}  // namespace packstone::event_driven
