#pragma once

/// @file
/// Vertices, edges and facets with their periodic images, numbered for files that list both.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace packstone {

/// Things that occur in several images of the box, each image once. One image of each is primary,
/// the one nearest to the box itself; all others are secondary. After finish() the primary ones are
/// numbered first, from 0, in the order in which they came.
template <class Key>
class ImagedItems {
 public:
  using Image = std::array<int, 3>;

  /// Adds an image unless it has come before; what it returns is for number().
  std::size_t add(const Key& key, const Image& image) {
    const auto [entry, added] = slots_.try_emplace({key, image}, items_.size());
    if (added) items_.push_back({key, image, 0, 0});
    return entry->second;
  }

  /// What add() returned for this image.
  [[nodiscard]] std::size_t slot(const Key& key, const Image& image) const {
    return slots_.at({key, image});
  }

  void finish() {
    std::map<Key, std::size_t> primaries;
    for (std::size_t k = 0; k < items_.size(); ++k) {
      std::size_t& primary = primaries.try_emplace(items_[k].key, k).first->second;
      if (distance(items_[k].image) < distance(items_[primary].image)) primary = k;
    }
    for (std::size_t k = 0; k < items_.size(); ++k) items_[k].primary = primaries[items_[k].key];
    order_.resize(items_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_partition(order_.begin(), order_.end(),
                          [&](std::size_t k) { return items_[k].primary == k; });
    for (std::size_t n = 0; n < order_.size(); ++n) items_[order_[n]].number = n;
    primary_count_ = primaries.size();
  }

  [[nodiscard]] std::size_t count() const { return items_.size(); }
  [[nodiscard]] std::size_t primary_count() const { return primary_count_; }
  /// The number of what add() returned `slot` for.
  [[nodiscard]] std::size_t number(std::size_t slot) const { return items_[slot].number; }
  /// By number: what it is, in which image, the number of its primary and the periods from there.
  [[nodiscard]] const Key& key(std::size_t number) const { return item(number).key; }
  [[nodiscard]] const Image& image(std::size_t number) const { return item(number).image; }
  [[nodiscard]] std::size_t primary(std::size_t number) const {
    return items_[item(number).primary].number;
  }
  [[nodiscard]] Image shift(std::size_t number) const {
    const Image &own = item(number).image, &of_primary = items_[item(number).primary].image;
    return {own[0] - of_primary[0], own[1] - of_primary[1], own[2] - of_primary[2]};
  }

 private:
  struct Item {
    Key key;
    Image image;
    std::size_t primary = 0;  // Its slot.
    std::size_t number = 0;
  };

  static int distance(const Image& image) {
    return std::abs(image[0]) + std::abs(image[1]) + std::abs(image[2]);
  }
  [[nodiscard]] const Item& item(std::size_t number) const { return items_[order_[number]]; }

  std::map<std::pair<Key, Image>, std::size_t> slots_;
  std::vector<Item> items_;
  std::vector<std::size_t> order_;  // Slots by number.
  std::size_t primary_count_ = 0;
};

}  // namespace packstone
