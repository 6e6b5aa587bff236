#pragma once

/// @file
/// Which pairs of bodies may push each other until they have moved too far.

#include <array>
#include <cstdint>
#include <vector>

#include "generate/relaxation/bodies.hpp"
#include "packstone/core/cell.hpp"
#include "spatial/capsule_grid.hpp"

namespace packstone::relaxation {

/// A body and the image of another, or of itself.
struct NearPair {
  std::int32_t body = 0;                ///< The lower number of the two.
  std::int32_t other = 0;               ///< The higher.
  std::array<std::int16_t, 3> image{};  ///< Periods from where `other` is.
  std::array<float, 3> hint{};          ///< Of local_gap(), for the next search.
  float clear_until = 0.0F;  ///< The two cannot push before their paths add up to it [L].
};

/// Each pair once; of own images one of each pair +-image.
///
/// A body is looked for within a margin around it, and found anew when its path has used up its
/// half of the margin: L. Verlet, Phys. Rev. 159 (1967) 98-103, body by body. Near the end few
/// move, and these are the ones that are found anew.
class NearPairs {
 public:
  /// Bodies whose pairs are kept together.
  static constexpr std::size_t kChunk = 256;

  explicit NearPairs(const Cell& cell) : cell_(cell), grid_(cell) {}

  /// Finds all pairs that can push each other while the path of no body is longer than half of
  /// `margin` [L]. Hints of pairs that were known are kept. Bodies that are found anew get a margin
  /// twice as wide each time.
  void find(const Bodies& bodies, double margin, int threads);

  /// Adds what the bodies have moved since the last look to their paths, and finds the pairs of
  /// those anew that have gone too far. False where these are so many that find() is quicker.
  bool follow(const Bodies& bodies, int threads);

  /// How far any point of body i has moved at most since its pairs were found, step by step [L].
  [[nodiscard]] double path(std::size_t i) const { return path_[i]; }

  /// Pairs whose `body` is one of kChunk c, kChunk c + 1, ...
  [[nodiscard]] std::vector<NearPair>& chunk(std::size_t c) { return chunks_[c]; }

 private:
  using Wrap = std::array<int, 3>;

  void set_capsule(const Bodies& bodies, std::size_t i);
  [[nodiscard]] NearPair pair_of(std::size_t i, std::int32_t j,
                                 const CapsuleGrid::Image& image) const;
  void refresh(const Bodies& bodies, const std::vector<std::size_t>& far);

  Cell cell_;
  std::vector<double> margin_;  // Of each body [L].
  CapsuleGrid grid_;
  CapsuleGrid::Scratch scratch_;
  std::vector<Capsule> capsules_;  // In the grid.
  std::vector<Wrap> wraps_;        // Periods from the capsule of a body to the body.
  std::vector<std::vector<NearPair>> chunks_;
  std::vector<Pose> last_;  // At the last look.
  std::vector<double> path_;
  std::vector<NearPair> known_, found_;  // Of refresh(), kept for their memory.
  std::vector<bool> is_far_;             // All false but while some are found anew.
  std::int64_t refreshed_ = 0;           // Bodies found anew since find(), each as often as it was.
};

}  // namespace packstone::relaxation
