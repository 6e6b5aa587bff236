#pragma once

/// @file
/// Numbers as little-endian bytes into a file, through a buffer.

#include <bit>
#include <string>
#include <string_view>

#include "io/atomic_file.hpp"

namespace packstone {

/// Appends to an AtomicFile in large pieces; flush() before commit().
class ByteWriter {
 public:
  static_assert(std::endian::native == std::endian::little,
                "the formats are little-endian, and numbers are copied as they lie in memory");

  explicit ByteWriter(AtomicFile& file) : file_(file) {}

  template <class Number>
  void number(Number value) {
    text({reinterpret_cast<const char*>(&value), sizeof value});
  }
  void text(std::string_view bytes) {
    buffer_ += bytes;
    if (buffer_.size() >= kPiece) flush();
  }
  void flush() {
    file_.write(buffer_);
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kPiece = 1 << 20;
  AtomicFile& file_;
  std::string buffer_;
};

}  // namespace packstone
