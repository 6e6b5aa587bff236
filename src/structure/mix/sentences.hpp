#pragma once

/// @file
/// Sentences about what was drawn, for people.

#include <string>
#include <vector>

#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::mix {

/// The lengths that people name a shape by [L].
[[nodiscard]] Vec3 lengths_of(const Body& body);

/// "diameter 0.08 and length 0.4", with "0.08 to 0.1" where the bodies differ.
[[nodiscard]] std::string lengths_text(const std::vector<Body>& bodies);

/// "fibers: diameter 0.08 and length 0.4 follow from count 200 and fraction 0.4"; `reached` is
/// the fraction of the group.
[[nodiscard]] std::string derived_sentence(const InclusionGroup& group, int index,
                                           const std::vector<Body>& bodies, double reached);

/// What to say of a group whose count stays open.
[[nodiscard]] std::string open_count_sentence(const InclusionGroup& group, int index);

}  // namespace packstone::mix
