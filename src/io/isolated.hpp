#pragma once

/// @file
/// Work in a process of its own, for libraries that may crash on damaged input.

#include <filesystem>
#include <functional>

namespace packstone {

/// Runs `work` in a child process, which shares files with this one but no memory.
///
/// Errors:  throws InvalidArgument with the message of what `work` throws; or saying that the
///          content is damaged, when the child crashes or uses more than `seconds` of processor
///          time; FileError when there is no further process.
/// Cost:    under a millisecond.
void run_isolated(double seconds, const std::function<void()>& work);

/// A new empty file in the system's folder for such, removed at the end. Throws FileError.
class ScratchFile {
 public:
  ScratchFile();
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace packstone
