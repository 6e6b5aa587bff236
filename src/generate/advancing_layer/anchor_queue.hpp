#pragma once

/// @file
/// Height list: which ball to lean the next one on.
///
/// Every ball that stands is an anchor, kept by its height together with the smallest radius that
/// is known to find no place on it. As nothing is ever taken away, and as a ball that fits lets
/// every smaller one fit where it touches its anchor, an anchor that failed for R fails for all
/// larger radii for ever.

#include <cstdint>
#include <vector>

namespace packstone::advancing_layer {

/// Anchors in bins of height; in each a heap by the radius that fails, over the bins a tree of the
/// largest of those, so that the lowest bin that may hold a place for R is found in the logarithm
/// of their number.
class AnchorQueue {
 public:
  /// @param height      Heights are in [0, height] [L].
  /// @param bin_height  [L] > 0.
  /// @param smallest    Radius below which no ball will be looked for [L].
  AnchorQueue(double height, double bin_height, double smallest);

  /// Anchor number `anchor`, 0, 1, ... in turn, on which nothing has failed yet.
  void add(std::int32_t anchor, double height);

  /// The smallest radius that is known to fail [L].
  [[nodiscard]] double limit(std::int32_t anchor) const {
    return limits_[static_cast<std::size_t>(anchor)];
  }
  /// So do `radius` and all above. Not while walk() looks at another one.
  void lower_limit(std::int32_t anchor, double radius);

  /// Nothing is known to fail any more.
  void renew(std::int32_t anchor);

  /// Calls look(anchor, limit) for anchors whose limit is above `radius`, from the bin of height
  /// `from` upward, in each bin those of the largest limit first, until it returns false. It may
  /// set the limit that is handed to it.
  template <class Look>
  void walk(double from, double radius, Look&& look) {
    bool more = true;
    for (int bin = first_bin(bin_of(from), radius); bin >= 0 && more;
         bin = first_bin(bin + 1, radius)) {
      std::vector<std::int32_t>& heap = bins_[static_cast<std::size_t>(bin)];
      seen_.clear();
      while (more && !heap.empty() && limit(heap.front()) > radius) {
        const std::int32_t anchor = take_first(heap);
        more = look(anchor, limits_[static_cast<std::size_t>(anchor)]);
        if (limit(anchor) > smallest_) seen_.push_back(anchor);
      }
      for (const std::int32_t anchor : seen_) put(heap, anchor);
      refresh(bin);
    }
  }

 private:
  [[nodiscard]] auto by_limit() const {
    return [this](std::int32_t a, std::int32_t b) { return limit(a) < limit(b); };
  }
  [[nodiscard]] int bin_of(double height) const;
  // The first bin from `bin` on that holds a limit above `radius`; -1 if there is none.
  [[nodiscard]] int first_bin(int bin, double radius) const;
  std::int32_t take_first(std::vector<std::int32_t>& heap);
  void put(std::vector<std::int32_t>& heap, std::int32_t anchor);
  // Sets the tree right after the heap of a bin has changed.
  void refresh(int bin);

  double per_height_;
  double smallest_;
  int leaves_ = 1;
  std::vector<std::vector<std::int32_t>> bins_;
  std::vector<double> tree_;  // Node k has the children 2k and 2k + 1; leaf `bin` is leaves_ + bin.
  std::vector<double> limits_;  // By anchor.
  std::vector<int> bin_of_;     // By anchor.
  std::vector<std::int32_t> seen_;
};

}  // namespace packstone::advancing_layer
