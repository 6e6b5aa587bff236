#include "tessellate/laguerre/shape_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace packstone::laguerre {
namespace {

using std::numbers::sqrt2;

constexpr std::size_t kRows = 3;

// Polynomials up to the fourth degree for weights and up to the third for displacements: rows of
// sites may swell at places, and bend. More of them do not bring the shapes nearer.
constexpr std::size_t kWeights = 5;
constexpr std::size_t kMoves = 4;
constexpr std::size_t kModes = kWeights + 2 * kMoves;

using Rows = std::array<double, kRows>;
using Modes = std::array<double, kModes>;
using Polynomials = std::array<double, kWeights>;

// Polynomials are held from here on: they grow fast.
constexpr double kFarthest = 1.5;

// Longest move of a site, over the shorter semi-axis. Beyond, the edges are others than those that
// the derivatives are of.
constexpr double kMostMove = 0.3;

// Conjugate gradients; what they leave is smaller than what a step leaves.
constexpr double kResidual = 1e-3;
constexpr int kMostIterations = 60;

// What is given of a grain.
struct Frame {
  Vec3 centroid;  // Relative to the point that moments are about.
  Vec3 along, across;
  double long_axis = 1.0, short_axis = 1.0;
  double per_trace = 0.0;  // 1 / trace(N); 0: no cell, no shape.
  double per_target = 0.0;
  Rows residual{};
};

Frame frame_of(const CellShape& ordered, double target, const CellMoments& cell) {
  Frame f{{},
          ordered.axes.col_x,
          ordered.axes.col_y,
          ordered.semi_axes.x,
          ordered.semi_axes.y,
          0.0,
          1.0 / target,
          {}};
  f.residual[2] = cell.measure / target - 1.0;
  if (cell.measure <= 0.0) return f;
  f.centroid = cell.first / cell.measure;
  const SymMat3 m = cell.second - cell.measure * dyad(f.centroid);
  const double xx = dot(f.along, m * f.along) / (f.long_axis * f.long_axis);
  const double yy = dot(f.across, m * f.across) / (f.short_axis * f.short_axis);
  const double xy = dot(f.along, m * f.across) / (f.long_axis * f.short_axis);
  if (!(xx + yy > 0.0)) return f;
  f.per_trace = 1.0 / (xx + yy);
  f.residual[0] = sqrt2 * (xx - yy) * f.per_trace;
  f.residual[1] = sqrt2 * 2.0 * xy * f.per_trace;
  return f;
}

// f_k of (3) at x from the centroid, and that of the measure.
Rows integrands(const Frame& f, const Vec3& x) {
  const double u = dot(x, f.along) / f.long_axis, v = dot(x, f.across) / f.short_axis;
  const double square = u * u + v * v;
  return {f.per_trace * (sqrt2 * (u * u - v * v) - f.residual[0] * square),
          f.per_trace * (sqrt2 * 2.0 * u * v - f.residual[1] * square), f.per_target};
}

Polynomials polynomials(const Frame& f, const Vec3& x) {
  const double t = std::clamp(dot(x, f.along) / f.long_axis, -kFarthest, kFarthest);
  const double s = t * t;
  return {1.0, t, 0.5 * (3.0 * s - 1.0), 0.5 * t * (5.0 * s - 3.0),
          0.125 * ((35.0 * s - 30.0) * s + 3.0)};
}

// Equation (2) for all modes of a site with these polynomials, x from it; the unit of weights is
// twice the square of that of lengths, so that a ball of that radius grows by as much as it moves.
Modes velocities(const Frame& f, const Polynomials& p, const Vec3& x, double distance) {
  const double unit = f.short_axis / distance;
  const double along = unit * dot(x, f.along), across = unit * dot(x, f.across);
  Modes v;
  for (std::size_t m = 0; m < kWeights; ++m) v[m] = unit * f.short_axis * p[m];
  for (std::size_t m = 0; m < kMoves; ++m) v[kWeights + m] = along * p[m];
  for (std::size_t m = 0; m < kMoves; ++m) v[kWeights + kMoves + m] = across * p[m];
  return v;
}

// What the modes of a grain come to for one site.
struct Move {
  Vec3 shift;         // [L]
  double gain = 0.0;  // Of weight [L^2].
};

Move move_of(const Frame& f, const Polynomials& p, const double* modes) {
  Move move;
  const double unit = f.short_axis;
  for (std::size_t m = 0; m < kWeights; ++m) move.gain += 2.0 * unit * unit * modes[m] * p[m];
  for (std::size_t m = 0; m < kMoves; ++m) {
    move.shift +=
        unit * p[m] * (modes[kWeights + m] * f.along + modes[kWeights + kMoves + m] * f.across);
  }
  return move;
}

// How far a site or the circle of the short axis about it goes, over that axis.
double length_of(const Frame& f, const Move& move) {
  return std::max(norm(move.shift) / f.short_axis,
                  std::abs(move.gain) / (2.0 * f.short_axis * f.short_axis));
}

// J, in blocks of one grain's rows and another's modes.
class Derivatives {
 public:
  explicit Derivatives(std::size_t grains) : columns_(grains) {
    for (std::size_t g = 0; g < grains; ++g) find(g, g);
  }

