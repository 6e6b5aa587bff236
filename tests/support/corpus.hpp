#pragma once

/// @file
/// Replay of the files that a fuzz target starts from and those that it once found.

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "support/temporary_folder.hpp"

namespace packstone::test {

/// Calls `holds` on the content of every file in `folder`, which are `least_files` or more. What
/// is named "found_..." (by a fuzzer) or "broken_..." (by hand) may be refused, the rest may not.
template <class Holds>
void replay_corpus(const std::filesystem::path& folder, int least_files, Holds holds) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    INFO(name);
    const bool may_be_refused = name.rfind("found_", 0) == 0 || name.rfind("broken_", 0) == 0;
    const bool accepted = holds(content_of(entry.path()));
    CHECK((accepted || may_be_refused));
    ++files;
  }
  CHECK(files >= least_files);
}

}  // namespace packstone::test
