#include "generate/ordered_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "packstone/core/error.hpp"
#include "packstone/structure/images.hpp"

namespace packstone {

int group_count(const std::vector<OrderedBody>& bodies) {
  int count = 0;
  for (const OrderedBody& body : bodies) count = std::max(count, body.group + 1);
  return count;
}

Packing packing_at(const Cell& cell, const std::vector<OrderedBody>& bodies,
                   const std::vector<Vec3>& centers) {
  Packing packing;
  packing.cell = cell;
  packing.groups.resize(static_cast<std::size_t>(group_count(bodies)));
  packing.inclusions.reserve(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    packing.inclusions.push_back({centers[k], bodies[k].body, bodies[k].group});
  }
  return packing;
}

std::vector<OrderedBody> ordered_bodies(const Packing& packing) {
  std::vector<OrderedBody> bodies;
  bodies.reserve(packing.inclusions.size());
  for (const Inclusion& inclusion : packing.inclusions) {
    bodies.push_back({inclusion.body, inclusion.group});
  }
  return bodies;
}

void check_ordered(const Cell& cell, const OrderedBody& ordered, std::int64_t k) {
  try {
    check_body(ordered.body);
  } catch (const InvalidArgument& error) {
    throw InvalidArgument(fmt::format("body {}: {}", k, error.what()));
  }
  const ShapeKind shape = kind(ordered.body);
  if (dimension(shape) != cell.dimension) {
    throw InvalidArgument(fmt::format("body {} is a {}, which has dimension {}; the cell has {}", k,
                                      name(shape), dimension(shape), cell.dimension));
  }
  if (ordered.group < 0) {
    throw InvalidArgument(fmt::format("body {}: group is {}; it must be >= 0", k, ordered.group));
  }
}

void check_alone(const Cell& cell, const OrderedBody& ordered, std::int64_t k, double min_gap,
                 Turn turn) {
  if (const auto reason = why_it_cannot_stand(cell, ordered.body, min_gap, turn)) {
    throw InvalidArgument(fmt::format("body {} ({}, group {}) cannot stand in the cell: {}", k,
                                      name(kind(ordered.body)), ordered.group, *reason));
  }
}

void check_min_gap(const Cell& cell, double min_gap, const char* options) {
  if (const auto reason = why_no_least_gap(cell, min_gap)) {
    throw InvalidArgument(fmt::format("{}::min_gap is {}; {}", options, min_gap, *reason));
  }
}

}  // namespace packstone
