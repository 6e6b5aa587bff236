#include "progress_printer.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace packstone::cli {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr auto kFirstLogLine = std::chrono::seconds(2);  // short work stays silent
constexpr auto kLogPause = std::chrono::seconds(5);
// The rate is that of the latter half of the work so far, as it falls when the cell fills; over at
// most this.
constexpr auto kRateWindow = std::chrono::seconds(10);
constexpr double kShortestWindow = 0.5;  // [s] before a rate is told

std::size_t terminal_width() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

std::string clock_text(double seconds) {
  const long long s = std::llround(std::min(seconds, 3.6e7));
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

ProgressPrinter::ProgressPrinter()
    : terminal_(isatty(STDERR_FILENO) != 0),
      next_(Clock::now() + (terminal_ ? Clock::duration::zero() : Clock::duration(kFirstLogLine))) {
}

ProgressPrinter::~ProgressPrinter() {
  if (dirty_) std::fputs("\r\033[K", stderr);
}

void ProgressPrinter::remember(const Progress& progress, Clock::time_point now) {
  // Work that starts anew, or another stage, has a rate of its own.
  const bool anew = !recent_.empty() && (progress.placed < recent_.back().placed ||
                                         progress.done < recent_.back().done);
  if (anew) recent_.clear();
  if (recent_.empty()) start_ = now;
  recent_.push_back({now, progress.done, progress.placed});
  const auto window = std::min<Clock::duration>(kRateWindow, (now - start_) / 2);
  while (recent_.size() > 2 && now - recent_[1].when > window) recent_.pop_front();
}

std::string ProgressPrinter::line(const Progress& progress, Clock::time_point now) {
  std::string text(progress.stage);
  if (progress.wanted > 0) {
    text += fmt::format("  {} of {}", progress.placed, progress.wanted);
  } else if (progress.placed > 0) {
    text += fmt::format("  {}", progress.placed);
  }
  if (progress.done >= 0.0) text += fmt::format("  {:.1f} %", 100.0 * progress.done);
  if (progress.fraction > 0.0) text += fmt::format("  fraction {:.4f}", progress.fraction);
  const double window = Seconds(now - recent_.front().when).count();
  if (window < kShortestWindow) return text;
  const double placed = static_cast<double>(progress.placed - recent_.front().placed);
  if (placed > 0.0) text += fmt::format("  {:.4g}/s", placed / window);
  const double gained = progress.done - recent_.front().done;
  if (gained > 0.0 && progress.done >= 0.0) {
    text += "  time left " + clock_text((1.0 - progress.done) * window / gained);
  }
  return text;
}

void ProgressPrinter::print(const Progress& progress) {
  const auto now = Clock::now();
  remember(progress, now);
  if (now < next_) return;
  const std::string text = line(progress, now);
  if (terminal_) {
    fmt::print(stderr, "\r{}\033[K", text.substr(0, terminal_width() - 1));
    dirty_ = true;
  } else {
    next_ = now + kLogPause;
    fmt::print(stderr, "{}\n", text);
  }
  std::fflush(stderr);
}

}  // namespace packstone::cli
