#pragma once

/// @file
/// AtomicFile: a file that appears whole or not at all.

#include <filesystem>
#include <string_view>

namespace packstone {

/// A temporary file beside its target, which it replaces on commit().
///
/// A link is followed and stays a link. A new file gets the permissions of any new file, one that
/// is replaced keeps its own. What is not a regular file (a pipe, a terminal) has no old content to
/// protect and cannot be replaced: it is written to directly.
///
/// Errors: every member throws FileError with the path and the reason the system gives.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends.
  void write(std::string_view content);

  /// Where the content stands until commit(): another library may write there too.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  /// false: the target is a pipe, a terminal or the like, and temporary() is the target itself.
  [[nodiscard]] bool replaces() const { return replaces_; }

  /// Flushes to the disk and renames. Without it the destructor removes the temporary file.
  void commit();

 private:
  void open_temporary();
  [[noreturn]] void fail(const char* action) const;

  std::filesystem::path named_;      ///< As the caller wrote it, for messages.
  std::filesystem::path target_;     ///< Links followed.
  std::filesystem::path temporary_;  ///< Beside target_.
  int descriptor_ = -1;
  bool replaces_ = true;
};

}  // namespace packstone
