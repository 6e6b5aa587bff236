#include "io/isolated.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include "packstone/core/error.hpp"

namespace packstone {
namespace {

[[noreturn]] void fail(const char* what) {
  const int code = errno;
  throw FileError(std::string(what) + ": " + std::generic_category().message(code));
}

void limit(int resource, rlim_t most) {
  const rlimit bound{most, most};
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &bound);
}

// A crash is expected here: silent, without a core file, and seen by nobody's handler.
void prepare_to_crash(double seconds) {
  for (const int signal : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) {
    std::signal(signal, SIG_DFL);
  }
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(seconds)));
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
}

// Never returns, so that nothing of the parent's is flushed or destroyed twice.
[[noreturn]] void be_child(double seconds, const std::function<void()>& work, int answer) {
  prepare_to_crash(seconds);
  try {
    work();
  } catch (const std::exception& problem) {
    const std::string_view text = problem.what();
    const ssize_t told = ::write(answer, text.data(), text.size());
    ::_exit(told > 0 ? 1 : 2);
  } catch (...) {
    ::_exit(2);
  }
  ::_exit(0);
}

std::string all_of(int descriptor) {
  std::string text;
  char part[512];
  while (true) {
    const ssize_t got = ::read(descriptor, part, sizeof part);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(part, static_cast<std::size_t>(got));
  }
}

}  // namespace

void run_isolated(double seconds, const std::function<void()>& work) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail("no pipe to another process");
  const pid_t child = ::fork();
  if (child == 0) be_child(seconds, work, ends[1]);
  ::close(ends[1]);
  const std::string problem = child > 0 ? all_of(ends[0]) : std::string();
  ::close(ends[0]);
  if (child < 0) fail("no further process");
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (!problem.empty()) throw InvalidArgument(problem);
  const bool endless =
      WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
  throw InvalidArgument(std::string("is damaged: its reader ") +
                        (endless ? "came to no end" : "crashed"));
}

ScratchFile::ScratchFile() {
  std::string name = (std::filesystem::temp_directory_path() / "packstone-XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) fail("no temporary file");
  ::close(descriptor);
  path_ = name;
}

ScratchFile::~ScratchFile() { ::unlink(path_.c_str()); }

}  // namespace packstone
