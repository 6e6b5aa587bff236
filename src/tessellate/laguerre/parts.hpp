#pragma once

/// @file
/// Which sites of an owner hang together.

#include <cstdint>
#include <utility>
#include <vector>

namespace packstone::laguerre {

/// Sets that grow together.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);

  /// The first member of the set that `i` is in.
  [[nodiscard]] std::int32_t first(std::int32_t i);
  void join(std::int32_t a, std::int32_t b);

 private:
  std::vector<std::int32_t> up_;
};

/// Two sites of one owner whose cells share a facet.
using Joint = std::pair<std::int32_t, std::int32_t>;

}  // namespace packstone::laguerre
