#include "generate/relaxation/near_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "packstone/core/parallel.hpp"
#include "spatial/capsule_grid.hpp"

namespace packstone::relaxation {
namespace {

constexpr std::int64_t kChunk = 512;

using Wrap = std::array<int, 3>;

std::vector<Wrap> wraps_of(const Bodies& bodies, const Cell& cell) {
  std::vector<Wrap> wraps(bodies.count());
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
      if (!cell.periodic[a]) continue;
      wraps[i][a] = static_cast<int>(std::floor(bodies.posed[i].pose.center[a] / cell.size[a]));
    }
  }
  return wraps;
}

// Two bodies push each other from as far as the lesser of their shells.
std::vector<Capsule> capsules_of(const Bodies& bodies, const Cell& cell,
                                 const std::vector<Wrap>& wraps, double margin) {
  std::vector<Capsule> capsules;
  capsules.reserve(bodies.count());
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const double around = 0.5 * (margin + bodies.min_gap + bodies.shell[i]);
    capsules.push_back(capsule_about(bodies.posed[i], around));
    capsules.back().center -= image_shift(cell, wraps[i]);
  }
  return capsules;
}

bool is_first_of_two(std::size_t i, std::int32_t other, const CapsuleGrid::Image& image) {
  const auto own = static_cast<std::int32_t>(i);
  return other > own || (other == own && image > CapsuleGrid::Image{0, 0, 0});
}

}  // namespace

void NearPairs::find(const Bodies& bodies, double margin, int threads) {
  margin_ = margin;
  const std::vector<Wrap> wraps = wraps_of(bodies, cell_);
  const std::vector<Capsule> capsules = capsules_of(bodies, cell_, wraps, margin);
  CapsuleGrid grid(cell_);
  grid.reset(capsules);
  const std::size_t n = bodies.count();
  for (std::size_t i = 0; i < n; ++i) grid.insert(static_cast<std::int32_t>(i), capsules[i]);

  const auto hint_of = [&](std::size_t i, const NearPair& pair) -> std::array<float, 3> {
    if (first_.size() != n + 1) return {};
    const auto known = std::find_if(begin(i), end(i), [&](const NearPair& p) {
      return p.other == pair.other && p.image == pair.image;
    });
    return known == end(i) ? std::array<float, 3>{} : known->hint;
  };
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  std::vector<std::vector<NearPair>> found(chunks);
  std::vector<std::size_t> counts(n + 1, 0);
  parallel_for(
      static_cast<std::int64_t>(chunks), threads, 1, [&](std::int64_t from, std::int64_t to) {
        CapsuleGrid::Scratch scratch;
        for (auto c = static_cast<std::size_t>(from); c < static_cast<std::size_t>(to); ++c) {
          const std::size_t last = std::min(n, (c + 1) * kChunk);
          for (std::size_t i = c * kChunk; i < last; ++i) {
            const std::size_t before = found[c].size();
            grid.query(
                capsules[i], scratch,
                [&](std::int32_t j, const CapsuleGrid::Image& image) {
                  if (!is_first_of_two(i, j, image)) return true;
                  NearPair pair;
                  pair.other = j;
                  const Wrap& there = wraps[static_cast<std::size_t>(j)];
                  for (std::size_t a = 0; a < 3; ++a) {
                    pair.image[a] = static_cast<std::int16_t>(image[a] - there[a] + wraps[i][a]);
                  }
                  pair.hint = hint_of(i, pair);
                  found[c].push_back(pair);
                  return true;
                },
                static_cast<std::int32_t>(i));
            counts[i + 1] = found[c].size() - before;
          }
        }
      });
  for (std::size_t i = 0; i < n; ++i) counts[i + 1] += counts[i];
  first_ = std::move(counts);
  pairs_.clear();
  pairs_.reserve(first_.back());
  for (const auto& chunk : found) pairs_.insert(pairs_.end(), chunk.begin(), chunk.end());
  then_.resize(n);
  for (std::size_t i = 0; i < n; ++i) then_[i] = bodies.posed[i].pose;
}

bool NearPairs::hold(const Bodies& bodies) const {
  if (then_.size() != bodies.count()) return false;
  const double most = 0.5 * margin_;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Pose& now = bodies.posed[i].pose;
    double moved = norm(now.center - then_[i].center);
    if (bodies.turning[i].slot >= 0) {
      double turned = norm(now.axis - then_[i].axis);
      if (bodies.posed[i].form == Form::scalene) turned += norm(now.second - then_[i].second);
      // An arc is at most pi / 2 times its chord.
      moved += 1.6 * turned * bodies.slope[i];
    }
    if (!(moved <= most)) return false;
  }
  return true;
}

}  // namespace packstone::relaxation
