#include "generate/advancing_layer/attempt.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "generate/advancing_layer/layer.hpp"
#include "packstone/core/random.hpp"
#include "packstone/core/shuffle.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/measures.hpp"

namespace packstone::advancing_layer {
namespace {

using Order = std::vector<std::size_t>;

// Variance of the logarithm of the widths: 0 where all are alike.
double spread(const std::vector<OrderedBody>& bodies) {
  double sum = 0.0, sum_sq = 0.0;
  for (const OrderedBody& b : bodies) {
    const double logarithm = std::log(guide_radius(b.body));
    sum += logarithm;
    sum_sq += logarithm * logarithm;
  }
  const auto count = static_cast<double>(bodies.size());
  return std::max(0.0, sum_sq / count - sum * sum / (count * count));
}

double largest_half_width(const std::vector<OrderedBody>& bodies) {
  double largest = 0.0;
  for (const OrderedBody& b : bodies) largest = std::max(largest, circum_radius(b.body));
  return largest;
}

// Places worth comparing for bodies that are not balls. In space long and flat ones, which fit in
// fewer of them, gain by more; in the plane none do.
int candidates_for_shapes(const std::vector<OrderedBody>& bodies) {
  constexpr int kLeast = 40, kMost = 160, kInPlane = 60;
  if (dimension(kind(bodies.front().body)) == 2) return kInPlane;
  double sum = 0.0;
  for (const OrderedBody& b : bodies) sum += circum_radius(b.body) / in_radius(b.body);
  const double aspect = std::min(sum / static_cast<double>(bodies.size()), 10.0);
  return std::clamp(static_cast<int>(12.0 * aspect * aspect), kLeast, kMost);
}

class Run {
 public:
  Run(const Cell& cell, const std::vector<OrderedBody>& bodies, const Plan& plan,
      std::uint64_t attempt, bool is_last, RunContext& run)
      : cell_(cell),
        bodies_(bodies),
        plan_(plan),
        is_last_(is_last),
        run_(run),
        layer_depth_(plan.top_layer * largest_half_width(bodies)),
        layer_(make_layer(cell, bodies, plan.min_gap, plan.seed, attempt)),
        heights_(plan.seed, StreamId::advancing_layer, kHeightItem, attempt) {
    placement_.centers.resize(bodies.size());
    volumes_.reserve(bodies.size());
    for (const OrderedBody& b : bodies) volumes_.push_back(volume(b.body));
    split_order(RandomStream(plan.seed, StreamId::advancing_layer, kOrderItem, attempt));
  }

  Placement run() {
    for (const std::size_t k : first_) {
      if (!go_on() || (is_full_ && !plan_.close_top)) break;
      keep(k, lay(bodies_[k].body));
    }
    placement_.top = layer_->top();
    layer_->open_floor();
    for (const std::size_t k : last_) {
      if (!go_on()) break;
      keep(k, fit_in(bodies_[k].body));
    }
    placement_.tests = layer_->tests();
    return std::move(placement_);
  }

 private:
  // A random order, or the one given, without what is held back, which comes last, in the order of
  // sizes.
  void split_order(RandomStream random) {
    Order order(bodies_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (!plan_.in_order) shuffle(order, random);
    plan_.held == Held::sample ? hold_back_sample(order) : hold_back_smallest(order);
    std::vector<bool> is_held(bodies_.size(), false);
    for (const std::size_t k : last_) is_held[k] = true;
    for (const std::size_t k : order) {
      if (is_held[k]) continue;
      first_.push_back(k);
      to_lay_ += volumes_[k];
    }
  }

  void hold_back_smallest(const Order& order) {
    const double most = plan_.held_back * total_volume();
    last_ = order;
    sort_by_size(last_);
    double held = 0.0;
    std::size_t count = 0;
    while (count < last_.size()) {
      held += volumes_[last_[last_.size() - 1 - count]];
      if (held > most) break;
      ++count;
    }
    last_.erase(last_.begin(), last_.end() - static_cast<std::ptrdiff_t>(count));
  }

  // The gap below the ceiling is about as high as what is held back would fill: without those that
  // hardly go into it.
  void hold_back_sample(const Order& order) {
    constexpr double kWidest = 0.8;
    const double wanted = kSampled * total_volume();
    const double widest = kWidest * kSampled * cell_.size[vertical_axis(cell_)];
    double held = 0.0;
    for (std::size_t m = order.size(); m > 0 && held < wanted; --m) {
      const std::size_t k = order[m - 1];
      if (2.0 * circum_radius(bodies_[k].body) > widest) continue;
      held += volumes_[k];
      last_.push_back(k);
    }
    sort_by_size(last_);
  }

  void sort_by_size(Order& order) const {
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return volumes_[a] > volumes_[b]; });
  }

