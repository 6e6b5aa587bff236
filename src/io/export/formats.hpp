#pragma once

/// @file
/// One function per format of export_packing(); all throw as it does. The packing is well formed.

#include "io/export/byte_writer.hpp"
#include "packstone/io/export_packing.hpp"

namespace packstone {

void write_vtu(ByteWriter& out, const Packing& packing, const ExportOptions& options);
void write_stl(ByteWriter& out, const Packing& packing, const ExportOptions& options);
void write_csv(ByteWriter& out, const Packing& packing, const ExportOptions& options);
/// Where `ball_spacing` is given.
void write_balls_csv(ByteWriter& out, const Packing& packing, const ExportOptions& options);

}  // namespace packstone
