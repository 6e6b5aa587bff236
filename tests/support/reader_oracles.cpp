#include "support/reader_oracles.hpp"

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

#include "io/packing_hdf5.hpp"
#include "packstone/core/error.hpp"
#include "packstone/io/checkpoint_file.hpp"
#include "packstone/io/packing_file.hpp"
#include "support/temporary_folder.hpp"

// For builds with sanitizers. The HDF5 library forgets memory of its own when it gives up on a
// damaged file, and asks for absurd amounts but lives with the refusal.
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1"; }
extern "C" const char* __tsan_default_options() { return "allocator_may_return_null=1"; }
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\n"; }

namespace packstone::test {
namespace {

template <class Read>
auto accepted(Read read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const FileError&) {
    return std::nullopt;
  }
}

// What a reader accepted any writer must take, and the text must say the same again.
bool survives_rewriting(const std::optional<Packing>& packing) {
  if (!packing) return false;
  const std::string text = packing_to_json(*packing);
  if (packing_to_json(packing_from_json(text, "rewritten")) != text) {
    throw std::logic_error("a packing changed on its way through a file");
  }
  return true;
}

// One folder for all calls: a fuzz target comes here a thousand times a second.
const TemporaryFolder& folder_of_all() {
  static const TemporaryFolder folder;
  return folder;
}

std::filesystem::path file_of(std::string_view bytes) {
  std::filesystem::path path = folder_of_all() / "any_bytes.h5";
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  return path;
}

// The same state makes the same bytes, to the last bit of every number.
std::string bytes_of(const MovingPacking& moving) {
  const std::filesystem::path path = folder_of_all() / "rewritten.h5";
  write_checkpoint(path, moving);
  return content_of(path);
}

}  // namespace

bool json_reader_holds(std::string_view text) {
  return survives_rewriting(accepted([&] { return packing_from_json(text, "any bytes"); }));
}

bool hdf5_reader_holds(std::string_view bytes) {
  const std::filesystem::path path = file_of(bytes);
  // In this process, where sanitizers and the search for new inputs see what happens.
  return survives_rewriting(accepted([&] { return read_packing_hdf5_here(path); }));
}

bool checkpoint_reader_holds(std::string_view bytes) {
  const auto moving = accepted([path = file_of(bytes)] { return read_checkpoint(path); });
  if (!moving) return false;
  const std::string rewritten = bytes_of(*moving);
  if (bytes_of(read_checkpoint(file_of(rewritten))) != rewritten) {
    throw std::logic_error("a checkpoint changed on its way through a file");
  }
  return true;
}

}  // namespace packstone::test
