#pragma once

/// @file
/// Bodies that turn while the mean of u u^T over them stays what it is.

#include <cstdint>
#include <vector>

#include "generate/relaxation/bodies.hpp"
#include "packstone/core/mat.hpp"
#include "structure/tensor_turns.hpp"

namespace packstone::relaxation {

/// The bodies of one group, whose mean of u u^T over their axes is held.
class TensorHold {
 public:
  /// Sums of products of basis_turns().
  struct Slopes {
    Mat6 of_turns{};    ///< For restore().
    Mat6 of_motions{};  ///< Over squared arms, for project().
  };

  TensorHold(std::vector<std::size_t> members, const SymMat3& tensor)
      : members_(std::move(members)), tensor_(tensor) {}

  /// Takes note of how turns from where the bodies are change the tensor.
  void look(const Bodies& bodies);

  /// Takes out of the turns of a motion, or of a gradient, what would change the tensor to first
  /// order: its part along the five gradients of the tensor. The bodies are where the last look
  /// was.
  void project(const Bodies& bodies, Motion& motion) const;

  /// Turns the axes back, by as little as does, until the tensor is met to rounding. False where
  /// that does not come to an end: the step since the last look was too long.
  [[nodiscard]] bool restore(Bodies& bodies) const;

 private:
  std::vector<std::size_t> members_;
  SymMat3 tensor_;
  Slopes slopes_;  // At the last look.
};

/// The holds of all groups whose tensor is to be kept; where a tensor leaves its axes no way to
/// turn (all parallel, or too few of them), or none out of a plane, changes `bodies` accordingly.
[[nodiscard]] std::vector<TensorHold> tensor_holds(Bodies& bodies, const Packing& packing,
                                                   const RelaxationOptions& options);

}  // namespace packstone::relaxation
