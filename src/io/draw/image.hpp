#pragma once

/// @file
/// Image: pixels in linear RGB, written as PNG.

#include <cstddef>
#include <filesystem>
#include <vector>

#include "packstone/core/vec.hpp"

namespace packstone::draw {

/// width x height pixels, row by row from the top, linear RGB.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Vec3> pixels;

  Image(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  Vec3& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// Writes the image, sRGB 8 bit, whole or not at all. Throws FileError.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace packstone::draw
