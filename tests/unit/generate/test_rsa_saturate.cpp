#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "generate/rsa/equal_balls.hpp"
#include "packstone/core/error.hpp"
#include "packstone/generate/rsa.hpp"
#include "packstone/geometry/contact.hpp"
#include "scenes.hpp"

using namespace packstone;

namespace {

constexpr double kPi = std::numbers::pi;

// The oracle's distance: nearest over the periodic images up to two periods off.
double image_distance(const Cell& cell, const Vec3& a, const Vec3& b, bool same) {
  double least = std::numeric_limits<double>::infinity();
  const auto span = [&](std::size_t axis) { return cell.periodic[axis] ? 2 : 0; };
  for (int i = -span(0); i <= span(0); ++i) {
    for (int j = -span(1); j <= span(1); ++j) {
      for (int k = -span(2); k <= span(2); ++k) {
        if (same && i == 0 && j == 0 && k == 0) continue;
        least = std::min(least, norm(b - a + image_shift(cell, {i, j, k})));
      }
    }
  }
  return least;
}

// Same, for cells wider than four exclusion distances: the nearest image along each axis.
double near_distance(const Cell& cell, const Vec3& a, const Vec3& b) {
  Vec3 r = b - a;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cell.periodic[axis]) r[axis] -= cell.size[axis] * std::round(r[axis] / cell.size[axis]);
  }
  return norm(r);
}

double smallest_gap(const Packing& packing, double radius) {
  double least = std::numeric_limits<double>::infinity();
  const auto& list = packing.inclusions;
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t j = i; j < list.size(); ++j) {
      least = std::min(
          least, image_distance(packing.cell, list[i].center, list[j].center, i == j) - 2 * radius);
    }
  }
  return least;
}

bool kernel_proves_all_apart(const Packing& packing, double min_gap) {
  const auto& list = packing.inclusions;
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t j = 0; j < list.size(); ++j) {
      for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
          for (int z = -1; z <= 1; ++z) {
            const std::array<int, 3> image{x, y, z};
            bool skip = i == j && x == 0 && y == 0 && z == 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
              skip = skip || (image[axis] != 0 && !packing.cell.periodic[axis]);
            }
            if (skip) continue;
            const Vec3 r = list[j].center + image_shift(packing.cell, image) - list[i].center;
            if (overlap(list[i].body, list[j].body, r, min_gap) != Verdict::separated) return false;
          }
        }
      }
    }
  }
  return true;
}

bool inside_walls(const Packing& packing, double radius) {
  for (const Inclusion& inclusion : packing.inclusions) {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(packing.cell.dimension); ++axis) {
      const double x = inclusion.center[axis];
      const double size = packing.cell.size[axis];
      if (packing.cell.periodic[axis] ? !(x >= 0 && x < size)
                                      : !(x >= radius && x <= size - radius)) {
        return false;
      }
    }
  }
  return true;
}

Vec3 random_position(const Cell& cell, double radius, std::mt19937_64& engine) {
  Vec3 p;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(cell.dimension); ++axis) {
    const double margin = cell.periodic[axis] ? 0.0 : radius;
    p[axis] = std::uniform_real_distribution<>(margin, cell.size[axis] - margin)(engine);
  }
  return p;
}

// How many of `attempts` positions would take one more body.
int attempts_with_room(const Packing& packing, double radius, double min_gap, int attempts) {
  std::mt19937_64 engine(11);
  int room = 0;
  for (int k = 0; k < attempts; ++k) {
    const Vec3 p = random_position(packing.cell, radius, engine);
    room += std::all_of(packing.inclusions.begin(), packing.inclusions.end(), [&](const auto& b) {
      return image_distance(packing.cell, p, b.center, false) > 2 * radius + min_gap;
    });
  }
  return room;
}

// The plain process, with a generator and code of its own: the judge of the fast one.
class PlainRsa {
 public:
  PlainRsa(const Cell& cell, double radius, unsigned seed)
      : cell_(cell), radius_(radius), engine_(seed) {}

  std::vector<Vec3> centers;

  // Positions anywhere, until `target` stand or `max_rejects` in a row have failed.
  void run(std::size_t target, int max_rejects) {
    for (int rejects = 0; rejects < max_rejects && centers.size() < target; ++rejects) {
      if (place(random_position(cell_, radius_, engine_))) rejects = -1;
    }
  }

