#include "packstone/core/version.hpp"

namespace packstone {

std::string_view version() noexcept { return PACKSTONE_VERSION; }

}  // namespace packstone
