#include "tessellate/laguerre/parts.hpp"

#include <algorithm>
#include <numeric>

namespace packstone::laguerre {

DisjointSets::DisjointSets(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0); }

std::int32_t DisjointSets::first(std::int32_t i) {
  while (up_[static_cast<std::size_t>(i)] != i) {
    std::int32_t& up = up_[static_cast<std::size_t>(i)];
    up = up_[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

void DisjointSets::join(std::int32_t a, std::int32_t b) {
  const std::int32_t i = first(a), j = first(b);
  up_[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
}

}  // namespace packstone::laguerre
