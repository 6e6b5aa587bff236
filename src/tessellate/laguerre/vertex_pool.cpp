#include "tessellate/laguerre/vertex_pool.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace packstone::laguerre {
namespace {

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash ^= value;
  hash *= 0x9e3779b97f4a7c15U;
  return hash ^ (hash >> 29U);
}

std::uint64_t hash_of(const VertexKey& key) {
  std::uint64_t hash = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    std::uint64_t images = 0;
    for (const std::int16_t periods : key.images[k]) {
      images = images << 16U | static_cast<std::uint16_t>(periods);
    }
    hash = mixed(mixed(hash, static_cast<std::uint32_t>(key.sites[k])), images);
  }
  return hash;
}

// Places in the cells of a grid over the box, each in the one that it is in.
class PlaceGrid {
 public:
  PlaceGrid(const Cell& box, std::size_t count) : box_(box) {
    const double per_axis = std::pow(static_cast<double>(count), 1.0 / box.dimension);
    for (std::size_t a = 0; a < static_cast<std::size_t>(box.dimension); ++a) {
      dims_[a] = std::max(1, static_cast<int>(per_axis));
    }
    heads_.assign(static_cast<std::size_t>(dims_[0]) * dims_[1] * dims_[2], -1);
    next_.assign(count, -1);
  }

  void insert(std::int32_t id, const Vec3& at) {
    std::array<int, 3> index{};
    for (std::size_t a = 0; a < 3; ++a) index[a] = std::clamp(cell_of(at[a], a), 0, dims_[a] - 1);
    std::int32_t& head = heads_[slot(index)];
    next_[static_cast<std::size_t>(id)] = head;
    head = id;
  }

  // visit(id, image) for what may be within `distance` of `at`.
  template <class Visit>
  void near(const Vec3& at, double distance, Visit&& visit) const {
    std::array<int, 3> first, last;
    for (std::size_t a = 0; a < 3; ++a) {
      first[a] = cell_of(at[a] - distance, a);
      last[a] = cell_of(at[a] + distance, a);
    }
    for (int k = first[2]; k <= last[2]; ++k) {
      for (int j = first[1]; j <= last[1]; ++j) {
        for (int i = first[0]; i <= last[0]; ++i) look({i, j, k}, visit);
      }
    }
  }

 private:
  [[nodiscard]] int cell_of(double x, std::size_t a) const {
    if (dims_[a] == 1 && !box_.periodic[a]) return 0;
    return static_cast<int>(std::floor(x / box_.size[a] * dims_[a]));
  }
  [[nodiscard]] std::size_t slot(const std::array<int, 3>& index) const {
    return (static_cast<std::size_t>(index[2]) * dims_[1] + index[1]) * dims_[0] + index[0];
  }
  template <class Visit>
  void look(std::array<int, 3> index, Visit& visit) const {
    Image image{};
    for (std::size_t a = 0; a < 3; ++a) {
      const int n = dims_[a];
      if (box_.periodic[a]) {
        image[a] = index[a] < 0 ? -1 : index[a] >= n ? 1 : 0;
        index[a] -= image[a] * n;
      } else {
        index[a] = std::clamp(index[a], 0, n - 1);
      }
    }
    for (std::int32_t id = heads_[slot(index)]; id >= 0; id = next_[static_cast<std::size_t>(id)]) {
      visit(id, image);
    }
  }

  const Cell& box_;
  std::array<int, 3> dims_{1, 1, 1};
  std::vector<std::int32_t> heads_;
  std::vector<std::int32_t> next_;
};

}  // namespace

PlacedKey placed_key(std::array<KeyMember, 4> members) {
  std::sort(members.begin(), members.end());
  PlacedKey placed;
  const auto first =
      std::find_if(members.begin(), members.end(), [](const KeyMember& m) { return m.site >= 0; });
  placed.image = first->image;
  for (std::size_t k = 0; k < 4; ++k) {
    placed.key.sites[k] = members[k].site;
    // Walls, and the places left free, are in no image.
    if (members[k].site < 0 || members[k].site == VertexKey::kNone) continue;
    for (std::size_t a = 0; a < 3; ++a) {
      placed.key.images[k][a] = static_cast<std::int16_t>(members[k].image[a] - placed.image[a]);
    }
  }
  return placed;
}

void VertexPool::reserve(std::size_t vertices) {
  set_slots(std::bit_ceil(2 * vertices + 1));
  keys_.reserve(vertices);
  places_.reserve(vertices);
  wraps_.reserve(vertices);
  becomes_.reserve(vertices);
}

void VertexPool::set_slots(std::size_t slots) {
  table_.assign(slots, -1);
  const std::size_t mask = table_.size() - 1;
  for (std::size_t id = 0; id < keys_.size(); ++id) {
    std::size_t slot = hash_of(keys_[id]) & mask;
    while (table_[slot] >= 0) slot = (slot + 1) & mask;
    table_[slot] = static_cast<std::int32_t>(id);
  }
}

void VertexPool::lay_on_walls(const VertexKey& key, Vec3& at) const {
  for (const std::int32_t site : key.sites) {
    if (site >= 0) continue;
    const auto axis = static_cast<std::size_t>((-1 - site) / 2);
    at[axis] = (-1 - site) % 2 == 0 ? 0.0 : box_.size[axis];
  }
}

PlacedVertex VertexPool::find_or_add(const VertexKey& key, const Vec3& at) {
  if (2 * keys_.size() >= table_.size()) set_slots(std::max<std::size_t>(1024, 4 * table_.size()));
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = hash_of(key) & mask;
  for (; table_[slot] >= 0; slot = (slot + 1) & mask) {
    const std::int32_t id = table_[slot];
    if (keys_[static_cast<std::size_t>(id)] == key) {
      return {id, wraps_[static_cast<std::size_t>(id)]};
    }
  }
  const auto id = static_cast<std::int32_t>(keys_.size());
  table_[slot] = id;
  Site inside = wrapped_site(box_, at, 0.0, 0);
  lay_on_walls(key, inside.at);
  keys_.push_back(key);
  places_.push_back(inside.at);
  wraps_.push_back(inside.home);
  becomes_.push_back({id, {}});
  return {id, inside.home};
}

PlacedVertex VertexPool::resolve(const PlacedVertex& vertex) {
  const PlacedVertex step = becomes_[static_cast<std::size_t>(vertex.vertex)];
  if (step.vertex == vertex.vertex) return vertex;
  const PlacedVertex end = resolve(step);
  becomes_[static_cast<std::size_t>(vertex.vertex)] = end;
  return {end.vertex, vertex.image + end.image};
}

void VertexPool::merge(const PlacedVertex& a, const PlacedVertex& b) {
  PlacedVertex first = resolve(a), second = resolve(b);
  if (first.vertex == second.vertex) return;
  if (second.vertex < first.vertex) std::swap(first, second);
  becomes_[static_cast<std::size_t>(second.vertex)] = {first.vertex, first.image - second.image};
}

void VertexPool::merge_near(double distance) {
  PlaceGrid grid(box_, places_.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto id = static_cast<std::int32_t>(k);
    const Vec3& at = places_[k];
    grid.near(at, distance, [&](std::int32_t other, const Image& image) {
      const Vec3 there = places_[static_cast<std::size_t>(other)] + image_shift(box_, image);
      if (norm_sq(there - at) <= distance * distance) merge({id, {}}, {other, image});
    });
    grid.insert(id, at);
  }
}

}  // namespace packstone::laguerre
