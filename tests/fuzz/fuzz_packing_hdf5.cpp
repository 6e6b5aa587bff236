#include <cstddef>
#include <cstdint>

#include "support/reader_oracles.hpp"

// The library forgets memory of its own when it gives up on a damaged file.
extern "C" const char* __asan_default_options() {  // NOLINT: the sanitizer names it
  return "detect_leaks=0";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static_cast<void>(
      packstone::test::hdf5_reader_holds({reinterpret_cast<const char*>(data), size}));
  return 0;
}
