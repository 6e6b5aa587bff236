#include "packstone/tessellate/power_diagram.hpp"

#include <cmath>
#include <string>

#include "packstone/core/error.hpp"
#include "tessellate/laguerre/assembly.hpp"
#include "tessellate/laguerre/site.hpp"

namespace packstone {
namespace {

void check_site(const LaguerreSite& site, std::size_t index, std::size_t owners) {
  const bool finite = std::isfinite(site.at.x) && std::isfinite(site.at.y) &&
                      std::isfinite(site.at.z) && std::isfinite(site.weight);
  if (!finite) {
    throw InvalidArgument("site " + std::to_string(index) +
                          " has a place or weight that is not a "
                          "finite number");
  }
  if (site.owner < 0 || static_cast<std::size_t>(site.owner) >= owners) {
    throw InvalidArgument("site " + std::to_string(index) + " belongs to " +
                          std::to_string(site.owner) + "; there are " + std::to_string(owners) +
                          " owners");
  }
}

}  // namespace

Tessellation power_diagram(const Cell& box, const std::vector<LaguerreSite>& sites,
                           const std::vector<TessellationCell>& owners, const RunContext& run) {
  check_cell(box);
  if (sites.empty()) throw InvalidArgument("a power diagram needs a site");
  std::vector<laguerre::Site> wrapped;
  wrapped.reserve(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    check_site(sites[i], i, owners.size());
    wrapped.push_back(laguerre::wrapped_site(box, sites[i].at, sites[i].weight, sites[i].owner));
  }
  return laguerre::assemble(box, wrapped, owners, run.threads());
}

}  // namespace packstone
