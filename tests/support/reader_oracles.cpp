#include "support/reader_oracles.hpp"

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "io/packing_hdf5.hpp"
#include "packstone/core/error.hpp"
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
std::optional<Packing> accepted(Read read) {
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

}  // namespace

bool json_reader_holds(std::string_view text) {
  return survives_rewriting(accepted([&] { return packing_from_json(text, "any bytes"); }));
}

bool hdf5_reader_holds(std::string_view bytes) {
  // One folder and name for all calls: a fuzz target comes here a thousand times a second.
  static const TemporaryFolder folder;
  const std::filesystem::path path = folder / "any_bytes.h5";
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  // In this process, where sanitizers and the search for new inputs see what happens.
  return survives_rewriting(accepted([&] { return read_packing_hdf5_here(path); }));
}

}  // namespace packstone::test
