#include "tessellate/laguerre/transport.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tessellate/laguerre/laplacian.hpp"
#include "tessellate/laguerre/site_grid.hpp"

namespace packstone::laguerre {
namespace {

// Steps are not made shorter than this part of Newton's.
constexpr double kShortestStep = 0x1p-20;

// Rounds in which owners without a cell, or next to none, are given weight before Newton's method
// can begin; what counts as next to none, and the part of the target that they get room for.
constexpr int kMostLifts = 20;
constexpr double kNextToNone = 1e-3;
constexpr double kFirstRoom = 0.05;

struct Misfit {
  double norm = 0.0;   // Of V - target.
  double worst = 0.0;  // Largest |V / target - 1|.
  double least = 0.0;  // Least V / target.
};

Misfit misfit(const CellSums& sums, const std::vector<double>& targets) {
  Misfit m;
  m.least = targets.empty() ? 1.0 : sums.cells[0].measure / targets[0];
  double square = 0.0;
  for (std::size_t g = 0; g < targets.size(); ++g) {
    const double off = sums.cells[g].measure - targets[g];
    square += off * off;
    m.worst = std::max(m.worst, std::abs(off) / targets[g]);
    m.least = std::min(m.least, sums.cells[g].measure / targets[g]);
  }
  m.norm = std::sqrt(square);
  return m;
}

// The way down from one diagram to the next.
class Descent {
 public:
  Descent(const Cell& box, std::vector<Site>& sites, const std::vector<Vec3>& centers,
          const std::vector<double>& targets, const RunContext& run)
      : box_(box), sites_(sites), centers_(centers), targets_(targets), run_(run) {
    evaluate();
  }

  TransportOutcome run(const TransportGoal& goal) {
    lift();
    // No cell may come nearer to nothing than half of what the smallest has now.
    const double floor = 0.5 * std::min(1.0, now_.least);
    while (now_.worst > goal.tolerance && out_.steps < goal.max_steps && floor > 0.0) {
      if (run_.stop_request() != StopRequest::none || !step(floor)) break;
      ++out_.steps;
    }
    out_.reached = now_.worst <= goal.tolerance;
    out_.error = now_.worst;
    return std::move(out_);
  }

 private:
  void evaluate() {
    out_.sums = cell_sums(box_, sites_, centers_, run_.threads());
    now_ = misfit(out_.sums, targets_);
    ++out_.evaluations;
  }

  void add_to_weights(const std::vector<double>& d, double factor) {
    for (Site& site : sites_) site.weight += factor * d[static_cast<std::size_t>(site.owner)];
  }

  // Owners without a cell are no part of (1). Each gets the weight with which one of its sites just
  // wins the place where it stands, and a little more.
  void lift() {
    for (int round = 0; round < kMostLifts && now_.least < kNextToNone; ++round) {
      const SiteGrid grid(box_, sites_);
      std::vector<double> d(targets_.size(), SiteGrid::kFar);
      for (const Site& site : sites_) {
        const auto g = static_cast<std::size_t>(site.owner);
        if (out_.sums.cells[g].measure >= kNextToNone * targets_[g]) continue;
        const double room = kFirstRoom * std::pow(targets_[g], 2.0 / box_.dimension);
        d[g] = std::min(d[g], lacking_weight(grid, site, room));
      }
      for (double& lacking : d) lacking = lacking == SiteGrid::kFar ? 0.0 : std::max(0.0, lacking);
      add_to_weights(d, 1.0);
      evaluate();
    }
  }

  // What a site lacks to win its own place by `room`; by less where a rival is so near that it
  // would lose its own.
  [[nodiscard]] double lacking_weight(const SiteGrid& grid, const Site& site, double room) const {
    double most = -SiteGrid::kFar, rival_distance_sq = 0.0;
    grid.nearest_first(
        site.at,
        [&](double weight) {
          return most == -SiteGrid::kFar ? SiteGrid::kFar : std::sqrt(std::max(0.0, weight - most));
        },
        [&](const SiteGrid::Entry& entry, const Image&, const Vec3& shift) {
          if (sites_[static_cast<std::size_t>(entry.site)].owner == site.owner) return;
          const double distance_sq = norm_sq(entry.at + shift - site.at);
          if (entry.weight - distance_sq <= most) return;
          most = entry.weight - distance_sq;
          rival_distance_sq = distance_sq;
        },
        [] {});
    return most + std::min(room, rival_distance_sq) - site.weight;
  }

  bool step(double floor) {
    std::vector<double> right(targets_.size());
    for (std::size_t g = 0; g < right.size(); ++g) {
      right[g] = targets_[g] - out_.sums.cells[g].measure;
    }
    const std::vector<double> d = solve_laplacian(out_.sums.couplings, right, box_.dimension);
    if (d.empty()) return false;
    const std::vector<Site> before = sites_;
    const Misfit from = now_;
    for (double length = 1.0; length >= kShortestStep; length *= 0.5) {
      add_to_weights(d, length);
      evaluate();
      if (now_.least >= floor && now_.norm <= (1.0 - 0.5 * length) * from.norm) return true;
      sites_ = before;
      if (run_.stop_request() != StopRequest::none) break;
    }
    evaluate();
    return false;
  }

  const Cell& box_;
  std::vector<Site>& sites_;
  const std::vector<Vec3>& centers_;
  const std::vector<double>& targets_;
  const RunContext& run_;
  TransportOutcome out_;
  Misfit now_;
};

}  // namespace

TransportOutcome transport(const Cell& box, std::vector<Site>& sites,
                           const std::vector<Vec3>& centers, const std::vector<double>& targets,
                           const TransportGoal& goal, const RunContext& run) {
  return Descent(box, sites, centers, targets, run).run(goal);
}

}  // namespace packstone::laguerre
