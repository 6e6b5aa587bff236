#pragma once

/// @file
/// Random orders.

#include <cstddef>
#include <utility>
#include <vector>

#include "packstone/core/random.hpp"

namespace packstone {

/// Brings `things` into a random order, each as likely as any other (R. A. Fisher, F. Yates, 1938),
/// the same on every platform; draws one number less than there are things.
template <class T>
void shuffle(std::vector<T>& things, RandomStream& random) {
  for (std::size_t k = things.size(); k > 1; --k) {
    std::swap(things[k - 1], things[random.below(k)]);
  }
}

}  // namespace packstone
