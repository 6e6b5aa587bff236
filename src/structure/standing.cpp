#include "packstone/structure/standing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "packstone/core/compensated_sum.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/core/tolerances.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/structure/images.hpp"
#include "structure/mix/sentences.hpp"

namespace packstone {
namespace {

using std::numbers::pi;

constexpr double kRounding = 1.0 + 1e-12;  // of sizes that were scaled to a volume

// Fully periodic, and far too small to meet an own image: the common case, settled at once.
bool is_plainly_small(const Cell& cell, const Body& body, double min_gap) {
  const auto end = cell.periodic.begin() + cell.dimension;
  const bool has_walls = std::find(cell.periodic.begin(), end, false) != end;
  return !has_walls && 2.0 * circum_radius(body) + min_gap < 0.999 * shortest_period(cell);
}

std::optional<std::string> why_walls_refuse(const Cell& cell, const Vec3& half_extents) {
  const CenterBox box = centers_inside_walls(cell, half_extents);
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    if (box.lo[a] <= box.hi[a]) continue;
    return "it is " + number_text(2.0 * half_extents[a], 12) + " wide along " + "xyz"[a] +
           "; allowed between the walls is less than " + number_text(cell.size[a], 12);
  }
  return std::nullopt;
}

std::string image_text(const std::array<int, 3>& image, int dimension) {
  std::string text = std::to_string(image[0]) + ", " + std::to_string(image[1]);
  if (dimension == 3) text += ", " + std::to_string(image[2]);
  return "[" + text + "]";
}

std::optional<std::string> why_images_refuse(const Cell& cell, const Body& body,
                                             const Vec3& half_extents, double min_gap) {
  if (auto reason = why_too_many_own_images(cell, half_extents)) return reason;
  std::array<int, 3> nearest{};
  double least = std::numeric_limits<double>::infinity();
  for_own_images(cell, half_extents, min_gap, [&](const std::array<int, 3>& image) {
    const Vec3 shift = image_shift(cell, image);
    if (norm_sq(shift) < least && overlap(body, body, shift, min_gap) != Verdict::separated) {
      least = norm_sq(shift);
      nearest = image;
    }
    return true;
  });
  if (!std::isfinite(least)) return std::nullopt;
  const std::string own = "its own periodic image " + image_text(nearest, cell.dimension);
  return (min_gap > 0.0 ? "it does not keep a gap of " + number_text(min_gap) + " to " + own
                        : "it touches or overlaps " + own) +
         "; make it smaller or the cell larger";
}

std::optional<std::string> why_not(const Cell& cell, const Body& body, double min_gap) {
  const Vec3 half = half_extents(body);
  if (auto reason = why_walls_refuse(cell, half)) return reason;
  return why_images_refuse(cell, body, half, min_gap);
}

// Place in which bodies grown by half the least gap are disjoint: across walls they reach half the
// gap outward.
double room(const Cell& cell, double min_gap) {
  double product = 1.0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    product *= cell.size[axis] + (cell.periodic[axis] ? 0.0 : min_gap);
  }
  return product;
}

// Rounding of the sizes apart.
bool all_congruent(const std::vector<OrderedBody>& bodies) {
  const Vec3 first = mix::lengths_of(bodies.front().body);
  return std::all_of(bodies.begin(), bodies.end(), [&](const OrderedBody& b) {
    const Vec3 lengths = mix::lengths_of(b.body);
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::abs(lengths[i] - first[i]) > 1e-12 * first[i]) return false;
    }
    return kind(b.body) == kind(bodies.front().body);
  });
}

// Highest fraction that congruent bodies can have at all, 1 where that is not known.
double densest(ShapeKind shape) {
  switch (shape) {
    case ShapeKind::sphere:
      return pi / std::sqrt(18.0);
    case ShapeKind::disk:
    case ShapeKind::ellipse:
      return pi / std::sqrt(12.0);
    default:
      return 1.0;
  }
}

// The same with the shells of half the gap: spheres and disks are then larger ones. An ellipse is
// none any more, so that its shell does not count.
Body grown(const Body& body, double growth) {
  if (const auto* sphere = std::get_if<Sphere>(&body)) return Sphere{sphere->radius + growth};
  if (const auto* disk = std::get_if<Disk>(&body)) return Disk{disk->radius + growth};
  return body;
}

