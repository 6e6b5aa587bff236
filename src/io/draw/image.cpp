#include "io/draw/image.hpp"

#include <cairo/cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "io/draw/cairo_file.hpp"
#include "io/draw/palette.hpp"

namespace packstone::draw {
namespace {

std::uint32_t packed(const Vec3& color) {
  const auto byte = [](double c) {
    return static_cast<std::uint32_t>(std::lround(255.0 * to_srgb(c)));
  };
  return 0xff000000U | byte(color.x) << 16 | byte(color.y) << 8 | byte(color.z);
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image) {
  const SurfacePointer surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height));
  cairo_surface_flush(surface.get());
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    const auto begin = image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * image.width;
    std::transform(begin, begin + image.width, row, packed);
  }
  cairo_surface_mark_dirty(surface.get());
  write_png(path, surface.get());
}

}  // namespace packstone::draw
