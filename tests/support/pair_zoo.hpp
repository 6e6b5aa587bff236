#pragma once

/// @file
/// Random pairs of bodies of every kind that has ever troubled a pair kernel.

#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

#include "packstone/geometry/contact.hpp"

namespace packstone::zoo {

/// How a pair is placed. The tangent classes put the bodies at a gap that is uniform within +- the
/// named part of their size; their poses are drawn from the classes before.
enum class PairClass {
  generic,
  near,        ///< Centers as far apart as touching needs, within 20 %.
  parallel,    ///< Same axes.
  coaxial,     ///< Same axes, centers on a common axis.
  coplanar,    ///< Axes and centers in one plane.
  orthogonal,  ///< Axes at right angles, centers on axes.
  concentric,
  nearly_parallel,
  sizes,  ///< One is 1000 times smaller than the other, near its surface.
  far,
  tangent_2,   ///< 1e-2
  tangent_6,   ///< 1e-6
  tangent_10,  ///< 1e-10
  tangent_13,  ///< 1e-13
};
inline constexpr int kPairClasses = 14;
std::string_view name(PairClass pair_class);

/// Two bodies and their separation.
struct Pair {
  Body a;
  Body b;
  Vec3 r;
};

/// Draws bodies and pairs; the same seed gives the same pairs on every machine.
class Zoo {
 public:
  explicit Zoo(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high);
  double log_uniform(double low, double high);
  Vec3 direction(int dimension);
  Quaternion rotation();
  /// Aspect 0.02 to 100, volume-equivalent size about `size`, random orientation.
  Body body(ShapeKind kind, double size);
  Pair pair(ShapeKind a, ShapeKind b, PairClass pair_class);

 private:
  Pair pose(ShapeKind a, ShapeKind b, PairClass pair_class);

  std::mt19937_64 engine_;
};

/// The pairs of kinds of one dimension, each once.
std::vector<std::pair<ShapeKind, ShapeKind>> kinds_of_pairs();

/// Sum of the circumscribed radii [L].
double size_of(const Pair& pair);

/// The pair moved apart until `gap_wanted` lies between the surfaces, at the least.
[[nodiscard]] Pair moved_apart(Pair pair, double gap_wanted);

}  // namespace packstone::zoo
