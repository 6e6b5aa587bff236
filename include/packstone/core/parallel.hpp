#pragma once

/// @file
/// The only seam to threads. Results must not depend on how work is split: write to your own slot,
/// reduce in index order.

#include <cstdint>
#include <functional>

namespace packstone {

/// Calls body(begin, end) on disjoint ranges that cover [0, count), on up to `threads` threads
/// (0: all of the machine). Runs in the calling thread alone when threads == 1 or
/// count <= grain. Returns when all is done. An exception thrown by `body` is rethrown.
void parallel_for(std::int64_t count, int threads, std::int64_t grain,
                  const std::function<void(std::int64_t begin, std::int64_t end)>& body);

/// Hardware threads of this machine, at least 1.
int hardware_threads() noexcept;

}  // namespace packstone
