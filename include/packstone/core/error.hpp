#pragma once

/// @file
/// The three channels of failure: a broken invariant is an assertion, bad input is InvalidArgument
/// before any work starts, and an ordinary outcome is a field of a result.

#include <stdexcept>
#include <string>

namespace packstone {

/// Bad input: the message names what was given, its value and the allowed range.
class InvalidArgument : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A file could not be read or written; the message names the file and, where known, the place.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace packstone

/// A broken invariant; checked in builds without NDEBUG.
#ifdef NDEBUG
#define PACKSTONE_ASSERT(condition) static_cast<void>(0)
#else
#include <cassert>
#define PACKSTONE_ASSERT(condition) assert(condition)
#endif
