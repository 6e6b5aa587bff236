#include "io/export/placements.hpp"

#include "packstone/structure/images.hpp"

namespace packstone {
namespace {

void add_images(std::vector<Placement>& all, const Cell& cell, std::size_t index,
                const Inclusion& inclusion) {
  for (const std::array<int, 3>& image : images_in_cell(cell, inclusion)) {
    if (image == std::array<int, 3>{0, 0, 0}) continue;
    all.push_back({index, image, inclusion.center + image_shift(cell, image)});
  }
}

}  // namespace

std::vector<Placement> placements(const Packing& packing, bool images) {
  if (images) check_images(packing);
  std::vector<Placement> all;
  for (std::size_t i = 0; i < packing.inclusions.size(); ++i) {
    const Inclusion& inclusion = packing.inclusions[i];
    all.push_back({i, {0, 0, 0}, inclusion.center});
    if (images) add_images(all, packing.cell, i, inclusion);
  }
  return all;
}

}  // namespace packstone
