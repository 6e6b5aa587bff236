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

void CurvatureMemory::clear() {
  for (Pair& pair : pairs_) unused_.push_back(std::move(pair));
  pairs_.clear();
}

CurvatureMemory::Pair CurvatureMemory::unused_pair() {
  if (pairs_.size() == kMostPairs) {
    unused_.push_back(std::move(pairs_.front()));
    pairs_.pop_front();
  }
  if (unused_.empty()) return {};
  Pair pair = std::move(unused_.back());
  unused_.pop_back();
  return pair;
}

void CurvatureMemory::add(double length, const Motion& direction, const Motion& before,
                          const Motion& after) {
  constexpr double kLeastCurvature = 1e-8;
  Pair pair = unused_pair();
  pair.step.resize(direction.size());
  pair.change.resize(direction.size());
  for_chunks(direction.size(), threads_, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      pair.step[k] = length * direction[k];
      pair.change[k] = after[k] - before[k];
    }
  });
  const double curvature = inner_product(pair.step, pair.change, threads_);
  const double length_sq = inner_product(pair.step, pair.step, threads_);
  pair.inverse_curvature = 1.0 / curvature;
  if (curvature > kLeastCurvature * length_sq) {
    pairs_.push_back(std::move(pair));
  } else {
    unused_.push_back(std::move(pair));
  }
}

void CurvatureMemory::find_direction(const Motion& gradient, Motion& d) const {
  d.resize(gradient.size());
  for_chunks(d.size(), threads_, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) d[k] = -gradient[k];
  });
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
}

}  // namespace packstone::relaxation
