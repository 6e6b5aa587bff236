#include "io/isolated.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <string>

#include "packstone/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

TEST_CASE("isolated work leaves files behind but no memory") {
  const ScratchFile file;
  int value = 1;
  run_isolated(10, [&] {
    value = 2;
    std::ofstream(file.path()) << "seen";
  });
  CHECK(value == 1);
  CHECK(test::content_of(file.path()) == "seen");
}

TEST_CASE("a scratch file is gone with its object") {
  std::filesystem::path path;
  {
    const ScratchFile file;
    path = file.path();
    CHECK(std::filesystem::is_empty(path));
  }
  CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("what isolated work throws, a crash and endless work become messages") {
  CHECK_THROWS_WITH(run_isolated(10, [] { throw FileError("no such luck"); }), "no such luck");
  CHECK_THROWS_AS(run_isolated(10, [] { throw FileError("no such luck"); }), InvalidArgument);
  CHECK_THROWS_WITH(run_isolated(10, [] { std::raise(SIGSEGV); }),
                    "is damaged: its reader crashed");
  CHECK_THROWS_WITH(run_isolated(10, [] { throw 5; }), "is damaged: its reader crashed");
  CHECK_THROWS_WITH(run_isolated(1,
                                 [] {
                                   volatile bool forever = true;
                                   while (forever) {
                                   }
                                 }),
                    "is damaged: its reader came to no end");
}

}  // namespace
}  // namespace packstone
