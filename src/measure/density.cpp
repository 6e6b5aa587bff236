#include "packstone/measure/density.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "measure/density/profile.hpp"
#include "measure/density/window.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/number_text.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/support.hpp"
#include "packstone/structure/images.hpp"

namespace packstone {
namespace {

using density::kUnbounded;

constexpr double kWallMargin = 2.0;     // largest half widths
constexpr double kTopMargin = 4.0;      // largest half widths
constexpr double kSlabsPerWidth = 4.0;  // in a largest half width
constexpr double kMostSlabs = 1e4;      // along the longest edge, where no width is given
constexpr double kMostOrdered = 1e6;    // where one is

std::size_t axes_of(const Cell& cell) { return static_cast<std::size_t>(cell.dimension); }

std::size_t vertical(const Cell& cell) { return axes_of(cell) - 1; }

double longest_edge(const Cell& cell) { return std::max({cell.size.x, cell.size.y, cell.size.z}); }

void check_margin(const char* field, const std::optional<double>& margin) {
  if (!margin || (*margin >= 0.0 && std::isfinite(*margin))) return;
  throw InvalidArgument("DensityOptions::" + std::string(field) + " is " + number_text(*margin) +
                        "; allowed are finite numbers >= 0");
}

void check_options(const Cell& cell, const DensityOptions& options) {
  check_margin("wall_margin", options.wall_margin);
  check_margin("top_margin", options.top_margin);
  const double least = longest_edge(cell) / kMostOrdered;
  if (!options.bin_width || (*options.bin_width >= least && std::isfinite(*options.bin_width))) {
    return;
  }
  throw InvalidArgument("DensityOptions::bin_width is " + number_text(*options.bin_width) +
                        "; allowed are finite numbers >= " + number_text(least));
}

double largest_half_width(const Packing& packing) {
  double largest = 0.0;
  for (const Inclusion& inclusion : packing.inclusions) {
    largest = std::max(largest, circum_radius(inclusion.body));
  }
  return largest;
}

std::optional<double> top_of(const Packing& packing) {
  const std::size_t up = vertical(packing.cell);
  if (packing.cell.periodic[up] || packing.inclusions.empty()) return std::nullopt;
  Vec3 upward;
  upward[up] = 1.0;
  double top = 0.0;
  for (const Inclusion& inclusion : packing.inclusions) {
    top = std::max(top, inclusion.center[up] + support(inclusion.body, upward));
  }
  return std::min(top, packing.cell.size[up]);
}

Window window_of(const Cell& cell, const DensityOptions& options, const DensityReport& report) {
  const double wall = options.wall_margin.value_or(kWallMargin * report.largest_half_width);
  const double below_top = options.top_margin.value_or(kTopMargin * report.largest_half_width);
  Window window{{}, cell.size};
  for (std::size_t a = 0; a < axes_of(cell); ++a) {
    if (cell.periodic[a]) continue;
    window.lo[a] = wall;
    window.hi[a] = cell.size[a] - wall;
  }
  if (report.top) {
    double& hi = window.hi[vertical(cell)];
    hi = std::min(hi, *report.top - below_top);
  }
  return window;
}

// Empty where there is a window.
std::string why_no_window(const Cell& cell, const Window& window, const DensityReport& report) {
  if (report.count == 0) return "nothing stands in the cell";
  for (std::size_t a = 0; a < axes_of(cell); ++a) {
    if (window.lo[a] < window.hi[a]) continue;
    return std::string("the packing is too small: along ") + "xyz"[a] +
           " a window that keeps the margins would reach from " + number_text(window.lo[a]) +
           " to " + number_text(window.hi[a]);
  }
  return "";
}

std::vector<double> edges_along(const Cell& cell, std::size_t axis, const DensityReport& report,
                                double width) {
  const double length = cell.size[axis];
  if (cell.periodic[axis]) return density::slab_edges({0.0, length}, width, kUnbounded);
  const double top = axis == vertical(cell) ? report.top.value_or(length) : length;
  std::vector<double> marks{0.0};
  if (report.interior) {
    marks.push_back(report.interior->window.lo[axis]);
    marks.push_back(report.interior->window.hi[axis]);
  }
  marks.push_back(top);
  marks.push_back(length);
  return density::slab_edges(marks, width, top);
}

double default_width(const Cell& cell, double half_width) {
  return std::max(half_width / kSlabsPerWidth, longest_edge(cell) / kMostSlabs);
}

void measure_profiles(const Packing& packing, const DensityOptions& options, RunContext& run,
                      DensityReport& report) {
  const Cell& cell = packing.cell;
  const double width = options.bin_width.value_or(
      report.count == 0 ? longest_edge(cell) : default_width(cell, report.largest_half_width));
  const auto window =
      report.interior ? std::optional(report.interior->window) : std::optional<Window>();
  for (std::size_t a = 0; a < axes_of(cell); ++a) {
    report.profiles.push_back(density::profile_along(
        packing, a, edges_along(cell, a, report, width), window, run.threads()));
    Progress progress;
    progress.stage = "measuring density";
    progress.done = static_cast<double>(a + 1) / static_cast<double>(axes_of(cell));
    run.report(progress);
  }
}

// The integral of (interior - local fraction) over the slabs between two heights that are edges.
double missing_between(const DensityProfile& profile, double interior, double from, double to) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < profile.edges.size(); ++i) {
    const double lo = profile.edges[i], hi = profile.edges[i + 1];
    const double middle = 0.5 * (lo + hi);
    if (middle > from && middle < to) sum += (interior - profile.window[i]) * (hi - lo);
  }
  return sum;
}

