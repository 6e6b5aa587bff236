#pragma once

/// @file
/// Which pairs of bodies may push each other until some body has moved too far.

#include <array>
#include <cstdint>
#include <vector>

#include "generate/relaxation/bodies.hpp"
#include "packstone/core/cell.hpp"

namespace packstone::relaxation {

/// A body and the image of another, or of itself.
struct NearPair {
  std::int32_t other = 0;
  std::array<std::int16_t, 3> image{};  ///< Periods from where `other` is.
  std::array<float, 3> hint{};          ///< Of local_gap(), for the next search.
};

/// Each pair once, with the body of the lower number; of own images one of each pair +-image.
class NearPairs {
 public:
  explicit NearPairs(const Cell& cell) : cell_(cell) {}

  /// Finds all pairs that can push each other while no body has moved by more than half of
  /// `margin` [L]. Hints of pairs that were known are kept.
  void find(const Bodies& bodies, double margin, int threads);

  /// Has no body moved too far since?
  [[nodiscard]] bool hold(const Bodies& bodies) const;

  [[nodiscard]] NearPair* begin(std::size_t i) { return pairs_.data() + first_[i]; }
  [[nodiscard]] NearPair* end(std::size_t i) { return pairs_.data() + first_[i + 1]; }

 private:
  Cell cell_;
  double margin_ = 0.0;
  std::vector<NearPair> pairs_;
  std::vector<std::size_t> first_;
  std::vector<Pose> then_;  // Poses when they were found.
};

}  // namespace packstone::relaxation
