#include "recipe/open_supply.hpp"

#include <algorithm>
#include <utility>

namespace packstone::recipe {
namespace {

int open_group(const Recipe& recipe) {
  const auto open =
      std::find_if(recipe.groups.begin(), recipe.groups.end(),
                   [](const InclusionGroup& group) { return !group.count && !group.fraction; });
  return static_cast<int>(open - recipe.groups.begin());
}

}  // namespace

OpenSupply::OpenSupply(const Recipe& recipe, std::vector<OrderedBody> counted, std::int64_t among)
    : recipe_(recipe),
      counted_(std::move(counted)),
      among_(among),
      open_group_(open_group(recipe)) {}

OrderedBody OpenSupply::operator()(std::int64_t k) {
  const std::int64_t before = counted_before(k);
  if (counted_before(k + 1) > before) return counted_[static_cast<std::size_t>(before)];
  return open_body(k - before);
}

std::int64_t OpenSupply::counted_before(std::int64_t k) const {
  const auto count = static_cast<std::int64_t>(counted_.size());
  const std::int64_t all = count + among_;
  return k >= all ? count : k * count / all;
}

OrderedBody OpenSupply::open_body(std::int64_t k) {
  const std::int64_t block = k / kBlock;
  if (block != block_) {
    drawn_ = draw_open_group(recipe_.cell, recipe_.groups[static_cast<std::size_t>(open_group_)],
                             open_group_, block * kBlock, kBlock, recipe_.seed);
    block_ = block;
  }
  return drawn_[static_cast<std::size_t>(k % kBlock)];
}

}  // namespace packstone::recipe
