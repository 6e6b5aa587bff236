#include "generate/rsa/plain_trials.hpp"

namespace packstone::rsa {
namespace {

// The same rod about another axis: all else of its outline stays.
template <class Rod>
Candidate turned_rod(const Candidate& candidate, Rod rod, const Vec3& axis) {
  rod.axis = axis;
  Candidate turned;
  turned.body = rod;
  turned.outline = candidate.outline;
  turned.outline.axis = axis;
  return turned;
}

}  // namespace

BodyOnTrial::BodyOnTrial(const PlacedBodies& placed, const Body& body, Turning how_turned)
    : candidate(body, placed.needs_extents()), turning(how_turned) {
  const double r = candidate.outline.in_radius;
  domain = centers_inside_walls(placed.cell(),
                                turning == Turning::none ? candidate.half_extents : Vec3{r, r, r});
  if (placed.cell().dimension == 2) domain.lo.z = domain.hi.z = 0.0;
}

Candidate BodyOnTrial::draw_turned(const PlacedBodies& placed, TrialNumbers::Row& numbers) const {
  if (turning == Turning::none) return candidate;
  if (!placed.needs_extents() && turning == Turning::of_axis) {
    if (const auto* cylinder = std::get_if<Cylinder>(&candidate.body)) {
      return turned_rod(candidate, *cylinder, axis_at_random(numbers));
    }
  }
  return Candidate(turned_at_random(candidate.body, turning, numbers), placed.needs_extents());
}

bool BodyOnTrial::fits(const PlacedBodies& placed, const Vec3& center, TrialNumbers::Row& numbers,
                       std::int64_t& cost, std::int32_t since) const {
  cost += Cost::trial;
  PlacedBodies::View view;
  return placed.look_around(candidate.outline, center, view, cost) &&
         fits_closely(placed, center, view, numbers, cost, since);
}

bool BodyOnTrial::fits_closely(const PlacedBodies& placed, const Vec3& center,
                               const PlacedBodies::View& view, TrialNumbers::Row& numbers,
                               std::int64_t& cost, std::int32_t since) const {
  if (turning == Turning::none) {
    return placed.leaves_room_for(candidate, center, view, cost, since);
  }
  const Candidate turned = draw_turned(placed, numbers);
  cost += Cost::trial;
  const Cell& cell = placed.cell();
  return placed.leaves_room_for(turned, center, view, cost, since) &&
         is_inside(centers_inside_walls(cell, turned.half_extents), center, cell.dimension) &&
         clears_own_images(cell, turned, placed.min_gap());
}

}  // namespace packstone::rsa
