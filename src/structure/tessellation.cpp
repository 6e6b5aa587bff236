#include "packstone/structure/tessellation.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <tuple>

#include "packstone/core/error.hpp"
#include "packstone/core/symmetric_eigen.hpp"

namespace packstone {
namespace {

using Image = std::array<int, 3>;

Image operator+(const Image& a, const Image& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Image operator-(const Image& a) { return {-a[0], -a[1], -a[2]}; }

std::span<const FacetCorner> corners_of(const Tessellation& t, const Facet& facet) {
  return {t.corners.data() + facet.first_corner, static_cast<std::size_t>(facet.corner_count)};
}

// Shifts the corners of a facet to where the cell that sees it stands.
Image place(const Facet& facet, bool outer) { return outer ? -facet.image : Image{}; }

[[noreturn]] void refuse_facet(std::size_t facet, const std::string& why) {
  throw InvalidArgument("facet " + std::to_string(facet) + ": " + why);
}

void check_wall(const Tessellation& t, std::size_t k) {
  const Facet& facet = t.facets[k];
  const int axis = facet.wall / 2;
  if (facet.wall < 0 || axis >= t.box.dimension || t.box.periodic[static_cast<std::size_t>(axis)]) {
    refuse_facet(k, "wall is " + std::to_string(facet.wall) + ", and the box has none such");
  }
  if (facet.image != Image{}) refuse_facet(k, "a wall has no image");
}

void check_facet(const Tessellation& t, std::size_t k) {
  const Facet& facet = t.facets[k];
  const auto cells = static_cast<std::int32_t>(t.cells.size());
  if (facet.inner < 0 || facet.inner >= cells || facet.outer < Facet::kWall ||
      facet.outer >= cells) {
    refuse_facet(k, "names a cell that does not exist");
  }
  if (facet.outer == Facet::kWall) check_wall(t, k);
  if (facet.outer == facet.inner && facet.image == Image{}) {
    refuse_facet(k, "has the same cell on both sides");
  }
  const bool enough = t.box.dimension == 2 ? facet.corner_count == 2 : facet.corner_count >= 3;
  const auto last = static_cast<std::int64_t>(t.corners.size()) - facet.corner_count;
  if (!enough || facet.first_corner < 0 || facet.first_corner > last) {
    refuse_facet(k, "has " + std::to_string(facet.corner_count) + " corners, or not so many");
  }
  for (const FacetCorner& corner : corners_of(t, facet)) {
    if (corner.vertex < 0 || corner.vertex >= static_cast<std::int32_t>(t.vertices.size())) {
      refuse_facet(k, "names vertex " + std::to_string(corner.vertex) + ", which does not exist");
    }
  }
}

// What two facets of a cell meet in: a vertex (2D, start = end) or an edge (3D), in one direction.
struct Ridge {
  std::int32_t cell = 0;
  std::int32_t low = 0, high = 0;
  Image low_image{}, high_image{};
  int turns = 0;  // +1 in the direction from low to high (2D: is a start), -1 in the other.

  [[nodiscard]] auto key() const { return std::tie(cell, low, high, low_image, high_image); }
};

Ridge ridge(std::int32_t cell, const FacetCorner& from, const FacetCorner& to, const Image& shift,
            int turns) {
  const Image from_image = from.image + shift, to_image = to.image + shift;
  if (std::tie(from.vertex, from_image) <= std::tie(to.vertex, to_image)) {
    return {cell, from.vertex, to.vertex, from_image, to_image, turns};
  }
  return {cell, to.vertex, from.vertex, to_image, from_image, -turns};
}

void add_ridges(const Tessellation& t, const Facet& facet, bool outer, std::vector<Ridge>& ridges) {
  const auto corners = corners_of(t, facet);
  const std::int32_t cell = outer ? facet.outer : facet.inner;
  const Image shift = place(facet, outer);
  const int turns = outer ? -1 : 1;
  if (t.box.dimension == 2) {
    ridges.push_back(ridge(cell, corners[0], corners[0], shift, turns));
    ridges.push_back(ridge(cell, corners[1], corners[1], shift, -turns));
    return;
  }
  for (std::size_t k = 0; k < corners.size(); ++k) {
    ridges.push_back(ridge(cell, corners[k], corners[(k + 1) % corners.size()], shift, turns));
  }
}

// Integrals over the cone from an origin to the facets of a cell.
struct Moments {
  double measure = 0.0;
  Vec3 first;
  SymMat3 second;
};

// The triangle (0, a, b), counterclockwise.
void add_triangle(Moments& sum, const Vec3& a, const Vec3& b) {
  const double area = 0.5 * (a.x * b.y - a.y * b.x);
  sum.measure += area;
  sum.first += area / 3.0 * (a + b);
  sum.second = sum.second + area / 12.0 * (dyad(a) + dyad(b) + dyad(a + b));
}

// The tetrahedron (0, a, b, c), outward.
void add_tetrahedron(Moments& sum, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double volume = dot(a, cross(b, c)) / 6.0;
  sum.measure += volume;
  sum.first += volume / 4.0 * (a + b + c);
  sum.second = sum.second + volume / 20.0 * (dyad(a) + dyad(b) + dyad(c) + dyad(a + b + c));
}

// Length of an edge, area of a polygon.
double facet_measure(const Tessellation& t, const Facet& facet) {
  const auto corners = corners_of(t, facet);
  const Vec3 origin = position(t, corners[0]);
  if (t.box.dimension == 2) return norm(position(t, corners[1]) - origin);
  Vec3 twice;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    twice += cross(position(t, corners[k - 1]) - origin, position(t, corners[k]) - origin);
  }
  return 0.5 * norm(twice);
}

void add_facet(const Tessellation& t, const Facet& facet, bool outer, const Vec3& origin,
               Moments& sum) {
  const auto corners = corners_of(t, facet);
  const Vec3 shift = image_shift(t.box, place(facet, outer)) - origin;
  const auto at = [&](std::size_t k) { return position(t, corners[k]) + shift; };
  if (t.box.dimension == 2) {
    outer ? add_triangle(sum, at(1), at(0)) : add_triangle(sum, at(0), at(1));
    return;
  }
  for (std::size_t k = 2; k < corners.size(); ++k) {
    outer ? add_tetrahedron(sum, at(0), at(k), at(k - 1))
          : add_tetrahedron(sum, at(0), at(k - 1), at(k));
  }
}

// About a corner of the cell, which is near: no digits cancel.
CellShape shape_of_cell(const Tessellation& t, std::span<const CellFacets::Entry> facets) {
  if (facets.empty()) return {};
  const Facet& any = t.facets[static_cast<std::size_t>(facets[0].facet)];
  const Vec3 origin =
      position(t, corners_of(t, any)[0]) + image_shift(t.box, place(any, facets[0].outer));
  Moments sum;
  double boundary = 0.0;
  for (const auto& [facet, outer] : facets) {
    const Facet& of = t.facets[static_cast<std::size_t>(facet)];
    add_facet(t, of, outer, origin, sum);
    boundary += facet_measure(t, of);
  }
  if (sum.measure <= 0.0) return {};
  const Vec3 mean = sum.first / sum.measure;
  CellShape shape = shape_of_moments(t.box.dimension, sum.measure, origin + mean,
                                     sum.second - sum.measure * dyad(mean));
  shape.boundary = boundary;
  return shape;
}

}  // namespace

Vec3 position(const Tessellation& t, const FacetCorner& corner) noexcept {
  return t.vertices[static_cast<std::size_t>(corner.vertex)] + image_shift(t.box, corner.image);
}

std::int64_t open_ridges(const Tessellation& t) {
  std::vector<Ridge> ridges;
  for (const Facet& facet : t.facets) {
    add_ridges(t, facet, false, ridges);
    if (facet.outer != Facet::kWall) add_ridges(t, facet, true, ridges);
  }
  std::sort(ridges.begin(), ridges.end(),
            [](const Ridge& a, const Ridge& b) { return a.key() < b.key(); });
  std::int64_t open = 0;
  for (std::size_t begin = 0; begin < ridges.size();) {
    int turns = 0;
    std::size_t end = begin;
    for (; end < ridges.size() && ridges[end].key() == ridges[begin].key(); ++end) {
      turns += ridges[end].turns;
    }
    open += turns != 0 ? 1 : 0;
    begin = end;
  }
  return open;
}

void check_well_formed(const Tessellation& t) {
  check_cell(t.box);
  for (std::size_t k = 0; k < t.facets.size(); ++k) check_facet(t, k);
  const std::int64_t open = open_ridges(t);
  if (open > 0) {
    throw InvalidArgument("the boundaries of the cells are open in " + std::to_string(open) +
                          " places");
  }
}

CellFacets facets_of_cells(const Tessellation& t) {
  CellFacets of;
  of.first.assign(t.cells.size() + 1, 0);
  const auto count = [&](std::int32_t cell) {
    return &of.first[static_cast<std::size_t>(cell) + 1];
  };
  for (const Facet& facet : t.facets) {
    ++*count(facet.inner);
    if (facet.outer != Facet::kWall) ++*count(facet.outer);
  }
  for (std::size_t c = 0; c < t.cells.size(); ++c) of.first[c + 1] += of.first[c];
  of.entries.resize(static_cast<std::size_t>(of.first.back()));
  std::vector<std::int64_t> next = of.first;
  const auto put = [&](std::int32_t cell, std::int64_t facet, bool outer) {
    auto& slot = next[static_cast<std::size_t>(cell)];
    of.entries[static_cast<std::size_t>(slot++)] = {facet, outer};
  };
  for (std::size_t k = 0; k < t.facets.size(); ++k) {
    const auto facet = static_cast<std::int64_t>(k);
    put(t.facets[k].inner, facet, false);
    if (t.facets[k].outer != Facet::kWall) put(t.facets[k].outer, facet, true);
  }
  return of;
}

std::vector<CellContact> cell_contacts(const Tessellation& t) {
  std::vector<CellContact> contacts;
  for (const Facet& f : t.facets) {
    const double measure = facet_measure(t, f);
    const bool swap = f.outer != Facet::kWall && f.outer < f.inner;
    contacts.push_back(swap ? CellContact{f.outer, f.inner, -f.image, -1, measure, 1}
                            : CellContact{f.inner, f.outer, f.image, f.wall, measure, 1});
  }
  const auto key = [](const CellContact& c) { return std::tie(c.a, c.b, c.image, c.wall); };
  std::stable_sort(contacts.begin(), contacts.end(),
                   [&](const CellContact& c, const CellContact& d) { return key(c) < key(d); });
  std::size_t kept = 0;
  for (const CellContact& c : contacts) {
    if (kept > 0 && key(contacts[kept - 1]) == key(c)) {
      contacts[kept - 1].measure += c.measure;
      ++contacts[kept - 1].facets;
    } else {
      contacts[kept++] = c;
    }
  }
  contacts.resize(kept);
  return contacts;
}

CellShape shape_of_moments(int dimension, double measure, const Vec3& centroid,
                           const SymMat3& second_moment) noexcept {
  CellShape shape;
  shape.measure = measure;
  shape.centroid = centroid;
  shape.second_moment = second_moment;
  const SymmetricEigen eigen = symmetric_eigen(second_moment);
  shape.axes = eigen.vectors;
  // Of an ellipsoid M = V a^2 / 5 along an axis, of an ellipse A a^2 / 4.
  const auto last = static_cast<std::size_t>(dimension) - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    shape.semi_axes[k] = std::sqrt(std::max(0.0, (dimension + 2) * eigen.values[k] / measure));
  }
  shape.aspect = shape.semi_axes[0] / shape.semi_axes[last];
  return shape;
}

std::vector<CellShape> cell_shapes(const Tessellation& t) {
  const CellFacets facets = facets_of_cells(t);
  std::vector<CellShape> shapes;
  shapes.reserve(t.cells.size());
  for (std::size_t c = 0; c < t.cells.size(); ++c) {
    shapes.push_back(
        shape_of_cell(t, {facets.entries.data() + facets.first[c],
                          static_cast<std::size_t>(facets.first[c + 1] - facets.first[c])}));
  }
  return shapes;
}

SymMat3 inertia_tensor(const CellShape& shape) noexcept {
  const SymMat3& m = shape.second_moment;
  const double t = trace(m);
  return SymMat3{t, t, t, 0, 0, 0} - m;
}

}  // namespace packstone
