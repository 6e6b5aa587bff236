#pragma once

/// @file
/// What one group orders, and whether that can be understood.

#include <string>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::mix {

/// A group with its index: what messages about it start from.
struct Named {
  const InclusionGroup& group;
  int index;

  /// Throws InvalidGroup.
  [[noreturn]] void refuse(GroupField field, const std::string& value,
                           const std::string& why) const;
};

/// Does the shape have a second aspect of its own law?
[[nodiscard]] bool has_second_aspect(const InclusionGroup& group) noexcept;

/// Size alone was given.
[[nodiscard]] bool has_open_count(const InclusionGroup& group) noexcept;

/// The power of the size that volume grows with.
[[nodiscard]] int size_power(const InclusionGroup& group) noexcept;

/// Throws InvalidGroup when the group is of the wrong dimension, under- or over-determined, or has
/// a law that gives values that are not > 0.
void check_group(const Cell& cell, const InclusionGroup& group, int index);

/// Throws InvalidGroup when the fractions ordered sum to 1 or more.
void check_ordered_fractions(const std::vector<InclusionGroup>& groups);

/// Throws InvalidGroup when the counts ordered sum to more than `limit` allows.
void check_ordered_counts(const std::vector<InclusionGroup>& groups, const InclusionLimit& limit);

}  // namespace packstone::mix
