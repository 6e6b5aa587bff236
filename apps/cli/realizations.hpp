#pragma once

/// @file
/// Several packings of one recipe, which differ in their seed alone.

#include <cstdint>
#include <filesystem>

#include "packstone/recipe/recipe.hpp"

namespace packstone::cli {

/// What to make, and how to tell of it.
struct RealizationArguments {
  std::int64_t count = 1;        ///< >= 1.
  std::filesystem::path output;  ///< "fibers.json" becomes fibers-1.json for seed 1, ...
  int threads = 0;               ///< 0: all of the machine.
  bool quiet = false;
  bool json = false;
};

/// Packs `recipe` with its seed and those that follow, one on each thread, writes each packing when
/// it is certified, and prints a summary. Returns the exit code.
///
/// A packing does not depend on the number of threads; a time limit is for each. An interrupt keeps
/// those that are done.
[[nodiscard]] int pack_realizations(const Recipe& recipe, const RealizationArguments& arguments);

}  // namespace packstone::cli
