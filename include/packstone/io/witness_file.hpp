#pragma once

/// @file
/// Witness files: one separating direction per near pair, as text that anybody's code can re-check.
///
/// One line per pair, nine comma-separated fields, doubles as the shortest decimals that read back
/// the same; lines that begin with # are remarks. docs/certificate.md shows a reader in ten lines.
///
///     # packstone-witness 1
///     # a,b,image_x,image_y,image_z,direction_x,direction_y,direction_z,gap
///     0,17,0,-1,0,0.6,0.8,0,0.0123

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "packstone/structure/check_packing.hpp"

namespace packstone {

/// The text of a witness file.
[[nodiscard]] std::string witnesses_to_text(const std::vector<PairWitness>& witnesses);

/// Reads the text of a witness file; `origin` stands for the file in messages. Throws FileError
/// naming the line, when the first line is not that of a witness file, a line does not have nine
/// fields, a field is not a finite number of its kind, or a direction is not of length 1 within
/// 1e-9.
[[nodiscard]] std::vector<PairWitness> witnesses_from_text(std::string_view text,
                                                           const std::string& origin);

/// Writes a witness file whole or not at all. Throws FileError.
void write_witnesses(const std::filesystem::path& path, const std::vector<PairWitness>& witnesses);

/// Reads a witness file. Throws FileError.
[[nodiscard]] std::vector<PairWitness> read_witnesses(const std::filesystem::path& path);

}  // namespace packstone
