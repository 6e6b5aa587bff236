#include "output_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "packstone/core/error.hpp"
#include "packstone/io/packing_file.hpp"

namespace packstone::cli {

void check_output_path(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  if (fs::is_directory(path)) throw FileError(path.string() + " is a folder, not a file");
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) {
    throw FileError("cannot write " + path.string() + ": there is no folder " + folder.string());
  }
  check_writable(path);
}

void check_output_file(const std::filesystem::path& path, const std::vector<std::string>& endings,
                       const std::string& option) {
  const std::string ending = path.extension().string();
  if (std::find(endings.begin(), endings.end(), ending) == endings.end()) {
    throw InvalidArgument(fmt::format("{} {}: {}; allowed is {}{}", option, path.string(),
                                      ending.empty() ? "no ending" : "unknown ending " + ending,
                                      endings.size() > 1 ? "one of " : "",
                                      fmt::join(endings, ", ")));
  }
  check_output_path(path);
}

}  // namespace packstone::cli
