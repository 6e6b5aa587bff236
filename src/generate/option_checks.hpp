#pragma once

/// @file
/// How generators refuse options.

#include <fmt/format.h>

#include "packstone/core/error.hpp"

namespace packstone {

/// Throws InvalidArgument, "RelaxationOptions::inflation is 0; allowed is (0, 0.1]", unless
/// `allowed`.
template <class Value>
void check_option(const char* options, const char* field, Value value, bool allowed,
                  const char* range) {
  if (allowed) return;
  throw InvalidArgument(fmt::format("{}::{} is {}; allowed is {}", options, field, value, range));
}

}  // namespace packstone
