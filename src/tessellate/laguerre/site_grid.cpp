#include "tessellate/laguerre/site_grid.hpp"

namespace packstone::laguerre {
namespace {

// Sites of a grid cell, in the mean.
constexpr double kSitesPerCell2 = 2.0;
constexpr double kSitesPerCell3 = 3.0;
constexpr double kMostCellsPerAxis = 1 << 14;

// Number of the class of a site: 0 for weights above the lightest one by `unit` at most, k for
// those above it by 4^(k-1) to 4^k units.
std::size_t level_of(double weight, double lightest, double unit, std::size_t levels) {
  std::size_t k = 0;
  for (double bound = unit; k + 1 < levels && weight - lightest > bound; bound *= 4.0) ++k;
  return k;
}

}  // namespace

SiteGrid::SiteGrid(const Cell& box, const std::vector<Site>& sites)
    : box_(box), dimension_(static_cast<std::size_t>(box.dimension)), periodic_(box.periodic) {
  double lightest = kFar;
  for (const Site& site : sites) lightest = std::min(lightest, site.weight);
  // Weights that differ by less than the square of the distance of sites need no grids of their
  // own.
  const double unit =
      std::pow(volume(box) / static_cast<double>(sites.size()), 2.0 / box.dimension);
  std::array<std::vector<std::int32_t>, kMostLevels> members;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const std::size_t k = level_of(sites[i].weight, lightest, unit, kMostLevels);
    members[k].push_back(static_cast<std::int32_t>(i));
  }
  for (const auto& level : members) {
    if (level.empty()) continue;
    levels_.emplace_back();
    fill(levels_.back(), sites, level);
  }
}

// The box, and beyond its walls as far as the sites are.
void SiteGrid::lay_out(Level& level, const std::vector<Site>& sites,
                       const std::vector<std::int32_t>& members) const {
  Vec3 high = box_.size;
  level.most_weight = -kFar;
  for (const std::int32_t i : members) {
    const Site& site = sites[static_cast<std::size_t>(i)];
    level.most_weight = std::max(level.most_weight, site.weight);
    for (std::size_t a = 0; a < dimension_; ++a) {
      if (periodic_[a]) continue;
      level.low[a] = std::min(level.low[a], site.at[a]);
      high[a] = std::max(high[a], site.at[a]);
    }
  }
  const double per_cell = dimension_ == 2 ? kSitesPerCell2 : kSitesPerCell3;
  double content = per_cell / static_cast<double>(members.size());
  for (std::size_t a = 0; a < dimension_; ++a) content *= high[a] - level.low[a];
  const double edge = std::pow(content, 1.0 / static_cast<double>(dimension_));
  for (std::size_t a = 0; a < dimension_; ++a) {
    const double length = high[a] - level.low[a];
    level.dims[a] = static_cast<int>(std::clamp(std::round(length / edge), 1.0, kMostCellsPerAxis));
    level.edge[a] = length / level.dims[a];
  }
}

void SiteGrid::fill(Level& level, const std::vector<Site>& sites,
                    const std::vector<std::int32_t>& members) {
  lay_out(level, sites, members);
  const std::size_t count = static_cast<std::size_t>(level.dims[0]) * level.dims[1] * level.dims[2];
  std::vector<std::size_t> home;
  home.reserve(members.size());
  level.first.assign(count + 1, 0);
  for (const std::int32_t i : members) {
    home.push_back(cell_index(level, start(level, sites[static_cast<std::size_t>(i)].at).home));
    ++level.first[home.back() + 1];
  }
  for (std::size_t c = 0; c < count; ++c) level.first[c + 1] += level.first[c];
  level.entries.resize(members.size());
  std::vector<std::int32_t> next = level.first;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Site& site = sites[static_cast<std::size_t>(members[m])];
    level.entries[static_cast<std::size_t>(next[home[m]]++)] = {site.at, site.weight, members[m]};
  }
  drop_repeated(level);
}

// Of sites that are the same only the first is found.
void SiteGrid::drop_repeated(Level& level) {
  std::int32_t kept = 0, begin = 0;
  for (std::size_t c = 0; c + 1 < level.first.size(); ++c) {
    const std::int32_t end = level.first[c + 1], first_kept = kept;
    for (std::int32_t k = begin; k < end; ++k) {
      const Entry entry = level.entries[static_cast<std::size_t>(k)];
      const auto same = [&](const Entry& e) {
        return e.at == entry.at && e.weight == entry.weight;
      };
      const auto here = level.entries.begin();
      if (std::none_of(here + first_kept, here + kept, same)) {
        level.entries[static_cast<std::size_t>(kept++)] = entry;
      }
    }
    begin = end;
    level.first[c + 1] = kept;
  }
  level.entries.resize(static_cast<std::size_t>(kept));
}

}  // namespace packstone::laguerre