int largest_group(const std::vector<OrderedBody>& bodies) {
  std::vector<double> volumes;
  for (const OrderedBody& b : bodies) {
    const auto g = static_cast<std::size_t>(b.group);
    if (g >= volumes.size()) volumes.resize(g + 1, 0.0);
    volumes[g] += volume(b.body);
  }
  return static_cast<int>(std::max_element(volumes.begin(), volumes.end()) - volumes.begin());
}

[[noreturn]] void refuse(const std::vector<OrderedBody>& bodies, const std::string& why) {
  throw InvalidGroup("", largest_group(bodies), GroupField::fraction, "", why);
}

}  // namespace

CenterBox centers_inside_walls(const Cell& cell, const Vec3& half_extents) noexcept {
  CenterBox box{{0, 0, 0}, cell.size};
  for (std::size_t a = 0; a < static_cast<std::size_t>(cell.dimension); ++a) {
    if (cell.periodic[a]) continue;
    // Rounded inward, so that center - extent >= 0 and center + extent <= size as computed.
    box.lo[a] = half_extents[a] * (1.0 + 4 * kUnitRoundoff);
    box.hi[a] = (cell.size[a] - half_extents[a]) - 4 * kUnitRoundoff * cell.size[a];
  }
  return box;
}

std::optional<std::string> why_it_cannot_stand(const Cell& cell, const Body& body, double min_gap,
                                               Turn turn) {
  if (is_plainly_small(cell, body, min_gap)) return std::nullopt;
  const double radius = in_radius(body);
  const Body ball = cell.dimension == 2 ? Body{Disk{radius}} : Body{Sphere{radius}};
  const auto reason = why_not(cell, turn == Turn::any ? ball : body, min_gap);
  if (!reason) return std::nullopt;
  return "with " + mix::lengths_text({body}) +
         (turn == Turn::any ? ", however it is turned, " : " ") + *reason;
}

void check_standing(const Cell& cell, const std::vector<OrderedBody>& bodies, double min_gap,
                    const std::vector<bool>& redrawn) {
  std::vector<std::int64_t> count;  // of the bodies of each group so far
  for (const OrderedBody& ordered : bodies) {
    const auto g = static_cast<std::size_t>(ordered.group);
    if (g >= count.size()) count.resize(g + 1, 0);
    const Turn turn = g < redrawn.size() && redrawn[g] ? Turn::any : Turn::as_given;
    if (const auto why = why_it_cannot_stand(cell, ordered.body, min_gap, turn)) {
      throw InvalidGroup(
          "", ordered.group, GroupField::size, "",
          "inclusion " + std::to_string(count[g]) + " cannot stand in the cell: " + *why);
    }
    ++count[g];
  }
}

void check_room(const Cell& cell, const std::vector<OrderedBody>& bodies, double min_gap) {
  if (bodies.empty()) return;
  const double growth = 0.5 * min_gap;
  const double ball = volume(cell.dimension == 2 ? Body{Disk{growth}} : Body{Sphere{growth}});
  CompensatedSum needed;
  for (const OrderedBody& b : bodies) {
    needed.add(volume(b.body));
    if (growth > 0.0) needed.add(growth * surface(b.body) + ball);
  }
  const std::string gaps =
      growth > 0.0 ? " with their gaps (min_gap = " + number_text(min_gap) + ")" : "";
  const double part = needed.value() / room(cell, min_gap);
  if (part > kRounding) {
    refuse(bodies, "all inclusions together" + gaps + " need " + number_text(part) +
                       " of the room in the cell; allowed is at most 1");
  }
  if (!all_congruent(bodies)) return;
  const ShapeKind shape = kind(bodies.front().body);
  const double filled = static_cast<double>(bodies.size()) *
                        volume(grown(bodies.front().body, growth)) / room(cell, min_gap);
  if (filled <= densest(shape) * kRounding) return;
  refuse(bodies, "equal inclusions of the shape " + std::string(name(shape)) + gaps +
                     " would fill " + number_text(filled) + " of the cell; allowed is at most " +
                     number_text(densest(shape)) + ", the densest packing there is");
}

}  // namespace packstone
