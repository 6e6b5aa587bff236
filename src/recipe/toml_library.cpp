// The one translation unit that compiles toml++, so that the others need only its declarations and
// the program no further shared library.
#define TOML_IMPLEMENTATION
#include "recipe/toml.hpp"

namespace packstone::recipe {

void refuse_as_malformed() { throw toml::parse_error("malformed", toml::source_position{}); }

}  // namespace packstone::recipe
