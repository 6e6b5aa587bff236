#include "io/draw/cairo_file.hpp"

#include "packstone/core/error.hpp"
#include "packstone/io/packing_file.hpp"

namespace packstone::draw {

cairo_status_t append_to_string(void* text, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void check_cairo(cairo_status_t status, const std::filesystem::path& path) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw FileError(path.string() + ": cannot draw: " + cairo_status_to_string(status));
}

void write_png(const std::filesystem::path& path, cairo_surface_t* surface) {
  std::string content;
  check_cairo(cairo_surface_write_to_png_stream(surface, append_to_string, &content), path);
  write_atomically(path, content);
}

}  // namespace packstone::draw
