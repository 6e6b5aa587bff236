#include "generate/relaxation/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "packstone/core/parallel.hpp"

namespace packstone::relaxation {
namespace {

// The most that a point of a body has moved from where it was.
double moved(const Bodies& bodies, std::size_t i, const Pose& from) {
  const Pose& now = bodies.posed[i].pose;
  const double shifted = norm(now.center - from.center);
  if (bodies.turning[i].slot < 0) return shifted;
  double turned = norm(now.axis - from.axis);
  if (bodies.posed[i].form == Form::scalene) turned += norm(now.second - from.second);
  // An arc is at most pi / 2 times its chord.
  return shifted + 1.6 * turned * bodies.slope[i];
}

bool is_first_of_two(std::size_t i, std::int32_t other, const CapsuleGrid::Image& image) {
  const auto own = static_cast<std::int32_t>(i);
  return other > own || (other == own && image > CapsuleGrid::Image{0, 0, 0});
}

auto name_of(const NearPair& pair) { return std::tie(pair.body, pair.other, pair.image); }

bool by_name(const NearPair& p, const NearPair& q) { return name_of(p) < name_of(q); }

// Gives `pairs` the hints of those of the same name among `known`, and sorts these.
void keep_hints(std::vector<NearPair>& known, std::vector<NearPair>& pairs) {
  std::sort(known.begin(), known.end(), by_name);
  for (NearPair& pair : pairs) {
    const auto at = std::lower_bound(known.begin(), known.end(), pair, by_name);
    if (at != known.end() && name_of(*at) == name_of(pair)) pair.hint = at->hint;
  }
}

}  // namespace

// Two bodies push each other from as far as the lesser of their shells.
void NearPairs::set_capsule(const Bodies& bodies, std::size_t i) {
  const double around = 0.5 * (margin_[i] + bodies.min_gap + bodies.shell[i]);
  Capsule capsule = capsule_about(bodies.posed[i], around);
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell_.dimension); ++a) {
    if (!cell_.periodic[a]) continue;
    wraps_[i][a] = static_cast<int>(std::floor(capsule.center[a] / cell_.size[a]));
  }
  capsule.center -= image_shift(cell_, wraps_[i]);
  capsules_[i] = capsule;
  path_[i] = 0.0;
  last_[i] = bodies.posed[i].pose;
}

// Body i and what a query about it found.
NearPair NearPairs::pair_of(std::size_t i, std::int32_t j, const CapsuleGrid::Image& image) const {
  NearPair pair;
  const auto own = static_cast<std::int32_t>(i);
  pair.body = std::min(own, j);
  pair.other = std::max(own, j);
  const int sign = j < own ? -1 : 1;
  const Wrap& there = wraps_[static_cast<std::size_t>(j)];
  for (std::size_t a = 0; a < 3; ++a) {
    pair.image[a] = static_cast<std::int16_t>(sign * (image[a] - there[a] + wraps_[i][a]));
  }
  return pair;
}

void NearPairs::find(const Bodies& bodies, double margin, int threads) {
  const std::size_t n = bodies.count();
  margin_.assign(n, margin);
  refreshed_ = 0;
  capsules_.resize(n);
  wraps_.resize(n);
  path_.resize(n);
  last_.resize(n);
  is_far_.assign(n, false);
  for (std::size_t i = 0; i < n; ++i) set_capsule(bodies, i);
  grid_.reset(capsules_);
  for (std::size_t i = 0; i < n; ++i) grid_.insert(static_cast<std::int32_t>(i), capsules_[i]);
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  chunks_.resize(chunks);
  parallel_for(
      static_cast<std::int64_t>(chunks), threads, 1, [&](std::int64_t from, std::int64_t to) {
        CapsuleGrid::Scratch scratch;
        std::vector<NearPair> found;
        for (auto c = static_cast<std::size_t>(from); c < static_cast<std::size_t>(to); ++c) {
          found.clear();
          const std::size_t last = std::min(n, (c + 1) * kChunk);
          for (std::size_t i = c * kChunk; i < last; ++i) {
            const auto visit = [&](std::int32_t j, const CapsuleGrid::Image& image) {
              if (is_first_of_two(i, j, image)) found.push_back(pair_of(i, j, image));
              return true;
            };
            grid_.query(capsules_[i], scratch, visit, static_cast<std::int32_t>(i));
          }
          keep_hints(chunks_[c], found);
          chunks_[c] = found;
        }
      });
}

bool NearPairs::follow(const Bodies& bodies, int threads) {
  constexpr std::int64_t kMost = 2;  // One in so many, all in all.
  const std::size_t n = bodies.count();
  if (last_.size() != n) return false;
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  std::vector<std::vector<std::size_t>> far_of(chunks);
  parallel_for(
      static_cast<std::int64_t>(chunks), threads, 64, [&](std::int64_t from, std::int64_t to) {
        for (auto c = static_cast<std::size_t>(from); c < static_cast<std::size_t>(to); ++c) {
          const std::size_t last = std::min(n, (c + 1) * kChunk);
          for (std::size_t i = c * kChunk; i < last; ++i) {
            path_[i] += moved(bodies, i, last_[i]);
            last_[i] = bodies.posed[i].pose;
            if (!(path_[i] <= 0.5 * margin_[i])) far_of[c].push_back(i);
          }
        }
      });
  std::vector<std::size_t> far;
  for (const auto& some : far_of) far.insert(far.end(), some.begin(), some.end());
  if (far.empty()) return true;
  refreshed_ += std::ssize(far);
  if (refreshed_ * kMost > static_cast<std::int64_t>(n)) return false;
  refresh(bodies, far);
  return true;
}

void NearPairs::refresh(const Bodies& bodies, const std::vector<std::size_t>& far) {
  for (const std::size_t i : far) {
    is_far_[i] = true;
    grid_.remove(static_cast<std::int32_t>(i));
    margin_[i] = std::max(margin_[i], std::min(2.0 * margin_[i], bodies.reach[i]));
    set_capsule(bodies, i);
    grid_.insert(static_cast<std::int32_t>(i), capsules_[i]);
  }
  const auto with_far = [&](const NearPair& p) {
    return is_far_[static_cast<std::size_t>(p.body)] || is_far_[static_cast<std::size_t>(p.other)];
  };
  known_.clear();
  found_.clear();
  for (auto& pairs : chunks_) {
    const auto first = std::find_if(pairs.begin(), pairs.end(), with_far);
    auto kept = first;
    for (auto at = first; at != pairs.end(); ++at) {
      if (with_far(*at)) {
        known_.push_back(*at);
      } else {
        *kept++ = *at;
      }
    }
    pairs.erase(kept, pairs.end());
  }
  for (const std::size_t i : far) {
    grid_.query(capsules_[i], scratch_, [&](std::int32_t j, const CapsuleGrid::Image& image) {
      const bool once = !is_far_[static_cast<std::size_t>(j)] || is_first_of_two(i, j, image);
      if (once) found_.push_back(pair_of(i, j, image));
      return true;
    });
  }
  keep_hints(known_, found_);
  for (const NearPair& pair : found_) {
    chunks_[static_cast<std::size_t>(pair.body) / kChunk].push_back(pair);
  }
  for (const std::size_t i : far) is_far_[i] = false;
}

}  // namespace packstone::relaxation
