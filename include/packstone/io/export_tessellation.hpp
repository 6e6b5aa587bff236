#pragma once

/// @file
/// Tessellations for other programs: VTK, Neper, Gmsh, a table of the cells.

#include <filesystem>

#include "packstone/structure/packing.hpp"
#include "packstone/structure/tessellation.hpp"

namespace packstone {

/// Writes by ending: `.vtu` (polygons in 2D, polyhedra in 3D, with the values of each cell), `.csv`
/// (one line per cell).
///
/// Cells stand whole where their inclusions do, also across periodic faces.
/// docs/tessellation_files.md lists the fields. Files are written whole or not at all.
///
/// @param packing  What the tessellation was made of: one inclusion per cell, in order.
///
/// Errors: throws InvalidArgument for an unknown ending, .geo of polyhedra, or a tessellation or a
/// packing that is not
///         well formed or does not belong to the other; FileError when the file cannot be written.
void export_tessellation(const std::filesystem::path& path, const Tessellation& tessellation,
                         const Packing& packing);

}  // namespace packstone
