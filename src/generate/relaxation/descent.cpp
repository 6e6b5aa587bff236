#include "generate/relaxation/descent.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "packstone/core/parallel.hpp"

namespace packstone::relaxation {
namespace {

constexpr std::int64_t kChunk = 4096;
constexpr std::int64_t kFewest = 32;  // Chunks that are worth waking threads for.
constexpr std::size_t kMostPairs = 8;
// Each contact has curvature 1 along its normal, and a body some four of them.
constexpr double kFirstScale = 0.3;

template <class Part>
void for_chunks(std::size_t size, int threads, Part&& part) {
  const std::int64_t chunks = (static_cast<std::int64_t>(size) + kChunk - 1) / kChunk;
  parallel_for(chunks, threads, kFewest, [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t c = from; c < to; ++c) {
      const auto begin = static_cast<std::size_t>(c * kChunk);
      part(static_cast<std::size_t>(c), begin, std::min(size, begin + kChunk));
    }
  });
}

}  // namespace

double inner_product(const Motion& x, const Motion& y, int threads) {
  std::vector<double> sums((x.size() + kChunk - 1) / kChunk, 0.0);
  for_chunks(x.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    // Side by side, since one sum would wait for itself at every step.
    std::array<double, 8> parts{};
    std::size_t k = begin;
    for (; k + parts.size() <= end; k += parts.size()) {
      for (std::size_t l = 0; l < parts.size(); ++l) parts[l] += x[k + l] * y[k + l];
    }
    for (; k < end; ++k) parts[0] += x[k] * y[k];
    for (const double part : parts) sums[c] += part;
  });
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return sum;
}

void add_multiple(double factor, const Motion& x, Motion& y, int threads) {
  for_chunks(x.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) y[k] += factor * x[k];
  });
}

void CurvatureMemory::add(Motion step, Motion change) {
  constexpr double kLeastCurvature = 1e-8;
  const double curvature = inner_product(step, change, threads_);
  if (!(curvature > kLeastCurvature * inner_product(step, step, threads_))) return;
  if (pairs_.size() == kMostPairs) pairs_.pop_front();
  pairs_.push_back({std::move(step), std::move(change), 1.0 / curvature});
}

Motion CurvatureMemory::direction(const Motion& gradient) const {
  Motion d(gradient.size(), 0.0);
  add_multiple(-1.0, gradient, d, threads_);
  std::vector<double> along(pairs_.size());
  for (std::size_t k = pairs_.size(); k-- > 0;) {
    const Pair& p = pairs_[k];
    along[k] = p.inverse_curvature * inner_product(p.step, d, threads_);
    add_multiple(-along[k], p.change, d, threads_);
  }
  double scale = kFirstScale;
  if (!pairs_.empty()) {
    const Pair& last = pairs_.back();
    scale = 1.0 / (last.inverse_curvature * inner_product(last.change, last.change, threads_));
  }
  for (double& x : d) x *= scale;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Pair& p = pairs_[k];
    const double back = p.inverse_curvature * inner_product(p.change, d, threads_);
    add_multiple(along[k] - back, p.step, d, threads_);
  }
  return d;
}

}  // namespace packstone::relaxation
