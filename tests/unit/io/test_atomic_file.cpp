#include "io/atomic_file.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <iterator>

#include "packstone/core/error.hpp"
#include "packstone/io/packing_file.hpp"
#include "support/random_packing.hpp"
#include "support/temporary_folder.hpp"

namespace packstone {
namespace {

namespace fs = std::filesystem;

int files_in(const test::TemporaryFolder& folder) {
  return static_cast<int>(
      std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

TEST_CASE("an atomic file appears on commit and leaves nothing else behind") {
  const test::TemporaryFolder folder;
  {
    AtomicFile file(folder / "a");
    file.write("half");
    CHECK_FALSE(fs::exists(folder / "a"));
    file.write(" and half");
    file.commit();
  }
  CHECK(test::content_of(folder / "a") == "half and half");
  CHECK(files_in(folder) == 1);
}

TEST_CASE("an atomic file that is given up leaves the old content") {
  const test::TemporaryFolder folder;
  write_atomically(folder / "a", "old");
  {
    AtomicFile file(folder / "a");
    file.write("new");
  }
  CHECK(test::content_of(folder / "a") == "old");
  CHECK(files_in(folder) == 1);
}

TEST_CASE("a disk that fills up leaves the old file, for every format") {
  const test::TemporaryFolder folder;
  const Packing small = test::random_packing(3, 1, 1);
  const Packing large = test::random_packing(3, 3000, 2);
  for (const char* name : {"a.json", "a.h5"}) {
    write_packing(folder / name, small);
    const std::string before = test::content_of(folder / name);
    // The limit on the size of files stands for a full disk.
    rlimit old_limit{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &old_limit) == 0);
    const auto old_action = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit = old_limit;
    limit.rlim_cur = 100'000;
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    std::string message;
    try {
      write_packing(folder / name, large);
    } catch (const FileError& problem) {
      message = problem.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &old_limit);
    std::signal(SIGXFSZ, old_action);
    CHECK_THAT(message, Catch::StartsWith((folder / name).string()));
    CHECK(test::content_of(folder / name) == before);
  }
  CHECK(files_in(folder) == 2);
}

TEST_CASE("a new file has the permissions of any new file, a replaced one keeps its own") {
  const test::TemporaryFolder folder;
  const mode_t old_mask = ::umask(0027);
  write_atomically(folder / "new", "x");
  ::umask(old_mask);
  struct stat status {};
  REQUIRE(::stat((folder / "new").c_str(), &status) == 0);
  CHECK((status.st_mode & 07777) == 0640);
  REQUIRE(::chmod((folder / "new").c_str(), 0604) == 0);
  write_atomically(folder / "new", "y");
  REQUIRE(::stat((folder / "new").c_str(), &status) == 0);
  CHECK((status.st_mode & 07777) == 0604);
}

TEST_CASE("a link is followed and stays a link, also one that leads nowhere yet") {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "elsewhere");
  fs::create_symlink("elsewhere/file", folder / "link");
  write_atomically(folder / "link", "one");
  write_atomically(folder / "link", "two");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(test::content_of(folder / "elsewhere/file") == "two");
  fs::create_symlink("circle", folder / "circle");
  CHECK_THROWS_AS(write_atomically(folder / "circle", "x"), FileError);
}

TEST_CASE("what is not a regular file is written to and not replaced") {
  write_atomically("/dev/null", "x");
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("whether a file can be written is known without writing it") {
  const test::TemporaryFolder folder;
  CHECK_NOTHROW(check_writable(folder / "new"));
  CHECK(fs::is_empty(folder.path()));
  write_atomically(folder / "old", "x");
  CHECK_NOTHROW(check_writable(folder / "old"));
  CHECK(test::content_of(folder / "old") == "x");
  CHECK_THROWS_WITH(check_writable(folder / "no/file"), Catch::Contains("No such file"));
  CHECK_THROWS_WITH(check_writable(folder.path()), Catch::Contains("Is a directory"));
  // No file can be made there, whoever asks.
  CHECK_THROWS_WITH(check_writable("/proc/x.json"), Catch::Contains("/proc/x.json: cannot be"));
  CHECK_NOTHROW(check_writable("/dev/null"));
  // Opening a pipe would wait for a reader.
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_NOTHROW(check_writable(folder / "pipe"));
}

TEST_CASE("messages name the path and the system's reason") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH(write_atomically(folder / "no/file", "x"),
                    Catch::Contains("no/file: cannot be written: No such file or directory"));
  CHECK_THROWS_WITH(write_atomically(folder.path(), "x"), Catch::Contains("Is a directory"));
  if (::geteuid() == 0) return;  // root may write anywhere
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  CHECK_THROWS_WITH(write_atomically(folder / "file", "x"), Catch::Contains("Permission denied"));
  fs::permissions(folder.path(), fs::perms::owner_all);
}

}  // namespace
}  // namespace packstone
