#pragma once

/// @file
/// Ctrl-C as a request: the first one asks, the second one kills.

#include <atomic>

namespace packstone::cli {

/// From now on SIGINT and SIGTERM set the flag that is returned, once; after that they end the
/// program at once, as they do by default.
const std::atomic<bool>& interrupt_flag();

}  // namespace packstone::cli
