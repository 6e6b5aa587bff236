#pragma once

/// @file
/// What must hold for the reader of recipes and any text whatsoever: used by the fuzz target and
/// the replay of its corpus.

#include <string_view>

namespace packstone::test {

/// Reads `text` as a recipe, JSON where it begins with "{" and TOML otherwise; the lines at its top
/// that begin with "#set " are overrides. It is refused with InvalidArgument, or accepted and then
/// written as JSON and read again without a change. Anything else is a defect and is thrown as
/// std::logic_error.
/// @return Whether it was accepted.
bool recipe_reader_holds(std::string_view text);

}  // namespace packstone::test