  // The same, but only in those of n x n squares that no single disk covers: 2D.
  void finish(int n, int max_rejects) {
    const std::vector<Vec3> squares = open_squares(n);
    if (squares.empty()) return;
    std::uniform_int_distribution<std::size_t> pick(0, squares.size() - 1);
    std::uniform_real_distribution<> unit(0.0, 1.0);
    for (int rejects = 0; rejects < max_rejects; ++rejects) {
      const Vec3 low = squares[pick(engine_)];
      if (place(low + Vec3{unit(engine_) * step(0, n), unit(engine_) * step(1, n), 0}))
        rejects = -1;
    }
  }

 private:
  double margin(std::size_t axis) const { return cell_.periodic[axis] ? 0.0 : radius_; }
  double step(std::size_t axis, int n) const { return (cell_.size[axis] - 2 * margin(axis)) / n; }

  bool place(const Vec3& p) {
    const bool free = std::all_of(centers.begin(), centers.end(), [&](const Vec3& q) {
      return near_distance(cell_, p, q) > 2 * radius_;
    });
    if (free) centers.push_back(p);
    return free;
  }

  std::vector<Vec3> open_squares(int n) const {
    std::vector<Vec3> open;
    const double half_diagonal = 0.5 * std::hypot(step(0, n), step(1, n));
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const Vec3 low{margin(0) + i * step(0, n), margin(1) + j * step(1, n), 0};
        const Vec3 middle = low + 0.5 * Vec3{step(0, n), step(1, n), 0};
        const bool covered = std::any_of(centers.begin(), centers.end(), [&](const Vec3& q) {
          return near_distance(cell_, middle, q) + half_diagonal < 2 * radius_;
        });
        if (!covered) open.push_back(low);
      }
    }
    return open;
  }

  Cell cell_;
  double radius_;
  std::mt19937_64 engine_;
};

struct Moments {
  double sum = 0.0;
  double sum_sq = 0.0;
  int count = 0;
  void add(double x) {
    sum += x;
    sum_sq += x * x;
    ++count;
  }
  [[nodiscard]] double mean() const { return sum / count; }
  [[nodiscard]] double variance_of_mean() const {
    return (sum_sq / count - mean() * mean()) / (count - 1);
  }
};

// Difference of two means in standard deviations.
double z_score(const Moments& a, const Moments& b) {
  return (a.mean() - b.mean()) / std::sqrt(a.variance_of_mean() + b.variance_of_mean());
}

double ball(int dimension, double radius) {
  return dimension == 2 ? kPi * radius * radius : 4.0 / 3.0 * kPi * radius * radius * radius;
}

double radius_for(const Cell& cell, double count, double target_fraction) {
  const double one = target_fraction * volume(cell) / count;
  return cell.dimension == 2 ? std::sqrt(one / kPi) : std::cbrt(one * 0.75 / kPi);
}

const Cell kCube{3, {1, 1, 1}, {true, true, true}};

std::vector<Cell> assorted_cells() {
  return {cell_2d(1, 1),
          cell_2d(1.7, 0.6),
          cell_2d(1, 1, false, true),
          cell_2d(1, 0.8, false, false),
          kCube,
          {3, {1.5, 0.7, 1}, {true, true, true}},
          {3, {1, 1, 0.8}, {true, true, false}},
          {3, {1, 0.9, 0.8}, {false, false, false}}};
}

std::string thrown_message(const Cell& cell, double radius, const RsaOptions& options = {}) {
  try {
    static_cast<void>(rsa_saturate(cell, radius, options));
  } catch (const InvalidArgument& problem) {
    return problem.what();
  }
  return "";
}

}  // namespace

TEST_CASE("rsa_saturate leaves no overlap and no room, with periods and walls, in 2D and 3D") {
  for (const Cell& cell : assorted_cells()) {
    for (const double min_gap : {0.0, 0.02}) {
      const double radius = cell.dimension == 2 ? 0.04 : 0.09;
      const RsaResult run = rsa_saturate(cell, radius, {.min_gap = min_gap, .seed = 5});
      CAPTURE(cell.size.x, cell.size.y, cell.size.z, min_gap, run.packing.inclusions.size());
      CHECK(run.stop == RsaStop::saturated);
      CHECK(run.packing.inclusions.size() > 30);
      CHECK_NOTHROW(check_well_formed(run.packing));
      CHECK(smallest_gap(run.packing, radius) > min_gap);
      CHECK(inside_walls(run.packing, radius));
      // Saturated for 1e-12 more than the distance kept; the oracle rounds differently.
      CHECK(attempts_with_room(run.packing, radius, min_gap + 1e-12, 1500) == 0);
    }
  }
}

