#pragma once

/// @file
/// Runs a Python script of the tests: other people's readers are our oracles.

#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

namespace packstone::test {

/// Runs `script` of tests/python with `arguments`; the script ends with 0 when all holds and with
/// 77 when a module it needs is not installed, which is a warning.
inline void run_python(const std::string& script, const std::string& arguments) {
  const std::string command =
      std::string(PACKSTONE_PYTHON) + " " + PACKSTONE_PYTHON_SCRIPTS + script + " " + arguments;
  const int status = std::system(command.c_str());
  REQUIRE(WIFEXITED(status));
  constexpr int kModuleMissing = 77;
  constexpr int kNoPython = 127;
  const int code = WEXITSTATUS(status);
  if (code == kModuleMissing || code == kNoPython) {
    WARN(script << " skipped: Python or one of its modules is missing");
    return;
  }
  CHECK(code == 0);
}

}  // namespace packstone::test
