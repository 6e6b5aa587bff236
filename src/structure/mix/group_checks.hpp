#pragma once

/// @file
/// What one group orders, and whether that can be understood.

#include <string>

#include "packstone/core/cell.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::mix {

/// More are refused.
inline constexpr std::int64_t kMostInclusions = 100'000'000;

/// "group 'fibers'", or "group 2" where it has no name: the start of messages.
[[nodiscard]] std::string label(const InclusionGroup& group, int index);

/// Throws InvalidArgument "what: why".
[[noreturn]] void refuse(const std::string& what, const std::string& why);

[[nodiscard]] bool is_rod(ShapeKind shape) noexcept;
[[nodiscard]] bool is_round(ShapeKind shape) noexcept;

/// Does the shape have a second aspect of its own law?
[[nodiscard]] bool has_second_aspect(const InclusionGroup& group) noexcept;

/// Size alone was given.
[[nodiscard]] bool has_open_count(const InclusionGroup& group) noexcept;

/// The power of the size that volume grows with.
[[nodiscard]] int size_power(const InclusionGroup& group) noexcept;

/// Throws InvalidArgument when the group is of the wrong dimension, under- or over-determined, or
/// has a law that gives values that are not > 0.
void check_group(const Cell& cell, const InclusionGroup& group, int index);

}  // namespace packstone::mix
