#include "packstone/structure/face_crossings.hpp"

#include <cmath>

#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/box_contact.hpp"
#include "packstone/spatial/separation.hpp"
#include "packstone/structure/images.hpp"

namespace packstone {
namespace {

// A face as seen from an image of an inclusion.
struct SeenFace {
  std::size_t axis;
  Vec3 half_edges;
  Separation to_face;  // From the center of the image to the middle of the face.
};

// The high face of a periodic axis is seen as the low one by the image before: the same numbers
// then decide both, whatever their rounding.
SeenFace seen_face(const Cell& cell, const Vec3& center, std::array<int, 3> image, std::size_t axis,
                   bool high) {
  Vec3 middle = 0.5 * cell.size, half_edges = middle;
  half_edges[axis] = 0.0;
  const bool as_low = high && cell.periodic[axis];
  middle[axis] = high && !as_low ? cell.size[axis] : 0.0;
  image[axis] -= as_low ? 1 : 0;
  for (int& shift : image) shift = -shift;
  return {axis, half_edges, separation(cell, center, middle, image)};
}

template <class Cuts>
CellFaces faces_that(const Cell& cell, const Inclusion& inclusion, const std::array<int, 3>& image,
                     Cuts&& cuts) {
  CellFaces faces;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    faces.low[axis] = cuts(seen_face(cell, inclusion.center, image, axis, false));
    faces.high[axis] = cuts(seen_face(cell, inclusion.center, image, axis, true));
  }
  return faces;
}

bool cuts_plane(const SeenFace& face, const Vec3& half) {
  return std::abs(face.to_face.r_ab[face.axis]) <= half[face.axis] + face.to_face.error;
}

}  // namespace

CellFaces planes_cut(const Cell& cell, const Inclusion& inclusion,
                     const std::array<int, 3>& image) noexcept {
  const Vec3 half = half_extents(inclusion.body);
  return faces_that(cell, inclusion, image,
                    [&](const SeenFace& face) { return cuts_plane(face, half); });
}

CellFaces faces_cut(const Cell& cell, const Inclusion& inclusion,
                    const std::array<int, 3>& image) noexcept {
  const Vec3 half = half_extents(inclusion.body);
  return faces_that(cell, inclusion, image, [&](const SeenFace& face) {
    return cuts_plane(face, half) && !separating_direction(inclusion.body, face.half_edges,
                                                           face.to_face.r_ab, face.to_face.error);
  });
}

std::vector<ImageInCell> images_reaching_in(const Cell& cell, const Inclusion& inclusion) {
  std::vector<ImageInCell> reaching;
  for (const std::array<int, 3>& image : images_in_cell(cell, inclusion)) {
    const CellFaces cuts = faces_cut(cell, inclusion, image);
    if (cuts.any() || image == std::array<int, 3>{0, 0, 0}) reaching.push_back({image, cuts});
  }
  return reaching;
}

}  // namespace packstone
