// The one translation unit that compiles toml++, so that the others need only its declarations and
// the program no further shared library.
#define TOML_HEADER_ONLY 0
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
