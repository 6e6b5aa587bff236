#pragma once

/// @file
/// The event loop: one block of events, from one instant at which all clocks stand alike to the
/// next.
///
/// Every body has one event: a collision, the exit from its neighborhood (near_neighbors.hpp), or a
/// look again where a search has proven nothing beyond. The earliest one is carried out, and the
/// bodies it concerns look for their next event; a pair is looked at only up to the earlier event
/// of the other body, since whatever happens there makes it look again. Clocks of bodies are their
/// own: nobody moves but in his own events.

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "generate/event_driven/bodies.hpp"
#include "generate/event_driven/collision.hpp"
#include "generate/event_driven/contact_search.hpp"
#include "generate/event_driven/event_queue.hpp"
#include "generate/event_driven/near_neighbors.hpp"
#include "generate/event_driven/pair_lanes.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/core/run_context.hpp"

namespace packstone::event_driven {

/// Where a block of events ends, whichever comes first.
struct BlockEnd {
  std::int64_t collisions = 0;                                     ///< So many have happened.
  double time = 0.0;                                               ///< [T]
  std::int64_t events = std::numeric_limits<std::int64_t>::max();  ///< So many events have.
};

/// Called now and then with the size factor and the collisions of the block so far.
using Watch = std::function<void(double size, std::int64_t collisions)>;

/// What a block has counted.
struct BlockCount {
  double time = 0.0;  ///< How long it lasted [T].
  std::int64_t collisions = 0;
  std::int64_t wall_collisions = 0;
  std::int64_t predictions = 0;
  std::int64_t neighbor_searches = 0;
  double virial = 0.0;  ///< Sum over collisions of J n.r.
  SearchCount searches;
  double least_gap = 0.0;  ///< The most negative one that looking at all pairs has shown [L].
  StopRequest stop = StopRequest::none;
};

/// Runs blocks of events of `bodies`, which stay where they are.
class Engine {
 public:
  Engine(Bodies& bodies, const Cell& cell);

  /// Clocks stand at 0, and at 0 again afterwards, with the size factor of then. Interrupted, the
  /// block ends where it is. `check_all`: look at all pairs after every event.
  BlockCount run_block(const BlockEnd& end, const RunContext& run, bool check_all,
                       const Watch& watch = {});

  /// The least gap over all pairs and images at time t, infinite when none come near [L]. N^2 of
  /// work.
  [[nodiscard]] double least_gap(double t) const;

 private:
  enum class Kind : std::uint8_t { none, collision, exit, look_again };
  struct Event {
    Kind kind = Kind::none;
    Neighbor with;  // Of collisions.
  };

  void start();
  void carry_out(std::int32_t i, double t);
  void carry_out_collision(std::int32_t i, double t);
  void await_exit(std::int32_t i, double t);
  void predict(std::int32_t i, double t);
  void look_at(std::int32_t i, std::span<Neighbor> list, std::size_t k, double t, Vec3 normal);
  void search_suspect(std::int32_t i, std::span<Neighbor> list, const Suspect& suspect, double t);
  void take(const Found& found, std::int32_t neighbor);
  void look_in_lanes(std::int32_t i, std::span<Neighbor> list, double t);
  void forget_partner(std::int32_t i);
  void set_event(std::int32_t i, double t, Kind kind, const Neighbor& with);
  void finish(double t);
  [[nodiscard]] double least_gap_of(std::int32_t i, double t) const;
  Event& event(std::int32_t i) { return events_[static_cast<std::size_t>(i)]; }

  Bodies& bodies_;
  Cell cell_;
  ContactSearch search_;
  NearNeighbors neighbors_;
  PairLanes lanes_;
  bool has_walls_ = false;
  EventQueue queue_;
  std::vector<Event> events_;
  // What is known of the next event of the body that is being looked at.
  struct Next {
    double time = 0.0;
    Kind kind = Kind::none;
    std::int32_t neighbor = -1;  // Its place in the list.
  } next_;
  std::vector<Suspect> suspects_;
  BlockCount count_;
};

}  // namespace packstone::event_driven
