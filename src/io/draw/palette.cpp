#include "io/draw/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "packstone/geometry/measures.hpp"

namespace packstone::draw {
namespace {

double to_linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

Vec3 from_hex(unsigned hex) {
  const auto channel = [hex](int shift) { return to_linear(((hex >> shift) & 0xff) / 255.0); };
  return {channel(16), channel(8), channel(0)};
}

// Eight hues that also color-blind readers tell apart: M. Okabe, K. Ito, "Color universal design"
// (2008), in an order that puts the strongest contrasts first; black is replaced by a gray.
Vec3 group_color(int group) {
  static constexpr std::array<unsigned, 8> hues = {0x0072b2, 0xe69f00, 0x009e73, 0xcc79a7,
                                                   0xd55e00, 0x56b4e9, 0xf0e442, 0x888888};
  return from_hex(hues[static_cast<std::size_t>(group) % hues.size()]);
}

// Dark blue, teal, green, yellow: light grows steadily, so that the ramp survives gray print.
Vec3 ramp(double t) {
  static constexpr std::array<unsigned, 6> stops = {0x3b2a78, 0x355f8d, 0x22908c,
                                                    0x44bf70, 0xaadc32, 0xfde725};
  const double x = std::clamp(t, 0.0, 1.0) * (stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), stops.size() - 2);
  const double f = x - static_cast<double>(i);
  return (1.0 - f) * from_hex(stops[i]) + f * from_hex(stops[i + 1]);
}

// Period pi in the angle, as an axis has no sign.
Vec3 plane_axis_color(const Vec3& axis) {
  const double phase = 2.0 * std::atan2(axis.y, axis.x);
  const auto channel = [phase](double shift) {
    return to_linear(0.55 + 0.4 * std::cos(phase - shift * 2.0 * std::numbers::pi / 3.0));
  };
  return {channel(0), channel(1), channel(2)};
}

// Red, green, blue for x, y, z; a floor keeps every body readable.
Vec3 axis_color(int dimension, const Vec3& axis) {
  if (dimension == 2) return plane_axis_color(axis);
  const auto channel = [](double c) { return to_linear(0.12 + 0.83 * std::abs(c)); };
  return {channel(axis.x), channel(axis.y), channel(axis.z)};
}

Vec3 orientation_color(const Body& body) {
  const Vec3 axis = long_axis(body);
  if (axis == Vec3{}) return from_hex(0xb0b0b0);
  return axis_color(dimension(kind(body)), axis);
}

double equivalent_size(const Body& body) {
  return std::pow(volume(body), 1.0 / dimension(kind(body)));
}

std::vector<Vec3> size_colors(const std::vector<double>& sizes) {
  if (sizes.empty()) return {};
  const auto [least, greatest] = std::minmax_element(sizes.begin(), sizes.end());
  std::vector<Vec3> colors;
  for (double size : sizes) {
    // Sizes equal within rounding share the middle of the ramp.
    const double span = *greatest - *least;
    colors.push_back(ramp(span > 1e-9 * *greatest ? (size - *least) / span : 0.4));
  }
  return colors;
}

std::vector<Vec3> size_colors(const Packing& packing) {
  std::vector<double> sizes;
  for (const Inclusion& inclusion : packing.inclusions) {
    sizes.push_back(equivalent_size(inclusion.body));
  }
  return size_colors(sizes);
}

}  // namespace

std::vector<Vec3> inclusion_colors(const Packing& packing, ColorBy color_by) {
  if (color_by == ColorBy::size) return size_colors(packing);
  std::vector<Vec3> colors;
  for (const Inclusion& inclusion : packing.inclusions) {
    colors.push_back(color_by == ColorBy::group ? group_color(inclusion.group)
                                                : orientation_color(inclusion.body));
  }
  return colors;
}

std::vector<Vec3> cell_colors(const Tessellation& tessellation, ColorBy color_by) {
  const int dimension = tessellation.box.dimension;
  std::vector<Vec3> colors;
  if (color_by == ColorBy::group) {
    for (const TessellationCell& cell : tessellation.cells) {
      colors.push_back(group_color(cell.group));
    }
    return colors;
  }
  std::vector<double> sizes;
  for (const CellShape& shape : cell_shapes(tessellation)) {
    sizes.push_back(std::pow(shape.measure, 1.0 / dimension));
    colors.push_back(axis_color(dimension, shape.axes.col_x));
  }
  return color_by == ColorBy::size ? size_colors(sizes) : colors;
}

double to_srgb(double linear) noexcept {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

}  // namespace packstone::draw
