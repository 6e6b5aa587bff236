#pragma once

/// @file
/// One function per format of export_tessellation(); all throw as it does. What they are given is
/// well formed and belongs together.

#include <vector>

#include "io/export/byte_writer.hpp"
#include "packstone/structure/packing.hpp"
#include "packstone/structure/tessellation.hpp"

namespace packstone {

void write_cells_vtu(ByteWriter& out, const Tessellation& tessellation, const Packing& packing);
void write_cells_csv(ByteWriter& out, const Tessellation& tessellation, const Packing& packing);
void write_cells_tess(ByteWriter& out, const Tessellation& tessellation, const Packing& packing);
void write_cells_geo(ByteWriter& out, const Tessellation& tessellation, const Packing& packing);

/// Throws InvalidArgument when one of the two is not well formed, or the tessellation is not one of
/// the packing: another box, another number of cells.
void check_match(const Tessellation& tessellation, const Packing& packing);

/// Measures in proportion to those of the inclusions, which sum to that of the box [L^d].
[[nodiscard]] std::vector<double> ordered_measures(const Packing& packing);

}  // namespace packstone
