#include "packstone/generate/published_advancing_layer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "generate/constructive/placing.hpp"
#include "generate/option_checks.hpp"
#include "generate/ordered_bodies.hpp"
#include "generate/published_advancing_layer/layer.hpp"
#include "packstone/core/error.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/inscribed_balls.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"
#include "packstone/spatial/separation.hpp"
#include "packstone/structure/standing.hpp"

namespace packstone {
namespace {

using published_layer::Layer;
using published_layer::MultiCircle;

void check_request(const Cell& cell, const PublishedLayerOptions& o) {
  constexpr const char* options = "PublishedLayerOptions";
  check_cell(cell);
  if (cell.dimension != 2) throw InvalidArgument("Cell::dimension is 3; it must be 2");
  constructive::check_floor(cell, "published_advancing_layer");
  check_option(options, "spacing", o.spacing,
               o.spacing >= kLeastBallSpacing && o.spacing <= kMostBallSpacing, "[0.01, 1]");
  check_option(options, "top_layer", o.top_layer, o.top_layer > 0.0, "a number > 0, or infinity");
  check_option(options, "largest_semi_axis", o.largest_semi_axis,
               o.largest_semi_axis >= 0.0 && std::isfinite(o.largest_semi_axis), "a number >= 0");
}

class Placing {
 public:
  Placing(const Cell& cell, const PublishedLayerOptions& options, double largest)
      : spacing_(options.spacing), layer_(cell, options), largest_(largest) {
    fixed_largest_ = options.largest_semi_axis > 0.0;
    if (fixed_largest_) largest_ = options.largest_semi_axis;
  }

  std::optional<Vec3> place(const Body& body) {
    if (!fixed_largest_) largest_ = std::max(largest_, circum_radius(body));
    const auto center = layer_.place(MultiCircle(body, spacing_), largest_);
    if (!center) return std::nullopt;
    return lift(*center);
  }

  [[nodiscard]] Layer& layer() { return layer_; }

 private:
  double spacing_;
  Layer layer_;
  double largest_;
  bool fixed_largest_;
};

PublishedLayerResult run_order(const constructive::Order& order,
                               const PublishedLayerOptions& options, double largest,
                               RunContext& run) {
  PublishedLayerResult result;
  Placing placing(order.cell, options, largest);
  constructive::place_in_order(
      order, run, result,
      [&](const OrderedBody& ordered, std::int64_t k) {
        check_ordered(order.cell, ordered, k);
        if (k == 0) check_alone(order.cell, ordered, k, 0.0, Turn::as_given);
      },
      [&](const Body& body, std::int64_t, std::int64_t expected) {
        placing.layer().expect(expected);
        return placing.place(body);
      });
  result.tested = placing.layer().tried().positions;
  result.pairs_tried = placing.layer().tried().pairs;
  result.first_row = placing.layer().first_row();
  result.overlaps = true_overlaps(result.packing);
  return result;
}

// Of the pairs of `i` with a later body, in any image, or with an own image.
void add_overlaps_of(const Packing& packing, const HierarchicalGrid& grid, std::int64_t i,
                     TrueOverlaps& overlaps, double& sum) {
  const Inclusion& a = packing.inclusions[i];
  grid.query(a.center, half_extents(a.body), 0.0, [&](std::int32_t j, const auto& image) {
    const std::array<int, 3> none{};
    if (j < i || (j == i && !(image > none))) return true;
    const Inclusion& b = packing.inclusions[j];
    const Separation apart = separation(packing.cell, a.center, b.center, image);
    const Gap gap_ab = gap(a.body, b.body, apart.r_ab);
    if (gap_ab.value > gap_ab.error + apart.error) return true;
    const double depth =
        std::max(0.0, -gap_ab.value) / std::min(in_radius(a.body), in_radius(b.body));
    ++overlaps.pairs;
    overlaps.deepest = std::max(overlaps.deepest, depth);
    sum += depth;
    return true;
  });
}

}  // namespace

TrueOverlaps true_overlaps(const Packing& packing) {
  HierarchicalGrid grid(packing.cell);
  grid.reserve(static_cast<std::int64_t>(packing.inclusions.size()));
  for (std::size_t k = 0; k < packing.inclusions.size(); ++k) {
    const Inclusion& inclusion = packing.inclusions[k];
    check_ordered(packing.cell, {inclusion.body, inclusion.group}, static_cast<std::int64_t>(k));
    grid.insert(static_cast<std::int32_t>(k), inclusion.center, half_extents(inclusion.body));
  }
  TrueOverlaps overlaps;
  double sum = 0.0;
  for (std::size_t i = 0; i < packing.inclusions.size(); ++i) {
    add_overlaps_of(packing, grid, static_cast<std::int64_t>(i), overlaps, sum);
  }
  if (overlaps.pairs > 0) overlaps.mean = sum / static_cast<double>(overlaps.pairs);
  return overlaps;
}

PublishedLayerResult published_advancing_layer_pack(const Cell& cell,
                                                    const std::vector<OrderedBody>& bodies,
                                                    const PublishedLayerOptions& options,
                                                    RunContext run) {
  check_request(cell, options);
  double largest = 0.0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const auto number = static_cast<std::int64_t>(k);
    check_ordered(cell, bodies[k], number);
    check_alone(cell, bodies[k], number, 0.0, Turn::as_given);
    largest = std::max(largest, circum_radius(bodies[k].body));
  }
  if (bodies.empty()) {
    PublishedLayerResult result;
    result.packing.cell = cell;
    return result;
  }
  return run_order(constructive::order_of(cell, bodies, 0.0, "building layers"), options, largest,
                   run);
}

PublishedLayerResult published_advancing_layer_fill(const Cell& cell, const BodySource& source,
                                                    const PublishedLayerOptions& options,
                                                    RunContext run) {
  check_request(cell, options);
  return run_order({cell, source, 0, 0.0, "building layers"}, options, 0.0, run);
}

}  // namespace packstone
