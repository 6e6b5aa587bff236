#include "timeline.hpp"

#include <fmt/format.h>

#include <iterator>

namespace packstone::cli {

std::string timeline_csv(const std::vector<EventDrivenSample>& history) {
  std::string text =
      "time [L/v],collisions [-],size_factor [-],fraction [-],growth_rate [-],reduced_pressure [-],"
      "collision_rate [v/L],kinetic_energy [-],nematic_order [-]\n";
  for (const EventDrivenSample& s : history) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{}\n", s.time, s.collisions,
                   s.size_factor, s.fraction, s.growth_rate, s.reduced_pressure, s.collision_rate,
                   s.kinetic_energy, s.nematic_order);
  }
  return text;
}

std::string timeline_csv(const std::vector<RelaxationSample>& history) {
  std::string text = "iteration [-],energy [L^2],deepest [L],contacts [-]\n";
  for (const RelaxationSample& s : history) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", s.iteration, s.energy, s.deepest,
                   s.contacts);
  }
  return text;
}

std::string timeline_csv(const std::vector<TimeDrivenSample>& history) {
  std::string text =
      "time [T],potential_energy [L^2],kinetic_energy [L^2/T^2],force_factor [1/T^2],"
      "friction [1/T],overlap_volume [L^3],overlap_volume_error [L^3]\n";
  for (const TimeDrivenSample& s : history) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},", s.time, s.potential_energy,
                   s.kinetic_energy, s.force_factor, s.friction);
    if (s.overlap_measured) {
      fmt::format_to(std::back_inserter(text), "{},{}\n", s.overlap_volume.value,
                     s.overlap_volume.error);
    } else {
      text += ",\n";
    }
  }
  return text;
}

}  // namespace packstone::cli