// The most that the integral changes on its way from the low or high end of the window into it,
// over slabs that end within `reach`.
double change_inside(const DensityProfile& profile, double interior, const Window& window,
                     double reach, bool from_low) {
  const auto axis = static_cast<std::size_t>(profile.axis);
  constexpr double kRounding = 1.0 + 1e-9;
  double sum = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < profile.window.size(); ++k) {
    const std::size_t i = from_low ? k : profile.window.size() - 1 - k;
    const double lo = profile.edges[i], hi = profile.edges[i + 1];
    const double middle = 0.5 * (lo + hi);
    if (from_low ? middle < window.lo[axis] : middle > window.hi[axis]) continue;
    if ((from_low ? hi - window.lo[axis] : window.hi[axis] - lo) > reach * kRounding) break;
    sum += (interior - profile.window[i]) * (hi - lo);
    largest = std::max(largest, std::abs(sum));
  }
  return largest;
}

void measure_deficits(const Cell& cell, const DensityProfile& profile, DensityReport& report) {
  const auto axis = static_cast<std::size_t>(profile.axis);
  if (cell.periodic[axis]) return;
  const Window& window = report.interior->window;
  const double phi = report.interior->fraction.value;
  const double reach =
      std::min(2.0 * report.largest_half_width, 0.5 * (window.hi[axis] - window.lo[axis]));
  const double low_change = change_inside(profile, phi, window, reach, true);
  const double high_change = change_inside(profile, phi, window, reach, false);
  const bool upright = axis == vertical(cell);
  const double length = cell.size[axis];
  const auto add = [&](Boundary boundary, double position, double missing, double change) {
    report.deficits.push_back({boundary, profile.axis, position, missing, change});
  };
  const auto add_high = [&](Boundary boundary, double position) {
    add(boundary, position, missing_between(profile, phi, window.hi[axis], position), high_change);
  };
  add(upright ? Boundary::floor : Boundary::wall, 0.0,
      missing_between(profile, phi, 0.0, window.lo[axis]), low_change);
  if (upright) add_high(Boundary::top, *report.top);
  add_high(upright ? Boundary::ceiling : Boundary::wall, length);
}

}  // namespace

DensityReport measure_density(const Packing& packing, const DensityOptions& options,
                              RunContext run) {
  check_well_formed(packing);
  check_images(packing);
  check_options(packing.cell, options);
  DensityReport report;
  report.count = static_cast<std::int64_t>(packing.inclusions.size());
  report.largest_half_width = largest_half_width(packing);
  report.fraction = fraction(packing);
  report.top = top_of(packing);
  if (report.top) {
    report.fraction_below_top =
        report.fraction * packing.cell.size[vertical(packing.cell)] / *report.top;
  }
  const Window window = window_of(packing.cell, options, report);
  report.why_no_interior = why_no_window(packing.cell, window, report);
  if (report.why_no_interior.empty()) {
    report.interior = {window, density::fraction_in(packing, window, run.threads())};
  }
  measure_profiles(packing, options, run, report);
  if (!report.interior) return report;
  for (const DensityProfile& profile : report.profiles) {
    measure_deficits(packing.cell, profile, report);
  }
  return report;
}

}  // namespace packstone
