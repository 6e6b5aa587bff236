#pragma once

/// @file
/// The bodies that stand, and the question whether one more may stand somewhere.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "generate/rsa/axis_mask.hpp"
#include "generate/rsa/body_lanes.hpp"
#include "generate/rsa/outline.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "spatial/capsule_grid.hpp"

namespace packstone::rsa {

/// Costs of the steps of a trial and of a test of a vacancy, in units of about 5 ns. Decisions on
/// how to go on rest on these counts, never on clocks, so that they are the same everywhere.
struct Cost {
  static constexpr std::int64_t trial = 4;    ///< Random numbers, and what is done once per trial.
  static constexpr std::int64_t pair = 1;     ///< A look at a pair of balls.
  static constexpr std::int64_t glance = 4;   ///< A look at a pair of outlines.
  static constexpr std::int64_t kernel = 60;  ///< The exact test.
  /// A search of the grid, about what looks and tests come to in the mean. A flat rate, so that it
  /// does not depend on the order in which the grid shows the bodies.
  static constexpr std::int64_t search = 32;
};

/// A body on trial, with what every trial needs to know of it.
struct Candidate {
  Body body;
  Outline outline;
  Vec3 half_extents;  ///< Zero where nobody asks for them.

  Candidate() = default;
  explicit Candidate(const Body& from, bool with_extents = true);
};

/// One periodic image of a placed body.
struct PlacedImage {
  Vec3 center;
  std::int32_t body = 0;  ///< Index of the placed body.
};

/// Is the pair proven to keep more than `min_gap`?
[[nodiscard]] bool proven_apart(const Body& a, const Outline& outline_a, const Body& b,
                                const Outline& outline_b, const Vec3& r_ab,
                                double min_gap) noexcept;

/// Bodies placed so far. Few of them are searched one by one, many with a grid of their boxes. The
/// boxes of long ones meet many others: a mask of their axes goes before the search, and where they
/// are very long a grid of capsules takes the place of the boxes.
class PlacedBodies {
 public:
  /// @param expected  Bodies that will be placed, as far as known; decides how they are searched.
  PlacedBodies(const Cell& cell, double min_gap, std::int64_t expected);

  /// For `bodies` placed in this order, turned in whatever way; or any, where `order` is empty.
  PlacedBodies(const Cell& cell, double min_gap, const std::vector<OrderedBody>& bodies,
               std::span<const std::int64_t> order);

  /// Do candidates need half extents: for the grid, or for walls?
  [[nodiscard]] bool needs_extents() const { return needs_extents_; }

  /// Are there too many bodies to search them one by one?
  [[nodiscard]] bool uses_grid() const { return use_grid_; }

  void clear();
  void add(const Candidate& candidate, const Vec3& center);

  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(bodies_.size()); }
  [[nodiscard]] const Cell& cell() const { return cell_; }
  [[nodiscard]] double min_gap() const { return min_gap_; }
  [[nodiscard]] const Body& body(std::int32_t i) const { return bodies_[i].body; }
  [[nodiscard]] const Outline& outline(std::int32_t i) const { return bodies_[i].outline; }
  [[nodiscard]] const Vec3& center(std::int32_t i) const { return bodies_[i].center; }

  /// The bodies as seen from one center; left unset where the grid is searched.
  using View = BodyLanes::View;

  /// Fills `view`; false when a ball of the inscribed radius of `outline` is seen to overlap a body
  /// that stands, and with it the body of `outline`, however it is turned.
  [[nodiscard]] bool look_around(const Outline& outline, const Vec3& center, View& view,
                                 std::int64_t& cost) const;

  /// A trial in steps, for many trials at once, where the grid is searched: after each step the
  /// memory is asked for what the next one will look at. look_at_home() is part of look_around().
  /// The ball in the middle of a long body says little; nobody looks at it.
  void expect_look_at_home(const Vec3& center) const {
    if (!capsules_) grid_.prefetch_home(center);
  }
  [[nodiscard]] bool look_at_home(const Outline& outline, const Vec3& center) const {
    return capsules_ || !grid_.meets_core_at_home(center, outline.in_radius + min_gap_);
  }
  void expect_look_around(const Outline& outline, const Vec3& center) const {
    if (!capsules_) grid_.prefetch_core(center, outline.in_radius + min_gap_);
  }
  void expect_search(const Vec3& half_extents, const Vec3& center) const {
    if (capsules_) {
      capsules_->prefetch(center);
    } else {
      grid_.prefetch_query(center, half_extents, min_gap_);
    }
  }

  /// Does `candidate`, centered at `center` inside the cell, keep its distance from all bodies that
  /// stand? Its own images and the walls are not looked at. `view` is from look_around() for the
  /// same center. Adds to `cost`, except for the grid, whose rate look_around() has added.
  ///
  /// @param since  Where the grid is searched: leave out bodies of a lower number.
  [[nodiscard]] bool leaves_room_for(const Candidate& candidate, const Vec3& center,
                                     const View& view, std::int64_t& cost,
                                     std::int32_t since = 0) const;

  /// All images that can come within `reach` + min_gap of a point of the box [lo, hi], where reach
  /// is the circumscribed radius of the body whose center the point is.
  [[nodiscard]] std::vector<PlacedImage> images_near(const Vec3& lo, const Vec3& hi,
                                                     double reach) const;
  /// The same of body `i` alone; appends to `images`.
  void add_images_near(std::int32_t i, const Vec3& lo, const Vec3& hi, double reach,
                       std::vector<PlacedImage>& images) const;

 private:
  // What most pairs are judged by comes first, in two cache lines.
  struct Placed {
    Outline outline;
    Vec3 center;
    Body body;
  };
  class NearPairs;

  bool search_listed(const Candidate& candidate, const Vec3& center, const View& view,
                     NearPairs& near) const;
  bool add_farther_images(std::int32_t body, const Vec3& r, double reach, NearPairs& near) const;
  bool add_all_farther_images(std::int32_t body, const Vec3& r, double far, NearPairs& near) const;
  void switch_to_grid();
  bool search_grid(const Candidate& candidate, const Vec3& center, NearPairs& near,
                   std::int32_t since) const;
  void insert(std::int32_t i, const Vec3& half_extents);
  template <class Visit>
  bool query(const Candidate& candidate, const Vec3& center, const Visit& visit) const;
  [[nodiscard]] Capsule capsule_about(const Outline& outline, const Vec3& center) const;

  [[nodiscard]] Vec3 nearest_image(const Vec3& d) const;

  Cell cell_;
  double min_gap_;
  bool use_grid_;
  bool needs_extents_;
  double shortest_period_;            // Infinite without periodic axes.
  std::array<double, 3> period_;      // 0 along axes that are not periodic.
  std::array<double, 3> per_period_;  // 1 / period, or 0.
  double largest_circum_radius_ = 0.0;
  std::vector<Placed> bodies_;
  BodyLanes lanes_;  // For the search one by one.
  HierarchicalGrid grid_;
  std::vector<Capsule> expected_;  // What capsules_ is laid out for; empty: not used.
  std::optional<CapsuleGrid> capsules_;
  std::optional<AxisMask> axes_;  // Of long bodies.
};

/// Up to here a loop over all bodies beats the grid: for equal ellipsoids of aspect 2 at fraction
/// 0.25 the two take the same time near 180 bodies.
constexpr std::int32_t kMostSearchedOneByOne = 150;
static_assert(kMostSearchedOneByOne <= BodyLanes::kMost);

}  // namespace packstone::rsa
