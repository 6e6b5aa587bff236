#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

#include "packstone/core/error.hpp"
#include "packstone/io/packing_file.hpp"

namespace packstone {
namespace {

namespace fs = std::filesystem;

fs::path follow_links(fs::path path) {
  const fs::path first = path;
  constexpr int kMostLinks = 40;  // the kernel's own limit
  for (int hop = 0; hop < kMostLinks; ++hop) {
    std::error_code problem;
    const fs::path next = fs::read_symlink(path, problem);
    if (problem) return path;
    path = path.parent_path() / next;
  }
  throw FileError(first.string() +
                  ": cannot be written: " + std::generic_category().message(ELOOP));
}

// Unique among the threads of this process by the counter, among processes by the number.
fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  return target.parent_path() /
         (".packstone-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp");
}

// The rename itself survives a power cut only once the folder is on the disk too. Not every file
// system can do that, and the content is safe either way: failure is ignored.
void flush_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target) : named_(target), target_(follow_links(target)) {
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (exists && ::access(target_.c_str(), W_OK) != 0) fail("cannot be written");
  if (exists && !S_ISREG(status.st_mode)) {
    replaces_ = false;
    temporary_ = target_;
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot be written");
    return;
  }
  open_temporary();
  if (exists) ::fchmod(descriptor_, status.st_mode & 07777);
}

void AtomicFile::open_temporary() {
  constexpr mode_t kModeBeforeUmask = 0666;
  do {
    temporary_ = temporary_beside(target_);
    descriptor_ =
        ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kModeBeforeUmask);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) fail("cannot be written");
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (replaces_) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("writing failed");
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  if (replaces_) {
    if (::fsync(descriptor_) != 0) fail("writing failed");
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot be replaced");
    flush_folder(target_);
  }
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail("writing failed");
}

void AtomicFile::fail(const char* action) const {
  const int code = errno;
  throw FileError(named_.string() + ": " + action + ": " + std::generic_category().message(code));
}

void write_atomically(const fs::path& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

void check_writable(const fs::path& path) {
  std::error_code no_such_file;
  const fs::file_type type = fs::status(path, no_such_file).type();
  const bool listens = type == fs::file_type::fifo || type == fs::file_type::character ||
                       type == fs::file_type::socket || type == fs::file_type::block;
  if (!listens) {
    const AtomicFile trial(path);
  } else if (::access(path.c_str(), W_OK) != 0) {
    throw FileError(path.string() +
                    ": cannot be written: " + std::generic_category().message(errno));
  }
}

}  // namespace packstone