  // The block of what the modes of `column` do to the cell of `row`.
  std::size_t find(std::size_t row, std::size_t column) {
    for (const Block& block : columns_[column]) {
      if (block.row == row) return block.index;
    }
    columns_[column].push_back({row, values_.size()});
    values_.emplace_back();
    return values_.size() - 1;
  }

  void add(std::size_t block, double factor, const Rows& f, const Modes& v) {
    for (std::size_t k = 0; k < kRows; ++k) {
      for (std::size_t m = 0; m < kModes; ++m) values_[block][k][m] += factor * f[k] * v[m];
    }
  }

  // J^T y.
  [[nodiscard]] std::vector<double> transposed_times(const std::vector<double>& y) const {
    std::vector<double> x(columns_.size() * kModes, 0.0);
    for_blocks([&](std::size_t row, std::size_t column, const Values& v) {
      for (std::size_t k = 0; k < kRows; ++k) {
        const double factor = y[row * kRows + k];
        for (std::size_t m = 0; m < kModes; ++m) x[column * kModes + m] += factor * v[k][m];
      }
    });
    return x;
  }

  // J x.
  [[nodiscard]] std::vector<double> times(const std::vector<double>& x) const {
    std::vector<double> y(columns_.size() * kRows, 0.0);
    for_blocks([&](std::size_t row, std::size_t column, const Values& v) {
      for (std::size_t k = 0; k < kRows; ++k) {
        double sum = 0.0;
        for (std::size_t m = 0; m < kModes; ++m) sum += v[k][m] * x[column * kModes + m];
        y[row * kRows + k] += sum;
      }
    });
    return y;
  }

  // Of J J^T.
  [[nodiscard]] std::vector<double> diagonal() const {
    std::vector<double> d(columns_.size() * kRows, 0.0);
    for_blocks([&](std::size_t row, std::size_t, const Values& v) {
      for (std::size_t k = 0; k < kRows; ++k) {
        for (const double value : v[k]) d[row * kRows + k] += value * value;
      }
    });
    return d;
  }

 private:
  struct Block {
    std::size_t row;
    std::size_t index;
  };
  using Values = std::array<Modes, kRows>;

  template <class Visit>
  void for_blocks(Visit&& visit) const {
    for (std::size_t column = 0; column < columns_.size(); ++column) {
      for (const Block& block : columns_[column]) visit(block.row, column, values_[block.index]);
    }
  }

