#pragma once

/// @file
/// The bodies of a recipe that leaves the count of one group open.

#include <cstdint>
#include <vector>

#include "packstone/recipe/recipe.hpp"
#include "packstone/structure/inclusion_mix.hpp"

namespace packstone::recipe {

/// Bodies of known number, and those of the open group, drawn in blocks: a BodySource.
class OpenSupply {
 public:
  /// @param counted  The bodies of known number.
  /// @param among    Spread evenly among that many of the open group; 0: before all of them.
  OpenSupply(const Recipe& recipe, std::vector<OrderedBody> counted, std::int64_t among);

  OrderedBody operator()(std::int64_t k);

 private:
  static constexpr std::int64_t kBlock = 1024;

  // Of the first k bodies, those of known number.
  [[nodiscard]] std::int64_t counted_before(std::int64_t k) const;
  OrderedBody open_body(std::int64_t k);

  const Recipe& recipe_;
  std::vector<OrderedBody> counted_;
  std::int64_t among_;
  int open_group_;
  std::int64_t block_ = -1;
  std::vector<OrderedBody> drawn_;
};

}  // namespace packstone::recipe
