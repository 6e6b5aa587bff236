#include <cstddef>
#include <cstdint>

#include "support/reader_oracles.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static_cast<void>(
      packstone::test::checkpoint_reader_holds({reinterpret_cast<const char*>(data), size}));
  return 0;
}
