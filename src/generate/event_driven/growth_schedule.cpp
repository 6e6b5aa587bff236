#include "generate/event_driven/growth_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace packstone::event_driven {
namespace {

// In a thin gas, of reduced pressures up to this, bodies may grow faster than where they crowd:
// there is room to get out of the way.
constexpr double kThin = 12.0;

bool is_thin(const Progressed& at) { return at.pressure > 0.0 && at.pressure < kThin; }

// The reduced pressure, or what collisions of the bodies with walls and own images, which it does
// not count, make of the growth: a collision per body raises the logarithm of the fraction by
// about the growth rate over the reduced pressure.
double crowding(const BlockGain& gain) {
  if (!(gain.log_fraction > 0.0)) return std::numeric_limits<double>::infinity();
  return std::max(gain.pressure, gain.growth_rate * gain.collisions / gain.log_fraction);
}

}  // namespace

double GrowthSchedule::dilute_until() const {
  constexpr double kDilute = 0.1, kPart = 1.0 / 3.0;
  return std::pow(std::min(kPart, kDilute / full_), 1.0 / dimension_);
}

// Neither are clocks set alike too often, nor does the gas heat up much; fewer as long as the
// pressure, which decides on the growth rate, is not known, and while it changes fast.
double GrowthSchedule::block_collisions(const Progressed& at) const {
  constexpr double kUsual = 30.0, kFirst = 1.0, kWhileThin = 6.0;
  if (!(at.pressure > 0.0)) return kFirst;
  return is_thin(at) ? kWhileThin : kUsual;
}

double GrowthSchedule::rate(const Progressed& at, double size) const {
  // Bodies that have become that crowded find no other places any more: what is left is to close
  // the gaps, half of all the collisions there are at a constant rate.
  constexpr double kFrozen = 300.0, kFrozenFaster = 10.0;
  constexpr double kFastest = 1.0;
  const double fastest = std::max(kFastest, at.growth_rate);
  if (size < dilute_until()) return fastest;
  if (options_.goal == EventDrivenGoal::densest && at.pressure > kFrozen) {
    return std::min(options_.growth_rate, kFrozenFaster * at.growth_rate);
  }
  if (!is_thin(at)) return at.growth_rate;
  const double part = kThin / at.pressure;
  return std::min(fastest, at.growth_rate * part * part);
}

// Near jamming, at a fraction phi_J, the reduced pressure is about dimension / (1 - phi / phi_J)
// (Z. W. Salsburg, W. W. Wood, J. Chem. Phys. 37 (1962) 798): it tells what is left to grow.
// While it is high the growth rate is halved, time after time, so that the bodies can rearrange.
bool GrowthSchedule::slow_down(Progressed& at, const BlockGain& gain) const {
  constexpr double kJammed = 1e5;
  const double pressure = crowding(gain);
  at.since_slower += gain.collisions;
  if (pressure > kJammed) return true;
  if (options_.goal == EventDrivenGoal::densest) {
    // What becomes of a dense fluid depends on how slowly it is compressed.
    if (pressure > kThin) at.growth_rate = options_.slowest_growth;
    return false;
  }
  constexpr double kCrowded = 400.0, kRearranging = 50.0;
  if (pressure < kCrowded || at.since_slower < kRearranging) return false;
  if (at.growth_rate <= options_.slowest_growth) return true;
  at.growth_rate = std::max(0.5 * at.growth_rate, options_.slowest_growth);
  at.since_slower = 0.0;
  return false;
}

}  // namespace packstone::event_driven
