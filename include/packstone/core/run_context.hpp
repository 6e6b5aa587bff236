#pragma once

/// @file
/// What long work hears from its caller and tells it: cancellation, time limit, threads, progress.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string_view>

namespace packstone {

/// A report on the way.
struct Progress {
  std::string_view stage;   ///< What is being done, two or three words.
  double done = 0.0;        ///< Part of the work that is done [-], in [0, 1]; < 0 when unknown.
  double fraction = 0.0;    ///< Volume fraction reached [-].
  std::int64_t placed = 0;  ///< Inclusions placed.
  std::int64_t wanted = 0;  ///< Inclusions ordered; 0 when the count is open.
};

/// Why work was asked to stop.
enum class StopRequest {
  none,         ///< Go on.
  cancelled,    ///< The caller cancelled.
  out_of_time,  ///< The time limit has passed.
};

/// Passed by value through every long call; the default never stops and reports to nobody.
class RunContext {
 public:
  using Clock = std::chrono::steady_clock;

  RunContext() = default;

  /// Work stops soon after `*flag` becomes true. The flag outlives the work; nullptr: none.
  RunContext& cancel_flag(const std::atomic<bool>* flag) {
    cancel_ = flag;
    return *this;
  }
  /// Work stops soon after this instant.
  RunContext& deadline(Clock::time_point when) {
    deadline_ = when;
    return *this;
  }
  /// Work stops soon after that many seconds from now, or at the deadline set before, whichever is
  /// earlier. A limit beyond a century is none: the clock could not hold it.
  RunContext& time_limit(double seconds) {
    constexpr double kCentury = 3e9;
    const std::chrono::duration<double> limit(std::min(seconds, kCentury));
    return deadline(
        std::min(Clock::now() + std::chrono::duration_cast<Clock::duration>(limit), deadline_));
  }
  /// Worker threads; results do not depend on it. 0: as many as the machine has.
  RunContext& threads(int count) {
    threads_ = count;
    return *this;
  }
  /// Called with reports, from the calling thread only, at most some ten times a second.
  RunContext& on_progress(std::function<void(const Progress&)> callback) {
    progress_ = std::move(callback);
    return *this;
  }

  [[nodiscard]] int threads() const noexcept { return threads_; }
  [[nodiscard]] Clock::time_point deadline() const noexcept { return deadline_; }

  /// Reads the flag and the clock: some 30 ns. Call it every few microseconds of work at most.
  [[nodiscard]] StopRequest stop_request() const noexcept {
    if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed)) {
      return StopRequest::cancelled;
    }
    if (deadline_ != Clock::time_point::max() && Clock::now() >= deadline_) {
      return StopRequest::out_of_time;
    }
    return StopRequest::none;
  }

  /// Passes the report on unless the last one is younger than a tenth of a second.
  void report(const Progress& progress) {
    if (!progress_) return;
    const auto now = Clock::now();
    if (now - last_report_ < std::chrono::milliseconds(100)) return;
    last_report_ = now;
    progress_(progress);
  }

 private:
  const std::atomic<bool>* cancel_ = nullptr;
  Clock::time_point deadline_ = Clock::time_point::max();
  int threads_ = 1;
  std::function<void(const Progress&)> progress_;
  Clock::time_point last_report_{};
};

}  // namespace packstone
