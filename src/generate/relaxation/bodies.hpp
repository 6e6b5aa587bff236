#pragma once

/// @file
/// The bodies of a relaxation and the vectors in which they move.

#include <cstdint>
#include <vector>

#include "geometry/posed_body.hpp"
#include "packstone/core/cell.hpp"
#include "packstone/generate/relaxation.hpp"

namespace packstone::relaxation {

/// How one body may turn.
struct Turning {
  std::int32_t slot = -1;  ///< Number among those that turn; -1: it does not.
  double arm = 0.0;        ///< Turns are measured by it times the angle: radius of gyration [L].
  Vec3 about;              ///< Unit: turns about this axis alone; 0: about any.
};

/// A change of all poses, or a gradient by them: three numbers for each center [L], then three for
/// each body that turns, its rotation vector times its arm [L].
using Motion = std::vector<double>;

/// All bodies. Centers are not wrapped into the cell.
struct Bodies {
  std::vector<PosedBody> posed;
  std::vector<double> reach;  ///< Circumscribed radius [L].
  std::vector<double> slope;  ///< Most that a point of the surface moves per radian [L].
  std::vector<double> shell;  ///< Part of the gap that inflation asks for [L].
  std::vector<Turning> turning;
  std::int32_t turning_count = 0;
  double min_gap = 0.0;

  [[nodiscard]] std::size_t count() const { return posed.size(); }
  [[nodiscard]] std::size_t motion_size() const {
    return 3 * (count() + static_cast<std::size_t>(turning_count));
  }
  /// Where in a motion the turn of body i begins; it turns.
  [[nodiscard]] std::size_t turn_at(std::size_t i) const {
    return 3 * (count() + static_cast<std::size_t>(turning[i].slot));
  }
};

/// The bodies of a packing, turning as `options` say.
[[nodiscard]] Bodies bodies_of(const Packing& packing, const RelaxationOptions& options);

/// Sets the poses to `from` moved by `length` times `motion`.
void move(Bodies& bodies, const std::vector<PosedBody>& from, const Motion& motion, double length);

/// Turns a body by a rotation vector.
void turn(PosedBody& body, const Vec3& rotation);

/// Greatest part of what a body may move in one step that `motion` has any body move: more than 1
/// is too far.
[[nodiscard]] double relative_step(const Bodies& bodies, const Motion& motion);

/// The packing with the bodies where and as they are now.
[[nodiscard]] Packing packing_of(const Bodies& bodies, Packing shapes);

inline Vec3 vec_at(const Motion& motion, std::size_t k) {
  return {motion[k], motion[k + 1], motion[k + 2]};
}
inline void add_at(Motion& motion, std::size_t k, const Vec3& v) {
  motion[k] += v.x;
  motion[k + 1] += v.y;
  motion[k + 2] += v.z;
}
inline void set_at(Motion& motion, std::size_t k, const Vec3& v) {
  motion[k] = v.x;
  motion[k + 1] = v.y;
  motion[k + 2] = v.z;
}

}  // namespace packstone::relaxation
