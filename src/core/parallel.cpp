#include "packstone/core/parallel.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace packstone {

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
  arena.execute([&] {
    tbb::parallel_for(Range(0, count, static_cast<std::size_t>(grain)),
                      [&](const Range& range) { body(range.begin(), range.end()); });
  });
}

int hardware_threads() noexcept { return tbb::info::default_concurrency(); }

}  // namespace packstone
