#pragma once

/// @file
/// Cairo surfaces that end in files, whole or not at all.

#include <cairo/cairo.h>

#include <filesystem>
#include <memory>
#include <string>

namespace packstone::draw {

struct DestroySurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct DestroyContext {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using SurfacePointer = std::unique_ptr<cairo_surface_t, DestroySurface>;
using ContextPointer = std::unique_ptr<cairo_t, DestroyContext>;

/// Appends what cairo writes to the std::string that `text` points to.
cairo_status_t append_to_string(void* text, const unsigned char* data, unsigned length);

/// Throws FileError naming `path` unless `status` is success.
void check_cairo(cairo_status_t status, const std::filesystem::path& path);

/// Writes an image surface as PNG. Throws FileError.
void write_png(const std::filesystem::path& path, cairo_surface_t* surface);

}  // namespace packstone::draw
