#pragma once

/// @file
/// Numbers and laws in a recipe: 5, { uniform = [lo, hi] }, { lognormal = { ... } }, ...

#include <optional>
#include <string>

#include "packstone/structure/distribution.hpp"
#include "recipe/recipe_table.hpp"

namespace packstone::recipe {

/// Beyond it a min or max of a law is none.
inline constexpr double kNoBound = 1e300;

/// What the values of a law may be.
enum class Values {
  positive,  ///< Sizes and aspects.
  any,       ///< Angles.
};

/// Whether `by = "volume"` makes sense.
enum class Weightable { yes, no };

/// A number or a law in any of its forms, or complaints and nothing. Tables of values are looked
/// for in the folder of the recipe.
[[nodiscard]] std::optional<Distribution> read_distribution(const Entry& entry, Values values,
                                                            Weightable weightable,
                                                            Complaints& complaints);

/// The law of `factor` times a value of `law`. factor > 0.
[[nodiscard]] Distribution scaled(Distribution law, double factor);

}  // namespace packstone::recipe
