#pragma once

/// @file
/// Picture: a PNG file read back.

#include <cairo/cairo.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>

namespace packstone::test {

struct Color {
  int red = 0, green = 0, blue = 0;
};

class Picture {
 public:
  explicit Picture(const std::filesystem::path& path)
      : surface_(cairo_image_surface_create_from_png(path.c_str()), cairo_surface_destroy) {
    REQUIRE(cairo_surface_status(surface_.get()) == CAIRO_STATUS_SUCCESS);
  }
  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }
  /// x, y in [0, 1) from the upper left corner.
  Color at(double x, double y) const {
    const int column = static_cast<int>(x * width());
    const int row = static_cast<int>(y * height());
    const unsigned char* line = cairo_image_surface_get_data(surface_.get()) +
                                row * cairo_image_surface_get_stride(surface_.get());
    const auto pixel = reinterpret_cast<const std::uint32_t*>(line)[column];
    return {int(pixel >> 16 & 0xff), int(pixel >> 8 & 0xff), int(pixel & 0xff)};
  }

 private:
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
};

inline bool is_white(const Color& c) { return c.red > 250 && c.green > 250 && c.blue > 250; }
inline bool is_blue(const Color& c) { return c.blue > c.red + 40 && c.blue > c.green + 20; }
inline bool is_orange(const Color& c) { return c.red > c.green && c.green > c.blue + 60; }

}  // namespace packstone::test
