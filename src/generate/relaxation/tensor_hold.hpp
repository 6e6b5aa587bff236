#pragma once

/// @file
/// Bodies that turn while the mean of u u^T over them stays what it is.

#include <cstdint>
#include <vector>

#include "generate/relaxation/bodies.hpp"
#include "packstone/core/mat.hpp"

namespace packstone::relaxation {

/// The bodies of one group, whose mean of u u^T over their axes is held.
class TensorHold {
 public:
  TensorHold(std::vector<std::size_t> members, const SymMat3& tensor)
      : members_(std::move(members)), tensor_(tensor) {}

  /// Takes out of the turns of a motion, or of a gradient, what would change the tensor to first
  /// order: its part along the five gradients of the tensor.
  void project(const Bodies& bodies, Motion& motion) const;

  /// Turns the axes back, by as little as does, until the tensor is met to rounding. False where
  /// that does not come to an end: the step was too long.
  [[nodiscard]] bool restore(Bodies& bodies) const;

 private:
  std::vector<std::size_t> members_;
  SymMat3 tensor_;
};

/// The holds of all groups whose tensor is to be kept; where a tensor leaves its axes no way to
/// turn (all parallel, or too few of them), or none out of a plane, changes `bodies` accordingly.
[[nodiscard]] std::vector<TensorHold> tensor_holds(Bodies& bodies, const Packing& packing,
                                                   const RelaxationOptions& options);

}  // namespace packstone::relaxation
