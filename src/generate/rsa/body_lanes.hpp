#pragma once

/// @file
/// Bodies side by side in vector registers: what most trials fail on is seen there.

#include <array>
#include <cstdint>
#include <vector>

#include "generate/rsa/outline.hpp"
#include "packstone/core/cell.hpp"

namespace packstone::rsa {

/// The outlines of the bodies placed, eight to a group, in floats. Looks at the nearest image of
/// each alone. An overlap it claims is certain: margins cover the rounding of floats. What it does
/// not claim is open.
class BodyLanes {
 public:
  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kMostGroups = 19;
  static constexpr std::int32_t kMost = kLanes * kMostGroups;

  explicit BodyLanes(const Cell& cell);

  void clear();
  /// At most kMost bodies.
  void add(const Outline& outline, const Vec3& center);

  /// Where the bodies stand, seen from one center. Not set to begin with: one is made per trial.
  struct View;

  /// Fills `view`, unless a ball of `radius` about `center` is seen to come within `min_gap` of a
  /// body: then returns true at once.
  [[nodiscard]] bool ball_overlaps(double radius, double min_gap, const Vec3& center,
                                   View& view) const;

  /// Is `rod` (its ends not loose) at the center of `view` seen to come within `min_gap` of a body?
  [[nodiscard]] bool rod_overlaps(const Outline& rod, double min_gap, const View& view) const;

  /// Writes the numbers of the bodies that may come within `reach` of the center, the nearer ones
  /// first, as they are the likeliest to overlap. Returns how many.
  std::int32_t list_near(double reach, const View& view,
                         std::array<std::int32_t, kMost>& bodies) const;

  /// Groups of bodies.
  [[nodiscard]] std::size_t groups() const { return groups_.size(); }

 private:
  // The compilers' own vectors: where the processor has no registers so wide, two do for one.
  using Words = std::uint32_t __attribute__((vector_size(32)));
  using Signed = std::int32_t __attribute__((vector_size(32)));
  using Floats = float __attribute__((vector_size(32)));

  // Lanes that are free repeat the first body of the group.
  struct alignas(32) Group {
    Words x, y, z;        // In 2^-32 of the period; these wrap around as the cell does.
    Floats ux, uy, uz;    // Axes.
    Floats half;          // Of the segments.
    Floats flat_radius;   // Of flat ends, else 0.
    Floats round_radius;  // Of round ends, else 0.
    Floats flat_half;     // The end along the axis; infinite where it is round.
    Floats core;          // Inscribed radius.
    Floats circum;        // Circumscribed radius.
  };

  struct Rod;
  struct Feet;
  static Feet feet(const Rod& a, const Group& b, const View& view, std::size_t k);
  static void ball_meets(float ball, const Group& b, const View& view, std::size_t k,
                         Signed& meets);
  static void sides_meet(const Rod& a, const Group& b, const Feet& feet, Signed& meet);
  static void ends_meet(const Rod& a, const Group& b, const Feet& feet, Signed& meet);
  [[nodiscard]] Rod rod_of(const Outline& outline, double min_gap) const;
  bool ball_overlaps_in(double radius, double min_gap, const Vec3& center, View& view) const;
  bool ball_overlaps_wide(double radius, double min_gap, const Vec3& center, View& view) const;
  bool rod_overlaps_in(const Outline& rod, double min_gap, const View& view) const;
  bool rod_overlaps_wide(const Outline& rod, double min_gap, const View& view) const;
  std::int32_t list_near_in(double reach, const View& view,
                            std::array<std::int32_t, kMost>& bodies) const;
  std::int32_t list_near_wide(double reach, const View& view,
                              std::array<std::int32_t, kMost>& bodies) const;
  [[nodiscard]] std::array<std::uint32_t, 3> coarse(const Vec3& p) const;

  bool wide_;  // Has the processor registers for all lanes?
  std::array<double, 3> step_{0.0, 0.0, 0.0};
  std::array<double, 3> per_step_{0.0, 0.0, 0.0};
  double margin_;
  std::int32_t count_ = 0;
  bool has_rods_ = false;   // Bodies that are not balls.
  bool backwards_ = false;  // Stouter bodies stand at the end.
  std::vector<Group> groups_;
};

struct alignas(32) BodyLanes::View {
  // From the bodies to the center.
  std::array<Floats, kMostGroups> x, y, z;

  View() {}
};

}  // namespace packstone::rsa
