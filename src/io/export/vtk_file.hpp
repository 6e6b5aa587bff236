#pragma once

/// @file
/// The XML format of VTK for unstructured grids.
///
/// "VTK File Formats", in W. Schroeder, K. Martin, B. Lorensen, The Visualization Toolkit, 4th ed.
/// (2006); arrays appended raw, each after its size in bytes.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/export/byte_writer.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

enum class VtkSection { points, cells, point_data, cell_data };

/// One array of the file: its XML attributes, its size, and what writes its values.
struct VtkArray {
  VtkSection section;
  std::string name;
  std::string type;
  int components;
  std::uint64_t bytes;
  std::function<void(ByteWriter&)> write;
};

/// Writes a grid of that many points and cells. An empty point_data section is legal.
void write_vtk_grid(ByteWriter& out, std::uint64_t points, std::uint64_t cells,
                    const std::vector<VtkArray>& arrays);

inline void write_vector(ByteWriter& out, const Vec3& v) {
  out.number(v.x);
  out.number(v.y);
  out.number(v.z);
}

/// VTK's name of a type of numbers.
template <class Number>
constexpr const char* vtk_type() {
  if constexpr (std::is_same_v<Number, double>) return "Float64";
  if constexpr (std::is_same_v<Number, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<Number, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<Number, std::uint8_t>) return "UInt8";
}

/// An array that holds its values: numbers with one component.
template <class Number>
VtkArray vtk_array(VtkSection section, std::string name, std::vector<Number> values) {
  const auto kept = std::make_shared<const std::vector<Number>>(std::move(values));
  return {section,
          std::move(name),
          vtk_type<Number>(),
          1,
          sizeof(Number) * kept->size(),
          [kept](ByteWriter& out) {
            for (const Number value : *kept) out.number(value);
          }};
}

/// As above, vectors with three components.
inline VtkArray vtk_array(VtkSection section, std::string name, std::vector<Vec3> values) {
  const auto kept = std::make_shared<const std::vector<Vec3>>(std::move(values));
  return {section, std::move(name), "Float64", 3, 24 * kept->size(), [kept](ByteWriter& out) {
            for (const Vec3& value : *kept) write_vector(out, value);
          }};
}

}  // namespace packstone
