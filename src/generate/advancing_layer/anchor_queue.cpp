#include "generate/advancing_layer/anchor_queue.hpp"

#include <algorithm>
#include <limits>

namespace packstone::advancing_layer {
namespace {

constexpr double kMostBins = 4e6;

}  // namespace

AnchorQueue::AnchorQueue(double height, double bin_height, double smallest)
    : per_height_(1.0 / std::max(bin_height, height / kMostBins)), smallest_(smallest) {
  const int bins = static_cast<int>(height * per_height_) + 1;
  while (leaves_ < bins) leaves_ *= 2;
  bins_.resize(static_cast<std::size_t>(bins));
  tree_.assign(2 * static_cast<std::size_t>(leaves_), 0.0);
}

void AnchorQueue::add(std::int32_t anchor, double height) {
  const int bin = bin_of(height);
  limits_.push_back(std::numeric_limits<double>::infinity());
  bin_of_.push_back(bin);
  put(bins_[static_cast<std::size_t>(bin)], anchor);
  refresh(bin);
}

void AnchorQueue::lower_limit(std::int32_t anchor, double radius) {
  double& limit = limits_[static_cast<std::size_t>(anchor)];
  if (!(radius < limit)) return;
  limit = radius;
  const int bin = bin_of_[static_cast<std::size_t>(anchor)];
  auto& heap = bins_[static_cast<std::size_t>(bin)];
  std::make_heap(heap.begin(), heap.end(), by_limit());
  refresh(bin);
}

void AnchorQueue::renew(std::int32_t anchor) {
  limits_[static_cast<std::size_t>(anchor)] = std::numeric_limits<double>::infinity();
  const int bin = bin_of_[static_cast<std::size_t>(anchor)];
  auto& heap = bins_[static_cast<std::size_t>(bin)];
  if (std::find(heap.begin(), heap.end(), anchor) == heap.end()) heap.push_back(anchor);
  std::make_heap(heap.begin(), heap.end(), by_limit());
  refresh(bin);
}

int AnchorQueue::bin_of(double height) const {
  return std::clamp(static_cast<int>(height * per_height_), 0, static_cast<int>(bins_.size()) - 1);
}

int AnchorQueue::first_bin(int bin, double radius) const {
  if (bin >= static_cast<int>(bins_.size())) return -1;
  auto node = static_cast<std::size_t>(leaves_) + static_cast<std::size_t>(bin);
  while (!(tree_[node] > radius)) {
    // To the next subtree on the right; a node of ones alone is the last of its row.
    while (node % 2 == 1) node /= 2;
    if (node == 0) return -1;
    ++node;
  }
  while (node < static_cast<std::size_t>(leaves_)) {
    node *= 2;
    if (!(tree_[node] > radius)) ++node;
  }
  return static_cast<int>(node) - leaves_;
}

std::int32_t AnchorQueue::take_first(std::vector<std::int32_t>& heap) {
  std::pop_heap(heap.begin(), heap.end(), by_limit());
  const std::int32_t first = heap.back();
  heap.pop_back();
  return first;
}

void AnchorQueue::put(std::vector<std::int32_t>& heap, std::int32_t anchor) {
  heap.push_back(anchor);
  std::push_heap(heap.begin(), heap.end(), by_limit());
}

void AnchorQueue::refresh(int bin) {
  const auto& heap = bins_[static_cast<std::size_t>(bin)];
  auto node = static_cast<std::size_t>(leaves_) + static_cast<std::size_t>(bin);
  tree_[node] = heap.empty() ? 0.0 : limit(heap.front());
  for (node /= 2; node > 0; node /= 2) {
    const double larger = std::max(tree_[2 * node], tree_[2 * node + 1]);
    if (tree_[node] == larger) break;
    tree_[node] = larger;
  }
}

}  // namespace packstone::advancing_layer
