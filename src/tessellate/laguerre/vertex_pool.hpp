#pragma once

/// @file
/// Vertices told apart by the sites that meet there, and then by place.

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "packstone/core/cell.hpp"
#include "packstone/core/vec.hpp"
#include "tessellate/laguerre/site.hpp"

namespace packstone::laguerre {

/// The sites and walls that meet in a vertex, in order, relative to the image of the first site:
/// the same for all cells around the vertex, whatever images they see it in.
struct VertexKey {
  static constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();

  std::array<std::int32_t, 4> sites{kNone, kNone, kNone, kNone};
  std::array<std::array<std::int16_t, 3>, 4> images{};

  friend constexpr bool operator==(const VertexKey&, const VertexKey&) = default;
};

/// A site or a wall that meets others in a vertex.
struct KeyMember {
  std::int32_t site = VertexKey::kNone;
  Image image{};

  friend constexpr bool operator<(const KeyMember& a, const KeyMember& b) {
    return a.site < b.site || (a.site == b.site && a.image < b.image);
  }
};

/// The key, and the image of the box that it is relative to.
struct PlacedKey {
  VertexKey key;
  Image image{};
};
[[nodiscard]] PlacedKey placed_key(std::array<KeyMember, 4> members);

/// A vertex, and the image of the box that it stands in.
struct PlacedVertex {
  std::int32_t vertex = 0;
  Image image{};

  friend constexpr bool operator==(const PlacedVertex&, const PlacedVertex&) = default;
};

/// All vertices of a diagram.
class VertexPool {
 public:
  explicit VertexPool(const Cell& box) : box_(box) {}

  /// The vertex with this key; it stands at `at` [L] in the image that the key is relative to, if
  /// it is not known yet.
  PlacedVertex find_or_add(const VertexKey& key, const Vec3& at);

  /// Memory for so many vertices.
  void reserve(std::size_t vertices);

  /// Makes one vertex of those that are within `distance` [L] of each other, images included.
  void merge_near(double distance);

  /// What has become of a vertex.
  [[nodiscard]] PlacedVertex resolve(const PlacedVertex& vertex);

  /// Makes one of two.
  void merge(const PlacedVertex& a, const PlacedVertex& b);

  [[nodiscard]] const std::vector<Vec3>& places() const { return places_; }

 private:
  void set_slots(std::size_t slots);
  void lay_on_walls(const VertexKey& key, Vec3& at) const;

  Cell box_;
  std::vector<VertexKey> keys_;
  std::vector<Vec3> places_;           // Inside the box.
  std::vector<Image> wraps_;           // Periods taken off the place that the key is relative to.
  std::vector<PlacedVertex> becomes_;  // Itself, or one before it.
  std::vector<std::int32_t> table_;    // Open addressing by key, a power of two; -1: free.
};

}  // namespace packstone::laguerre
