#pragma once

/// @file
/// A search for contact, held against the slow judge.

#include <catch2/catch.hpp>

#include "movers.hpp"

namespace packstone::movers {

using event_driven::ContactSearch;
using event_driven::Finding;
using event_driven::Found;

/// What many searches have come to.
struct Tally {
  int searches = 0;
  int contacts = 0;
  int looks_again = 0;
  std::int64_t steps = 0;
};

/// Calls once(from, horizon) again from wherever it wants to look again, until it knows.
template <class Once>
Found search_to_the_end(double from, double horizon, Tally& tally, const Once& once) {
  constexpr int kMostLooks = 200;
  Found found;
  for (int look = 0; look < kMostLooks; ++look) {
    found = once(from, horizon);
    if (found.finding != Finding::look_again) return found;
    ++tally.looks_again;
    if (found.time >= horizon) return {};
    if (found.time < from) FAIL("a search ends before it begins");
    from = found.time;
  }
  return found;
}

/// Checks that they are apart up to the contact found or the horizon, and that a contact is one:
/// within the gap that counts as contact, and closing. The search goes by the gap along the plane
/// that it has found, which next to edges falls short of the true gap by up to a thousandth.
inline void check_found(const Scene& scene, std::size_t k, const Partner& partner, double from,
                        double horizon, const Found& found, const ContactSearch& search) {
  const bool hit = found.finding == Finding::contact;
  const double until = hit ? found.time : horizon;
  REQUIRE(until >= from);
  REQUIRE(found.finding != Finding::look_again);
  const double reach = circum_radius(scene.movers[k].body);
  const auto i = static_cast<std::int32_t>(k);
  const double contact_gap = search.contact_gap(i, partner, until);
  const Watch seen = watch(scene, k, partner, from, until, std::max(1e-9 * reach, contact_gap));
  CAPTURE(until, seen.least, seen.least_at, contact_gap);
  REQUIRE(seen.least >= 0.0);
  if (!hit) return;
  const Clearance there = clearance(scene, k, partner, until);
  CAPTURE(there.value, there.error);
  REQUIRE(there.value - there.error <= 1.001 * contact_gap);
  const event_driven::Contact contact = search.contact(i, partner, until, {});
  REQUIRE(contact.approach > 0.0);
  REQUIRE(std::abs(norm(contact.normal) - 1.0) < 1e-14);
}

/// Two of revolution, whatever their shapes are called?
inline bool are_two_of_revolution(const Bodies& bodies, std::size_t k, const Partner& partner) {
  return !event_driven::is_wall(partner.body) && bodies.min_gap == 0.0 &&
         bodies.form[k] <= Form::spheroid &&
         bodies.form[static_cast<std::size_t>(partner.body)] <= Form::spheroid;
}

/// Searches for the contact of body 0 with `partner` in all ways there are, and checks each.
inline void check_search(const Scene& scene, const Partner& partner, Tally& tally) {
  const Bodies bodies = bodies_of(scene);
  ContactSearch search(bodies, scene.cell);
  const double horizon = longest_look(scene);
  Vec3 normal;
  const Found found = search_to_the_end(0.0, horizon, tally, [&](double from, double until) {
    return search.first_contact(0, partner, from, until, normal);
  });
  check_found(scene, 0, partner, 0.0, horizon, found, search);
  ++tally.searches;
  tally.contacts += found.finding == Finding::contact;
  tally.steps += search.count().steps;
  if (!are_two_of_revolution(bodies, 0, partner)) return;
  const Found same = search_to_the_end(0.0, horizon, tally, [&](double from, double until) {
    return search.first_contact_of_revolution(0, partner, from, until, {});
  });
  check_found(scene, 0, partner, 0.0, horizon, same, search);
}

}  // namespace packstone::movers