  std::vector<std::vector<Block>> columns_;
  std::vector<Values> values_;
};

double dot_of(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

// z with (J J^T + damping I) z = right, by conjugate gradients scaled by the diagonal.
std::vector<double> solve(const Derivatives& j, const std::vector<double>& right, double damping) {
  const std::size_t n = right.size();
  std::vector<double> scale = j.diagonal();
  for (double& d : scale) d = 1.0 / (d + damping);
  std::vector<double> z(n, 0.0), left = right, scaled(n), direction(n, 0.0);
  double before = 1.0, first = 0.0;
  for (int k = 0; k < kMostIterations; ++k) {
    for (std::size_t i = 0; i < n; ++i) scaled[i] = scale[i] * left[i];
    const double now = dot_of(left, scaled);
    if (k == 0) first = now;
    if (now <= kResidual * kResidual * first) break;
    for (std::size_t i = 0; i < n; ++i) direction[i] = scaled[i] + now / before * direction[i];
    std::vector<double> image = j.times(j.transposed_times(direction));
    for (std::size_t i = 0; i < n; ++i) image[i] += damping * direction[i];
    const double length = now / dot_of(direction, image);
    for (std::size_t i = 0; i < n; ++i) z[i] += length * direction[i];
    for (std::size_t i = 0; i < n; ++i) left[i] -= length * image[i];
    before = now;
  }
  return z;
}

// All grains, and the step that they take.
class Step {
 public:
  Step(const Cell& box, const ShapeGoal& goal, const std::vector<Vec3>& centers,
       const CellSums& sums, std::vector<Site>& sites)
      : box_(box), centers_(centers), sites_(sites), derivatives_(centers.size()) {
    for (std::size_t g = 0; g < centers.size(); ++g) {
      Frame frame = frame_of(goal.shapes[g], goal.measures[g], sums.bodies[g]);
      frame.residual[2] = sums.cells[g].measure / goal.measures[g] - 1.0;
      frames_.push_back(frame);
    }
    for (const Site& site : sites) polynomials_.push_back(polynomials(frame(site), place(site)));
  }

  void add(const Interface& edge) {
    const Site &a = site(edge.a), &b = site(edge.b);
    const auto g = static_cast<std::size_t>(a.owner), h = static_cast<std::size_t>(b.owner);
    const std::size_t gg = derivatives_.find(g, g), gh = derivatives_.find(g, h);
    const std::size_t hg = derivatives_.find(h, g), hh = derivatives_.find(h, h);
    const Vec3 middle = 0.5 * (edge.ends[0] + edge.ends[1]), whole = edge.ends[1] - edge.ends[0];
    const double share = 0.5 * norm(whole), distance = norm(edge.to);
    for (const double side : {-0.5, 0.5}) {
      const Vec3 from_a = middle + side / std::numbers::sqrt3 * whole, from_b = from_a - edge.to;
      const Rows of_g = integrands(frames_[g], place(a) + from_a);
      const Rows of_h = integrands(frames_[h], place(b) + from_b);
      const Modes by_g = velocities(frames_[g], modes(edge.a), from_a, distance);
      const Modes by_h = velocities(frames_[h], modes(edge.b), from_b, distance);
      derivatives_.add(gg, share, of_g, by_g);
      derivatives_.add(hg, -share, of_h, by_g);
      derivatives_.add(hh, share, of_h, by_h);
      derivatives_.add(gh, -share, of_g, by_h);
    }
  }

  void take(double damping) {
    std::vector<double> right;
    for (const Frame& f : frames_) {
      for (const double r : f.residual) right.push_back(-r);
    }
    const std::vector<double> x =
        derivatives_.transposed_times(solve(derivatives_, right, damping));
    std::vector<Move> moves;
    std::vector<double> longest(frames_.size(), kMostMove);
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const auto g = static_cast<std::size_t>(sites_[i].owner);
      moves.push_back(move_of(frames_[g], polynomials_[i], x.data() + g * kModes));
      longest[g] = std::max(longest[g], length_of(frames_[g], moves[i]));
    }
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const Site& s = sites_[i];
      const double part = kMostMove / longest[static_cast<std::size_t>(s.owner)];
      const Vec3 at = s.at + image_shift(box_, s.home) + part * moves[i].shift;
      sites_[i] = wrapped_site(box_, at, s.weight + part * moves[i].gain, s.owner);
    }
  }

 private:
  [[nodiscard]] const Site& site(std::int32_t i) const {
    return sites_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] const Polynomials& modes(std::int32_t i) const {
    return polynomials_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] const Frame& frame(const Site& s) const {
    return frames_[static_cast<std::size_t>(s.owner)];
  }
  // From the centroid of its cell.
  [[nodiscard]] Vec3 place(const Site& s) const {
    return s.at + image_shift(box_, s.home) - centers_[static_cast<std::size_t>(s.owner)] -
           frame(s).centroid;
  }

  const Cell& box_;
  const std::vector<Vec3>& centers_;
  std::vector<Site>& sites_;
  std::vector<Frame> frames_;
  std::vector<Polynomials> polynomials_;  // Of each site.
  Derivatives derivatives_;
};

}  // namespace

void shape_step(const Cell& box, const ShapeGoal& goal, const std::vector<Vec3>& centers,
                const CellSums& sums, const std::vector<Interface>& interfaces, double damping,
                std::vector<Site>& sites) {
  Step step(box, goal, centers, sums, sites);
  for (const Interface& edge : interfaces) step.add(edge);
  step.take(damping);
}

std::array<double, 3> shape_residual(const CellShape& ordered, double target,
                                     const CellMoments& cell) {
  return frame_of(ordered, target, cell).residual;
}

}  // namespace packstone::laguerre
