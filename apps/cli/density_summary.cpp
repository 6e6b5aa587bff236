#include "density_summary.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <optional>

namespace packstone::cli {
namespace {

using Json = nlohmann::ordered_json;

const char* word(Boundary boundary) {
  switch (boundary) {
    case Boundary::wall:
      return "wall";
    case Boundary::floor:
      return "floor";
    case Boundary::ceiling:
      return "ceiling";
    case Boundary::top:
      break;
  }
  return "top";
}

std::string axis_name(int axis) { return std::string(1, "xyz"[axis]); }

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

// Coordinates of the axes that the profiles are along: two in the plane.
Json point_json(const Vec3& point, const DensityReport& report) {
  Json numbers = Json::array();
  for (std::size_t a = 0; a < report.profiles.size(); ++a) numbers.push_back(point[a]);
  return numbers;
}

Json interior_json(const DensityReport& report) {
  if (!report.interior) return nullptr;
  const InteriorDensity& interior = *report.interior;
  return {{"fraction", interior.fraction.value},
          {"error", interior.fraction.error},
          {"window",
           {{"lo", point_json(interior.window.lo, report)},
            {"hi", point_json(interior.window.hi, report)}}}};
}

Json deficits_json(const DensityReport& report) {
  Json deficits = Json::array();
  for (const BoundaryDeficit& deficit : report.deficits) {
    deficits.push_back({{"boundary", word(deficit.boundary)},
                        {"axis", axis_name(deficit.axis)},
                        {"position", deficit.position},
                        {"length", deficit.length},
                        {"spread", deficit.spread}});
  }
  return deficits;
}

Json profiles_json(const DensityReport& report) {
  Json profiles = Json::array();
  for (const DensityProfile& profile : report.profiles) {
    profiles.push_back({{"axis", axis_name(profile.axis)},
                        {"edges", profile.edges},
                        {"whole", profile.whole},
                        {"window", report.interior ? Json(profile.window) : Json(nullptr)}});
  }
  return profiles;
}

std::string window_text(const Window& window, int dimension) {
  std::string text;
  for (int axis = 0; axis < dimension; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    text += fmt::format("{}{} {:.6g} to {:.6g}", axis > 0 ? ", " : "", axis_name(axis),
                        window.lo[a], window.hi[a]);
  }
  return text;
}

std::string interior_text(const DensityReport& report, int dimension) {
  if (!report.interior) return "  no interior: " + report.why_no_interior + "\n";
  const InteriorDensity& interior = *report.interior;
  return fmt::format("  {:<18}{:.6f}  +- {:.1g}, window {}\n", "interior", interior.fraction.value,
                     interior.fraction.error, window_text(interior.window, dimension));
}

std::string deficit_text(const BoundaryDeficit& deficit) {
  const std::string place = fmt::format("{} {} = {:.6g}", word(deficit.boundary),
                                        axis_name(deficit.axis), deficit.position);
  return fmt::format("    {:<20}{:>12.4g}{:>12.2g}\n", place, deficit.length, deficit.spread);
}

}  // namespace

Json density_json(const DensityReport& report) {
  const std::string& why_not = report.why_no_interior;
  return {{"count", report.count},
          {"largest_half_width", report.largest_half_width},
          {"fraction", report.fraction},
          {"top", number_or_null(report.top)},
          {"fraction_below_top", number_or_null(report.fraction_below_top)},
          {"interior", interior_json(report)},
          {"why_no_interior", report.interior ? Json(nullptr) : Json(why_not)},
          {"deficits", deficits_json(report)},
          {"profiles", profiles_json(report)}};
}

std::string density_line(const DensityReport& report) {
  if (!report.interior) return "";
  std::string text = fmt::format("interior {:.4f}", report.interior->fraction.value);
  for (const BoundaryDeficit& deficit : report.deficits) {
    text += fmt::format(", {} {} = {:.4g} costs {:.3g}", word(deficit.boundary),
                        axis_name(deficit.axis), deficit.position, deficit.length);
  }
  return text;
}

std::string density_text(const DensityReport& report, int dimension) {
  std::string text = fmt::format("density of {} inclusions, largest half width {:.6g}\n",
                                 report.count, report.largest_half_width);
  text += fmt::format("  {:<18}{:.6f}\n", "whole cell", report.fraction);
  if (report.top) {
    text += fmt::format("  {:<18}{:.6f}  top {} = {:.6g}\n", "below the top",
                        *report.fraction_below_top, axis_name(dimension - 1), *report.top);
  }
  text += interior_text(report, dimension);
  if (report.deficits.empty()) return text;
  text += fmt::format("  {:<22}{:>12}{:>12}\n", "deficits", "length", "spread");
  for (const BoundaryDeficit& deficit : report.deficits) text += deficit_text(deficit);
  return text;
}

}  // namespace packstone::cli
