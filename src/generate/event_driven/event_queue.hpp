#pragma once

/// @file
/// Whose event comes next?

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace packstone::event_driven {

/// One time per body and a knock-out tree over them: the root holds the body whose time is the
/// earliest, of equal times the lower number.
class EventQueue {
 public:
  /// All times become infinite.
  void reset(std::int32_t bodies) {
    leaves_ = 1;
    while (leaves_ < static_cast<std::size_t>(bodies)) leaves_ *= 2;
    time_.assign(leaves_, std::numeric_limits<double>::infinity());
    winner_.assign(2 * leaves_, 0);
    for (std::size_t k = 0; k < leaves_; ++k) winner_[leaves_ + k] = static_cast<std::int32_t>(k);
    for (std::size_t k = leaves_ - 1; k > 0; --k) winner_[k] = winner_[2 * k];
  }

  [[nodiscard]] std::int32_t next() const { return winner_[1]; }
  [[nodiscard]] double time(std::int32_t body) const {
    return time_[static_cast<std::size_t>(body)];
  }
  [[nodiscard]] const double* times() const { return time_.data(); }

  void set(std::int32_t body, double time) {
    time_[static_cast<std::size_t>(body)] = time;
    std::size_t node = leaves_ + static_cast<std::size_t>(body);
    while (node > 1) {
      node /= 2;
      const std::int32_t left = winner_[2 * node];
      const std::int32_t right = winner_[2 * node + 1];
      const std::int32_t first =
          time_[static_cast<std::size_t>(right)] < time_[static_cast<std::size_t>(left)] ? right
                                                                                         : left;
      // Above a node that another body has won before and wins again, nothing changes.
      if (winner_[node] == first && first != body) return;
      winner_[node] = first;
    }
  }

 private:
  std::size_t leaves_ = 1;
  std::vector<double> time_;
  std::vector<std::int32_t> winner_;
};

}  // namespace packstone::event_driven
