#include "packstone/core/memory.hpp"

#include <unistd.h>

#include <limits>

namespace packstone {

double physical_memory() noexcept {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long bytes = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || bytes <= 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(pages) * static_cast<double>(bytes);
}

}  // namespace packstone