  [[nodiscard]] double total_volume() const {
    return std::accumulate(volumes_.begin(), volumes_.end(), 0.0);
  }

  // In the layer on top; where that is full, anywhere.
  std::optional<Vec3> lay(const Body& body) {
    if (!is_full_) {
      if (const auto place = on_top(body)) return place;
      is_full_ = true;
      if (!plan_.close_top) return std::nullopt;
    }
    return layer_->place(body, {0.0, plan_.candidates, true});
  }

  std::optional<Vec3> on_top(const Body& body) {
    const double from = std::max(0.0, layer_->top() - layer_depth_);
    return layer_->place(body, {from, plan_.candidates, false});
  }

  // In a hole, or else on top. Disks of a sample the other way round: there are hardly any holes
  // for them but, along a period, where the floor has been.
  std::optional<Vec3> fit_in(const Body& body) {
    if (plan_.held == Held::sample && kind(body) == ShapeKind::disk &&
        !cell_.periodic[vertical_axis(cell_)]) {
      if (const auto place = on_top(body)) return place;
      return in_hole(body);
    }
    if (const auto place = in_hole(body)) return place;
    return on_top(body);
  }

  // From a random height upward, or else anywhere.
  std::optional<Vec3> in_hole(const Body& body) {
    const double from = heights_.uniform(0.0, layer_->top());
    if (const auto place = layer_->place(body, {from, plan_.hole_candidates, true})) return place;
    return layer_->place(body, {0.0, plan_.hole_candidates, true});
  }

  void keep(std::size_t k, const std::optional<Vec3>& center) {
    placement_.centers[k] = center;
    (center ? placement_.placed : placement_.missing) += volumes_[k];
    count_ += center ? 1 : 0;
    const auto wanted = static_cast<std::int64_t>(bodies_.size());
    run_.report({"laying", static_cast<double>(count_) / static_cast<double>(wanted),
                 placement_.placed / volume(cell_), count_, wanted});
  }

  bool go_on() {
    if (placement_.missing > 0.0 && !is_last_ && !is_hopeless()) return false;
    placement_.stop = run_.stop_request();
    return placement_.stop == StopRequest::none;
  }

  // Asked when the first body has found no place: what then is still to come? A few of the largest
  // may find theirs in another order.
  bool is_hopeless() {
    constexpr double kMuch = 0.02;  // volume over that of the cell
    constexpr double kFew = 5.0;
    constexpr double kMoreHeld = 0.05;  // By the next attempt.
    if (placement_.hopeless) return true;
    const double largest = *std::max_element(volumes_.begin(), volumes_.end());
    const double much = std::max(kMuch * volume(cell_), kFew * largest) +
                        (plan_.held == Held::sample ? kMoreHeld * total_volume() : 0.0);
    placement_.hopeless = to_lay_ - placement_.placed - placement_.missing > much;
    return placement_.hopeless;
  }

  const Cell& cell_;
  const std::vector<OrderedBody>& bodies_;
  const Plan& plan_;
  bool is_last_;
  RunContext& run_;
  double layer_depth_;
  std::unique_ptr<Layer> layer_;
  RandomStream heights_;
  std::vector<double> volumes_;
  Order first_, last_;
  double to_lay_ = 0.0;  // Volume of the bodies that are not held back.
  bool is_full_ = false;
  std::int64_t count_ = 0;
  Placement placement_;
};

}  // namespace

Plan plan_for(const AdvancingLayerOptions& options, const std::vector<OrderedBody>& bodies) {
  const double wide = spread(bodies);
  const bool round = std::all_of(bodies.begin(), bodies.end(),
                                 [](const OrderedBody& b) { return is_round(kind(b.body)); });
  constexpr double kGrowth = 1.7;
  // The wider sizes are spread the less comparing gains: among sizes enough one fits every place.
  const int for_balls = static_cast<int>(std::clamp(0.04 / (wide * wide * wide), 1.0, 24.0));
  const double held = std::clamp(0.27 * wide, 0.02, 0.1);
  const int candidates =
      options.candidates.value_or(round ? for_balls : candidates_for_shapes(bodies));
  return {.min_gap = options.min_gap,
          .top_layer = options.top_layer,
          .candidates = candidates,
          .hole_candidates = round ? 1 : candidates,
          .held = options.close_top && !options.held_back ? Held::sample : Held::smallest,
          .held_back = options.close_top ? options.held_back.value_or(held) : 0.0,
          .held_back_growth = options.held_back ? 1.0 : kGrowth,
          .close_top = options.close_top,
          .seed = options.seed};
}

Placement attempt(const Cell& cell, const std::vector<OrderedBody>& bodies, const Plan& plan,
                  std::uint64_t attempt, bool is_last, RunContext& run) {
  return Run(cell, bodies, plan, attempt, is_last, run).run();
}

}  // namespace packstone::advancing_layer
