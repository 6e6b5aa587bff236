#include "packstone/io/packing_file.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "io/packing_hdf5.hpp"
#include "packstone/core/error.hpp"

namespace packstone {
namespace {

enum class FileKind { json, hdf5, unknown };

FileKind kind_by_ending(const std::filesystem::path& path) {
  const std::filesystem::path ending = path.extension();
  return ending == ".json" ? FileKind::json : ending == ".h5" ? FileKind::hdf5 : FileKind::unknown;
}

[[noreturn]] void refuse_ending(const std::filesystem::path& path) {
  throw FileError(path.string() + ": packing files end in .json or .h5");
}

std::string read_text(const std::filesystem::path& path) {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const auto fail = [&] {
    const int code = errno;
    throw FileError(path.string() + ": cannot be read: " + std::generic_category().message(code));
  };
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) fail();
  std::string text;
  std::size_t used = 0;
  do {
    text.resize(used + std::max<std::size_t>(used, 1 << 16));
    used += std::fread(text.data() + used, 1, text.size() - used, file.get());
    if (std::ferror(file.get())) fail();
  } while (used == text.size());
  text.resize(used);
  return text;
}

}  // namespace

bool is_packing_file_name(const std::filesystem::path& path) {
  return kind_by_ending(path) != FileKind::unknown;
}

Packing read_packing(const std::filesystem::path& path) {
  switch (kind_by_ending(path)) {
    case FileKind::json:
      return packing_from_json(read_text(path), path.string());
    case FileKind::hdf5:
      return read_packing_hdf5(path);
    case FileKind::unknown:
      break;
  }
  refuse_ending(path);
}

void write_packing(const std::filesystem::path& path, const Packing& packing) {
  switch (kind_by_ending(path)) {
    case FileKind::json:
      return write_atomically(path, packing_to_json(packing));
    case FileKind::hdf5:
      return write_packing_hdf5(path, packing);
    case FileKind::unknown:
      break;
  }
  refuse_ending(path);
}

}  // namespace packstone
