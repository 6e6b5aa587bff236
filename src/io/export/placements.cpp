#include "io/export/placements.hpp"

#include <algorithm>

#include "packstone/structure/images.hpp"

namespace packstone {
namespace {

// The inclusion itself first, then its images in order.
void add_with_images(std::vector<Placement>& all, const Cell& cell, std::size_t index,
                     const Inclusion& inclusion) {
  std::vector<ImageInCell> images = images_reaching_in(cell, inclusion);
  std::stable_partition(images.begin(), images.end(), [](const ImageInCell& one) {
    return one.image == std::array<int, 3>{0, 0, 0};
  });
  for (const ImageInCell& one : images) {
    all.push_back({index, one.image, inclusion.center + image_shift(cell, one.image), one.cuts});
  }
}

}  // namespace

std::vector<Placement> placements(const Packing& packing, bool images) {
  if (images) check_images(packing);
  std::vector<Placement> all;
  for (std::size_t i = 0; i < packing.inclusions.size(); ++i) {
    const Inclusion& inclusion = packing.inclusions[i];
    if (images) {
      add_with_images(all, packing.cell, i, inclusion);
    } else {
      all.push_back({i, {0, 0, 0}, inclusion.center, {}});
    }
  }
  return all;
}

}  // namespace packstone
