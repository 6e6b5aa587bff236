#pragma once

/// @file
/// Exports for other programs: VTK surfaces, STL, CSV.

#include <filesystem>
#include <optional>
#include <string>

#include "packstone/structure/packing.hpp"

namespace packstone {

/// Options of export_packing().
struct ExportOptions {
  /// Segments around a full circle of a curved surface [-]. 8 to 4096.
  int segments = 32;

  /// Also write the periodic images that reach into the cell: images_reaching_in(),
  /// face_crossings.hpp. A table then says which faces of the cell each body cuts.
  bool images = false;

  /// Write the balls that each body is decomposed into, instead of the bodies: one line of a table
  /// per ball, the distance of the first two being this over the radius of the largest,
  /// inscribed_balls.hpp [-]. 0.01 to 1.
  std::optional<double> ball_spacing = {};
};

/// Writes by ending: `.vtu` (surface triangles, in 2D polygons, with one set of values per
/// inclusion as cell data: inclusion, group, shape, volume, ...), `.stl` (binary; 3D only), `.csv`
/// (one line per inclusion).
///
/// docs/exports.md lists the fields. Files are written whole or not at all.
///
/// Errors: throws InvalidArgument for an unknown ending, STL of a 2D packing, balls that are not to
/// be a table, an option out of range
///         or a packing that is not well formed, FileError when the file cannot be written.
void export_packing(const std::filesystem::path& path, const Packing& packing,
                    const ExportOptions& options = {});

}  // namespace packstone