TEST_CASE("the exact kernel proves every pair of a saturated packing apart") {
  for (const double min_gap : {0.0, 0.05}) {
    const RsaResult disks = rsa_saturate(cell_2d(1, 1), 0.05, {.min_gap = min_gap, .seed = 1});
    CHECK(kernel_proves_all_apart(disks.packing, min_gap));
    const RsaResult spheres = rsa_saturate(kCube, 0.1, {.min_gap = min_gap, .seed = 1});
    CHECK(kernel_proves_all_apart(spheres.packing, min_gap));
  }
}

TEST_CASE("rsa_saturate leaves no room that 30 000 plain attempts could find") {
  const double disk = 0.03;
  const RsaResult disks = rsa_saturate(cell_2d(1, 1), disk, {.seed = 2});
  CHECK(attempts_with_room(disks.packing, disk, 1e-12, 20'000) == 0);
  const double sphere = 0.12;
  const RsaResult spheres = rsa_saturate(kCube, sphere, {.seed = 2});
  CHECK(attempts_with_room(spheres.packing, sphere, 1e-12, 10'000) == 0);
}

TEST_CASE("a body taken out of a saturated packing leaves room that the attempts find") {
  // The oracle of the case above can fail.
  RsaResult disks = rsa_saturate(cell_2d(1, 1), 0.05, {.seed = 2});
  disks.packing.inclusions.erase(disks.packing.inclusions.begin());
  CHECK(attempts_with_room(disks.packing, 0.05, 0.0, 20'000) > 0);
}

TEST_CASE("counts at saturation are distributed as in the plain process") {
  // Means over 300 runs each. The plain runs search what they leave open with some 10^6 trials'
  // worth: they miss 0.02 disks a run, by the known decay with the root of the number of trials
  // (J. Feder, J. Theor. Biol. 87 (1980) 237). |z| < 4 fails by chance once in 15 000.
  for (const Cell& cell : {cell_2d(1, 1), cell_2d(1, 1, false, true)}) {
    Moments fast;
    Moments plain;
    for (unsigned seed = 0; seed < 300; ++seed) {
      const RsaResult run = rsa_saturate(cell, 0.115, {.seed = seed});
      fast.add(static_cast<double>(run.packing.inclusions.size()));
      PlainRsa judge(cell, 0.115, 1000 + seed);
      judge.run(1000, 2000);
      judge.finish(100, 4000);
      plain.add(static_cast<double>(judge.centers.size()));
    }
    CAPTURE(fast.mean(), plain.mean());
    CHECK(std::abs(z_score(fast, plain)) < 4.0);
    CHECK(plain.mean() > 10.0);
  }
}

TEST_CASE("disks in a channel one disk wide park as cars do") {
  // A. Renyi, Publ. Math. Inst. Hung. Acad. Sci. 3 (1958) 109: 0.7475979 of the length. The
  // variance per car length is 0.0381 (J. K. Mackenzie, J. Chem. Phys. 37 (1962) 723): 0.0014 is
  // one standard deviation for 20 000 lengths, less for the mean of three.
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const RsaResult run = rsa_saturate(cell_2d(20'000, 1 + 1e-7, true, false), 0.5, {.seed = seed});
    CHECK(run.stop == RsaStop::saturated);
    sum += static_cast<double>(run.packing.inclusions.size()) / 20'000;
  }
  CHECK(sum / 3 == Approx(0.7475979).margin(0.003));
}

TEST_CASE("pair distances are distributed as in the plain process at the same count") {
  // A fraction of 0.50 is reached among the voxels. Chi squared of two histograms with 12
  // bins: expectation 12, standard deviation 5; 40 is beyond chance.
  const Cell cell = cell_2d(1, 1);
  const std::size_t count = 40;
  const double radius = radius_for(cell, static_cast<double>(count), 0.50);
  std::array<double, 12> fast{};
  std::array<double, 12> plain{};
  const auto add = [&](std::array<double, 12>& bins, const std::vector<Vec3>& centers) {
    if (centers.size() < count) return;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double steps =
            (near_distance(cell, centers[i], centers[j]) / (2 * radius) - 1) / 0.08;
        if (steps < 12) ++bins[static_cast<std::size_t>(steps)];
      }
    }
  };
  for (unsigned seed = 0; seed < 250; ++seed) {
    const auto target = static_cast<std::int64_t>(count);
    add(fast, rsa::rsa_equal_balls({.cell = cell, .radius = radius, .target = target, .seed = seed})
                  .centers);
    PlainRsa judge(cell, radius, 5000 + seed);
    judge.run(count, 20'000);
    add(plain, judge.centers);
  }
  double total_fast = 0.0;
  double total_plain = 0.0;
  for (std::size_t i = 0; i < 12; ++i) {
    total_fast += fast[i];
    total_plain += plain[i];
  }
  REQUIRE(total_fast > 5000);
  double chi_sq = 0.0;
  for (std::size_t i = 0; i < 12; ++i) {
    const double difference = fast[i] * std::sqrt(total_plain / total_fast) -
                              plain[i] * std::sqrt(total_fast / total_plain);
    chi_sq += difference * difference / (fast[i] + plain[i]);
  }
  CHECK(chi_sq < 40.0);
}

TEST_CASE("early trials succeed as often as the density expansion says") {
  // P. Schaaf, J. Talbot, J. Chem. Phys. 91 (1989) 4401: for disks the part of the plane that is
  // free is 1 - 4 t + (6 sqrt(3)/pi) t^2 + (40/(sqrt(3) pi) - 176/(3 pi^2)) t^3 + O(t^4).
  const auto free_part = [](double t) {
    const double root = std::sqrt(3.0);
    return 1 - 4 * t + 6 * root / kPi * t * t +
           (40 / (root * kPi) - 176 / (3 * kPi * kPi)) * t * t * t;
  };
  const Cell cell = cell_2d(1, 1);
  const double end = 0.10;
  const double count = 40'000;
  double trials_each = 0.0;
  for (int k = 0; k < 1000; ++k) trials_each += 1.0 / free_part((k + 0.5) * 1e-3 * end) / 1000;
  const auto run = rsa::rsa_equal_balls({.cell = cell,
                                         .radius = radius_for(cell, count, end),
                                         .target = static_cast<std::int64_t>(count),
                                         .seed = 4});
  CHECK(run.stop == RsaStop::target_reached);
  // 40 000 geometric waiting times: 0.3 % per standard deviation.
  CHECK(static_cast<double>(run.trials) / count == Approx(trials_each).epsilon(0.01));
}

TEST_CASE("rsa_saturate gives the same bits for 1, 2, 3 and 8 threads") {
  const auto hash = [](const Cell& cell, double radius, int threads) {
    return scenes::state_hash(
        rsa_saturate(cell, radius, {.seed = 9}, RunContext().threads(threads)).packing);
  };
  const Cell square = cell_2d(1, 1);
  const double disk = radius_for(square, 20'000, 0.547);
  const double sphere = radius_for(kCube, 4000, 0.384);
  for (const int threads : {2, 3, 8}) {
    CHECK(hash(square, disk, threads) == hash(square, disk, 1));
    CHECK(hash(kCube, sphere, threads) == hash(kCube, sphere, 1));
  }
}

TEST_CASE("seeds and fresh starts of rsa_equal_balls give different packings") {
  rsa::EqualBallsOrder order{.cell = kCube, .radius = 0.1, .seed = 1};
  const auto first = rsa::rsa_equal_balls(order).centers;
  CHECK(first == rsa::rsa_equal_balls(order).centers);
  order.start = 1;
  CHECK(first != rsa::rsa_equal_balls(order).centers);
  order = {.cell = kCube, .radius = 0.1, .seed = 2};
  CHECK(first != rsa::rsa_equal_balls(order).centers);
}

TEST_CASE("rsa_equal_balls stops at its target, among plain trials and among voxels") {
  rsa::EqualBallsOrder order{.cell = cell_2d(1, 1), .radius = 0.02, .seed = 3};
  const auto all = rsa::rsa_equal_balls(order);
  REQUIRE(all.stop == RsaStop::saturated);
  const auto total = static_cast<std::int64_t>(all.centers.size());
  for (const std::int64_t target : {std::int64_t{0}, std::int64_t{1}, total / 2, total - 5}) {
    order.target = target;
    const auto some = rsa::rsa_equal_balls(order);
    CHECK(some.stop == RsaStop::target_reached);
    CHECK(static_cast<std::int64_t>(some.centers.size()) == target);
    // How long plain trials last depends on the target, but they last beyond the half.
    const auto same = static_cast<std::ptrdiff_t>(std::min(target, total / 2));
    CHECK(std::equal(some.centers.begin(), some.centers.begin() + same, all.centers.begin()));
  }
  order.target = 10 * total;
  CHECK(rsa::rsa_equal_balls(order).stop == RsaStop::saturated);
}

TEST_CASE("bodies meet several images of a neighbor in a cell barely wider than one of them") {
  for (const double size : {1.0 + 1e-9, 1.02, 1.3, 1.9, 2.1}) {
    const RsaResult disks = rsa_saturate(cell_2d(size, size), 0.5, {.seed = 7});
    CAPTURE(size);
    CHECK(disks.stop == RsaStop::saturated);
    CHECK(!disks.packing.inclusions.empty());
    CHECK(smallest_gap(disks.packing, 0.5) > 0.0);
    CHECK(attempts_with_room(disks.packing, 0.5, 1e-12, 2000) == 0);
    const Cell slab{3, {size, 1.4, 3.0}, {true, true, true}};
    const RsaResult spheres = rsa_saturate(slab, 0.5, {.seed = 7});
    CHECK(spheres.stop == RsaStop::saturated);
    CHECK(!spheres.packing.inclusions.empty());
    CHECK(smallest_gap(spheres.packing, 0.5) > 0.0);
    CHECK(attempts_with_room(spheres.packing, 0.5, 1e-12, 500) == 0);
  }
}

TEST_CASE("walls one body apart hold a layer of bodies") {
  const Cell slit{3, {6, 5, 1 + 1e-9}, {true, true, false}};
  const RsaResult run = rsa_saturate(slit, 0.5, {.seed = 3});
  CHECK(run.stop == RsaStop::saturated);
  // A layer of spheres is a packing of disks: 0.547 of the plane, and boundary effects.
  CHECK(run.packing.inclusions.size() > 15);
  CHECK(inside_walls(run.packing, 0.5));
  CHECK(smallest_gap(run.packing, 0.5) > 0.0);
}

TEST_CASE("gaps hold far from the origin of a large cell") {
  // 1e6 radii: rounding of a coordinate is then 1e-10 radii, and the wall must still be proven.
  const Cell wire = cell_2d(1e6, 2.5, true, false);
  const auto run = rsa::rsa_equal_balls({.cell = wire, .radius = 1.0, .target = 20'000, .seed = 3});
  Packing packing;
  packing.cell = wire;
  for (const Vec3& c : run.centers) packing.inclusions.push_back({c, Disk{1.0}, 0});
  CHECK(inside_walls(packing, 1.0));
  std::sort(packing.inclusions.begin(), packing.inclusions.end(),
            [](const auto& a, const auto& b) { return a.center.x < b.center.x; });
  bool apart = true;
  for (std::size_t i = 1; i < packing.inclusions.size(); ++i) {
    const Vec3 r = packing.inclusions[i].center - packing.inclusions[i - 1].center;
    apart = apart && overlap(Disk{1.0}, Disk{1.0}, r) == Verdict::separated;
  }
  CHECK(apart);
}

TEST_CASE("rsa_saturate stops when it is cancelled or out of time, with what stands so far") {
  const std::atomic<bool> cancelled = true;
  const RsaResult none = rsa_saturate(kCube, 0.01, {}, RunContext().cancel_flag(&cancelled));
  CHECK(none.stop == RsaStop::cancelled);
  CHECK(none.packing.inclusions.empty());
  const auto past = RunContext::Clock::now() - std::chrono::seconds(1);
  CHECK(rsa_saturate(kCube, 0.01, {}, RunContext().deadline(past)).stop == RsaStop::out_of_time);
}

TEST_CASE("a run cancelled half-way is the beginning of the whole run") {
  std::atomic<bool> cancel = false;
  const rsa::EqualBallsOrder order{.cell = cell_2d(1, 1), .radius = 8e-4, .seed = 3};
  const auto part = rsa::rsa_equal_balls(
      order, RunContext().cancel_flag(&cancel).on_progress(
                 [&](const Progress& progress) { cancel = progress.placed > 0; }));
  REQUIRE(part.stop == RsaStop::cancelled);
  REQUIRE(!part.centers.empty());
  const auto whole = rsa::rsa_equal_balls(order);
  REQUIRE(whole.centers.size() > part.centers.size());
  CHECK(std::equal(part.centers.begin(), part.centers.end(), whole.centers.begin()));
}

TEST_CASE("progress of rsa_saturate names the stage and stays within its range") {
  std::vector<Progress> reports;
  static_cast<void>(rsa_saturate(
      cell_2d(1, 1), 0.01, {.seed = 3},
      RunContext().on_progress([&](const Progress& progress) { reports.push_back(progress); })));
  REQUIRE(!reports.empty());
  for (const Progress& report : reports) {
    CHECK(!report.stage.empty());
    CHECK((report.done >= 0.0 && report.done <= 1.0));
    CHECK((report.fraction >= 0.0 && report.fraction < 0.6));
    CHECK(report.wanted == 0);
  }
}

TEST_CASE("rsa_saturate refuses bad input and names the field, the value and the range") {
  const Cell square = cell_2d(1, 1);
  using Catch::Matchers::Contains;
  CHECK_THAT(thrown_message(square, 0.0), Contains("radius = 0") && Contains("> 0"));
  CHECK_THAT(thrown_message(square, -1.0), Contains("radius = -1"));
  CHECK_THAT(thrown_message(square, std::nan("")), Contains("radius = "));
  CHECK_THAT(thrown_message(square, 0.1, {.min_gap = -0.5}), Contains("min_gap = -0.5"));
  CHECK_THAT(thrown_message(square, 0.1, {.max_trials = 0}), Contains("max_trials = 0"));
  CHECK_THAT(thrown_message(square, 0.5), Contains("own image") && Contains("cell.size[0] = 1"));
  CHECK_THAT(thrown_message(square, 0.45, {.min_gap = 0.1}), Contains("min_gap = 0.1"));
  CHECK_THAT(thrown_message(cell_2d(2, 1, true, false), 0.6), Contains("walls"));
  CHECK_THAT(thrown_message(cell_2d(-1, 1), 0.1), Contains("cell.size[0]"));
  CHECK_THAT(thrown_message(kCube, 1e-6), Contains("too small"));
  CHECK_NOTHROW(rsa_saturate(cell_2d(1, 1, false, false), 0.45, {.min_gap = 5.0}));
}

TEST_CASE("rsa_saturate leaves no room that 10^6 plain attempts could find", "[validation]") {
  const RsaResult disks = rsa_saturate(cell_2d(1, 1), 0.03, {.seed = 2});
  CHECK(attempts_with_room(disks.packing, 0.03, 1e-12, 1'000'000) == 0);
  const RsaResult spheres = rsa_saturate(kCube, 0.12, {.seed = 2});
  CHECK(attempts_with_room(spheres.packing, 0.12, 1e-12, 1'000'000) == 0);
}

TEST_CASE("the fraction at saturation is the published one", "[validation]") {
  // Zhang & Torquato 2013: disks 0.547067(3), spheres 0.38413(1). One packing of N bodies
  // scatters by about 0.2 / sqrt(N) in 2D and 0.25 / sqrt(N) in 3D: 4e-4 for the mean of 5 here.
  const auto mean_fraction = [](const Cell& cell, double count, double expected) {
    const double radius = radius_for(cell, count, expected);
    double sum = 0.0;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const RsaResult run = rsa_saturate(cell, radius, {.seed = seed});
      CHECK(run.stop == RsaStop::saturated);
      sum += static_cast<double>(run.packing.inclusions.size()) * ball(cell.dimension, radius) /
             volume(cell);
    }
    return sum / 5;
  };
  CHECK(mean_fraction(cell_2d(1, 1), 1e5, 0.547067) == Approx(0.547067).margin(0.0005));
  CHECK(mean_fraction(kCube, 1e5, 0.38413) == Approx(0.38413).margin(0.0005));
}
