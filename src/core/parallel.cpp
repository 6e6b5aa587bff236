#include "packstone/core/parallel.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace packstone {
namespace {

// The TBB library is not built with the thread sanitizer, which therefore does not see that workers
// begin after the call and end before it returns. It is told here, and only that: a race between
// two workers stays visible.
class ForkJoin {
 public:
#if defined(__SANITIZE_THREAD__)
  void fork() { __tsan_release(&begin_); }
  void worker_begins() { __tsan_acquire(&begin_); }
  void worker_ends() { __tsan_release(&end_); }
  void join() { __tsan_acquire(&end_); }

 private:
  char begin_ = 0;
  char end_ = 0;
#else
  void fork() {}
  void worker_begins() {}
  void worker_ends() {}
  void join() {}
#endif
};

}  // namespace

void parallel_for(std::int64_t count, int threads, std::int64_t grain,
                  const std::function<void(std::int64_t begin, std::int64_t end)>& body) {
  if (count <= 0) return;
  if (threads == 1 || count <= grain) {
    body(0, count);
    return;
  }
  using Range = tbb::blocked_range<std::int64_t>;
  const int workers = threads > 0 ? threads : hardware_threads();
  // Without it, asking for more threads than processors draws a warning on standard error.
  const tbb::global_control allowed(
      tbb::global_control::max_allowed_parallelism,
      static_cast<std::size_t>(std::max(workers, hardware_threads())));
  tbb::task_arena arena(workers);
  ForkJoin seen;
  seen.fork();
  arena.execute([&] {
    tbb::parallel_for(Range(0, count, static_cast<std::size_t>(grain)), [&](const Range& range) {
      seen.worker_begins();
      body(range.begin(), range.end());
      seen.worker_ends();
    });
  });
  seen.join();
}

int hardware_threads() noexcept { return tbb::info::default_concurrency(); }

}  // namespace packstone
