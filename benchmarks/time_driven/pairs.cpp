#include "time_driven/pairs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "packstone/generate/published_time_driven.hpp"
#include "packstone/generate/relaxation.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/io/packing_file.hpp"
#include "published_pairs.hpp"

namespace packstone::benchmarks {
namespace {

using scenes::PublishedPair;

// Wide enough that no image is met.
constexpr double kEdge = 20.0;
// Steps of which the path shows each; nearly all pairs end before.
constexpr std::int64_t kPathSteps = 300;

Packing in_cell(const PublishedPair& pair, double edge) {
  const Vec3 middle{edge / 2, edge / 2, edge / 2};
  Packing packing;
  packing.cell.size = {edge, edge, edge};
  packing.groups = {"first", "second"};
  packing.inclusions = {{middle - 0.5 * pair.r_ab, pair.a, 0},
                        {middle + 0.5 * pair.r_ab, pair.b, 1}};
  return packing;
}

Vec3 separation(const Packing& packing) {
  return packing.inclusions[1].center - packing.inclusions[0].center;
}

double gap_in(const Packing& packing) {
  return gap(packing.inclusions[0].body, packing.inclusions[1].body, separation(packing)).value;
}

// "cc1+cd2"; "none" where the method sees no overlap.
std::string types_in(const Packing& packing, bool literal) {
  std::set<std::string_view> types;
  for (const PublishedForce& force : published_forces(
           packing.inclusions[0].body, packing.inclusions[1].body, separation(packing), literal)) {
    types.insert(name(force.type));
  }
  return types.empty() ? "none" : fmt::format("{}", fmt::join(types, "+"));
}

// Angle between the axes before and after [degrees]; 0 for spheres.
double turned(const Body& before, const Body& after) {
  const auto* rod = std::get_if<Cylinder>(&before);
  if (rod == nullptr) return 0.0;
  const double sine = norm(cross(rod->axis, std::get<Cylinder>(after).axis));
  return std::asin(std::min(1.0, sine)) * 180.0 / std::numbers::pi;
}

// Prints the gap after every step; the types of contact on the way, "sc2>sc3>none".
std::string show_path(const PublishedPair& pair, std::string_view form, TimeDrivenOptions options,
                      std::int64_t steps) {
  std::string types, last;
  for (options.max_steps = 0; options.max_steps <= std::min(steps, kPathSteps);
       ++options.max_steps) {
    const Packing now = published_time_driven_relax(in_cell(pair, kEdge), options).packing;
    fmt::print("path {} {} {:.2f} {:.6g}\n", pair.figure, form,
               static_cast<double>(options.max_steps) * options.time_step, gap_in(now));
    const std::string here = types_in(now, options.literal);
    if (here != last) types += (types.empty() ? "" : ">") + here;
    last = here;
  }
  return steps > kPathSteps ? types + ">..." : types;
}

void show_end(const PublishedPair& pair, std::string_view form, const Packing& end,
              const std::string& types, std::int64_t steps, int reshuffles) {
  const Packing start = in_cell(pair, kEdge);
  const auto moved = [&](std::size_t k) {
    return norm(end.inclusions[k].center - start.inclusions[k].center);
  };
  const auto turn = [&](std::size_t k) {
    return turned(start.inclusions[k].body, end.inclusions[k].body);
  };
  fmt::print("pair {} {} {} {:.4f} {:.1e} {:.3f} {:.3f} {:.1f} {:.1f} {} {}\n", pair.figure, form,
             types, gap_in(start), gap_in(end), moved(0), moved(1), turn(0), turn(1), steps,
             reshuffles);
}

// The ways of one pair, by name.
using Forms = std::map<std::string, Packing>;

Packing show_published(const PublishedPair& pair, std::string_view form, bool literal) {
  TimeDrivenOptions options;
  options.literal = literal;
  const TimeDrivenResult result = published_time_driven_relax(in_cell(pair, kEdge), options);
  const std::string types = show_path(pair, form, options, result.steps);
  show_end(pair, form, result.packing, types, result.steps, result.reshuffles);
  return result.packing;
}

Packing show_exact(const PublishedPair& pair) {
  const RelaxationOptions free{.turn = {RelaxationTurn::free, RelaxationTurn::free}};
  const RelaxationResult result = relax(in_cell(pair, kEdge), free);
  show_end(pair, "exact", result.packing, "-", result.report.iterations, 0);
  return result.packing;
}

// The cell that holds the bodies of all forms, so that their pictures have one scale.
Vec3 size_around(const Forms& forms) {
  constexpr double margin = 0.3;
  Vec3 size{};
  for (const auto& [form, packing] : forms) {
    for (const Inclusion& inclusion : packing.inclusions) {
      const Vec3 extents = half_extents(inclusion.body);
      for (const std::size_t k : {0U, 1U, 2U}) {
        const double reach = std::abs(inclusion.center[k] - kEdge / 2) + extents[k] + margin;
        size[k] = std::max(size[k], 2.0 * reach);
      }
    }
  }
  return size;
}

void write_for_pictures(const PublishedPair& pair, Forms forms,
                        const std::filesystem::path& folder) {
  const Vec3 size = size_around(forms);
  for (auto& [form, packing] : forms) {
    for (Inclusion& inclusion : packing.inclusions) {
      inclusion.center = inclusion.center - 0.5 * (Vec3{kEdge, kEdge, kEdge} - size);
    }
    packing.cell.size = size;
    packing.certificate.reset();
    write_packing(folder / fmt::format("fig_{}_{}.json", pair.figure, form), packing);
  }
}

}  // namespace

void show_pairs(const std::filesystem::path& folder) {
  fmt::print(
      "# figure form types gap-start gap-end moved-a moved-b turned-a turned-b steps reshuffles\n");
  for (const PublishedPair& pair : scenes::published_pairs()) {
    Forms forms{{"before", in_cell(pair, kEdge)}};
    forms["literal"] = show_published(pair, "literal", true);
    forms["repaired"] = show_published(pair, "repaired", false);
    forms["exact"] = show_exact(pair);
    if (!folder.empty()) write_for_pictures(pair, std::move(forms), folder);
  }
}

}  // namespace packstone::benchmarks
