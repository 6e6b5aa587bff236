// Query time of the hierarchical grid against an array of boxes in cell order and a tree of boxes.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <string>
#include <vector>

#include "packstone/core/random.hpp"
#include "packstone/spatial/hierarchical_grid.hpp"

namespace {

using namespace packstone;

struct Boxed {
  Vec3 center;
  Vec3 half_extents;
};

double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// A packed array of boxes in the order of equal grid cells (edge: the largest box), rebuilt whole:
// what a static neighbor search would use.
class SortedCells {
 public:
  explicit SortedCells(const std::vector<Boxed>& bodies) {
    double largest = 0.0;
    for (const Boxed& b : bodies) {
      largest = std::max({largest, b.half_extents.x, b.half_extents.y, b.half_extents.z});
    }
    reach_ = largest;
    const double finest = std::cbrt(static_cast<double>(bodies.size()));
    n_ = static_cast<int>(std::clamp(0.5 / largest, 1.0, std::max(1.0, finest)));
    const std::size_t cells = static_cast<std::size_t>(n_) * n_ * n_;
    start_.assign(cells + 1, 0);
    for (const Boxed& b : bodies) ++start_[cell_of(b.center) + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    boxes_.resize(bodies.size());
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      boxes_[next[cell_of(bodies[i].center)]++] = pack(bodies[i], static_cast<int>(i));
    }
  }

  template <class Visit>
  void query(const Vec3& c, const Vec3& h, Visit&& visit) const {
    int first[3], last[3];
    for (std::size_t a = 0; a < 3; ++a) {
      first[a] = static_cast<int>(std::floor((c[a] - h[a] - reach_) * n_));
      last[a] = static_cast<int>(std::floor((c[a] + h[a] + reach_) * n_));
    }
    for (int k = first[2]; k <= last[2]; ++k) {
      for (int j = first[1]; j <= last[1]; ++j) {
        for (int i = first[0]; i <= last[0]; ++i) visit_cell(i, j, k, c, h, visit);
      }
    }
  }

 private:
  struct Packed {
    float center[3];
    float half[3];
    std::int32_t id;
  };
  static Packed pack(const Boxed& b, int id) {
    return {
        {static_cast<float>(b.center.x), static_cast<float>(b.center.y),
         static_cast<float>(b.center.z)},
        {static_cast<float>(b.half_extents.x) + 1e-6F, static_cast<float>(b.half_extents.y) + 1e-6F,
         static_cast<float>(b.half_extents.z) + 1e-6F},
        id};
  }
  static int floor_div(int a, int n) { return a >= 0 ? a / n : -((n - 1 - a) / n); }
  std::size_t cell_of(const Vec3& p) const {
    const auto at = [&](double x) { return static_cast<std::size_t>(x * n_); };
    return (at(p.z) * n_ + at(p.y)) * n_ + at(p.x);
  }
  template <class Visit>
  void visit_cell(int i, int j, int k, const Vec3& c, const Vec3& h, Visit& visit) const {
    const int im[3] = {floor_div(i, n_), floor_div(j, n_), floor_div(k, n_)};
    const std::size_t cell =
        (static_cast<std::size_t>(k - im[2] * n_) * n_ + (j - im[1] * n_)) * n_ + (i - im[0] * n_);
    for (std::int32_t s = start_[cell]; s < start_[cell + 1]; ++s) {
      const Packed& b = boxes_[s];
      bool near = true;
      for (std::size_t a = 0; a < 3; ++a) {
        const float d = b.center[a] + static_cast<float>(im[a]) - static_cast<float>(c[a]);
        near &= std::abs(d) <= b.half[a] + static_cast<float>(h[a]);
      }
      if (near) visit(b.id);
    }
  }

  int n_ = 1;
  double reach_ = 0.0;
  std::vector<std::int32_t> start_;
  std::vector<Packed> boxes_;
};

// A binary tree of boxes over bodies sorted along a Morton curve, leaves of four; images by asking
// 27 times at most. Built whole, pointer-free: the fast kind of static tree.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Boxed>& bodies) {
    std::vector<std::int32_t> order(bodies.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<std::uint64_t> key(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) key[i] = morton(bodies[i].center);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
    leaves_ = std::bit_ceil((bodies.size() + 3) / 4);
    nodes_.assign(2 * leaves_, Node{});
    ids_ = order;
    for (std::size_t s = 0; s < order.size(); ++s) {
      const Node box = node(bodies[order[s]]);
      boxes_.push_back(box);
      grow(nodes_[leaves_ + s / 4], box);
    }
    for (std::size_t n = leaves_ - 1; n >= 1; --n) {
      nodes_[n] = nodes_[2 * n];
      grow(nodes_[n], nodes_[2 * n + 1]);
    }
  }

  template <class Visit>
  void query(const Vec3& c, const Vec3& h, Visit&& visit) const {
    for (int k = -1; k <= 1; ++k) {
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const Vec3 shift{double(i), double(j), double(k)};
          descend(node({c - shift, h}), visit);
        }
      }
    }
  }

 private:
  struct Node {
    float lo[3] = {1e30F, 1e30F, 1e30F};
    float hi[3] = {-1e30F, -1e30F, -1e30F};
  };
  static std::uint64_t morton(const Vec3& p) {
    std::uint64_t key = 0;
    for (int bit = 20; bit >= 0; --bit) {
      for (std::size_t a = 0; a < 3; ++a) {
        key = (key << 1) | ((static_cast<std::uint64_t>(p[a] * 0x1p21) >> bit) & 1);
      }
    }
    return key;
  }
  static Node node(const Boxed& b) {
    Node n;
    for (std::size_t a = 0; a < 3; ++a) {
      n.lo[a] = static_cast<float>(b.center[a] - b.half_extents[a]) - 1e-6F;
      n.hi[a] = static_cast<float>(b.center[a] + b.half_extents[a]) + 1e-6F;
    }
    return n;
  }
  static void grow(Node& n, const Node& by) {
    for (std::size_t a = 0; a < 3; ++a) {
      n.lo[a] = std::min(n.lo[a], by.lo[a]);
      n.hi[a] = std::max(n.hi[a], by.hi[a]);
    }
  }
  static bool meet(const Node& a, const Node& b) {
    return (a.lo[0] <= b.hi[0]) & (a.hi[0] >= b.lo[0]) & (a.lo[1] <= b.hi[1]) &
           (a.hi[1] >= b.lo[1]) & (a.lo[2] <= b.hi[2]) & (a.hi[2] >= b.lo[2]);
  }
  template <class Visit>
  void descend(const Node& box, Visit& visit) const {
    std::size_t stack[64];
    int top = 0;
    stack[top++] = 1;
    while (top > 0) {
      const std::size_t n = stack[--top];
      if (!meet(nodes_[n], box)) continue;
      if (n < leaves_) {
        stack[top++] = 2 * n;
        stack[top++] = 2 * n + 1;
        continue;
      }
      const std::size_t first = 4 * (n - leaves_);
      for (std::size_t s = first; s < std::min(first + 4, boxes_.size()); ++s) {
        if (meet(boxes_[s], box)) visit(ids_[s]);
      }
    }
  }

  std::size_t leaves_ = 1;
  std::vector<Node> nodes_;
  std::vector<Node> boxes_;
  std::vector<std::int32_t> ids_;
};

// Boxes of spheres with radii r to spread * r, number density ~ 1/r^3.5, or of needles of aspect
// 100 turned at random, that fill `fraction` of the unit cell together.
std::vector<Boxed> make_scene(const std::string& kind, std::int64_t count, double fraction) {
  std::vector<Boxed> bodies(static_cast<std::size_t>(count));
  double sum = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    RandomStream random(1, StreamId::benchmark, i);
    Boxed& b = bodies[i];
    b.center = {random.uniform(), random.uniform(), random.uniform()};
    double r = 1.0;
    if (kind == "polydisperse") r = std::pow(1.0 - random.uniform() * (1.0 - 0x1p-25), -0.4);
    b.half_extents = {r, r, r};
    if (kind == "needles") {
      const Vec3 u = random_direction(random);
      const auto half = [](double c) { return 100.0 * std::abs(c) + std::sqrt(1.0 - c * c); };
      b.half_extents = {half(u.x), half(u.y), half(u.z)};
    }
    sum += kind == "needles" ? 200.0 * 3.14159 : 4.18879 * r * r * r;
  }
  const double scale = std::cbrt(fraction / sum);
  for (Boxed& b : bodies) b.half_extents = scale * b.half_extents;
  return bodies;
}

template <class Search>
void report(const char* name, const std::vector<Boxed>& bodies, std::size_t queries, Search query,
            double build) {
  // Another body's place in a scrambled order: what random trials look like to the memory.
  std::int64_t visits = 0;
  std::vector<double> seconds;
  for (int run = 0; run < 3; ++run) {
    visits = 0;
    const double start = cpu_seconds();
    std::size_t at = 0;
    for (std::size_t q = 0; q < queries; ++q) {
      at = (at + 514229) % bodies.size();
      const Vec3 shifted{1.0 - bodies[at].center.y, bodies[at].center.z, bodies[at].center.x};
      query(shifted, bodies[at].half_extents, visits);
    }
    seconds.push_back(cpu_seconds() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  const auto n = static_cast<double>(bodies.size());
  std::printf("  %-14s build %7.1f ns/body   query %9.1f ns   visits %.2f\n", name, 1e9 * build / n,
              1e9 * seconds[1] / static_cast<double>(queries),
              static_cast<double>(visits) / static_cast<double>(queries));
}

void run(const std::string& kind, std::int64_t count, double fraction) {
  const auto bodies = make_scene(kind, count, fraction);
  const std::size_t queries = kind == "equal spheres" ? 200000 : 2000;
  std::printf("%s, %lld bodies, fraction %.2f\n", kind.c_str(), static_cast<long long>(count),
              fraction);
  double start = cpu_seconds();
  HierarchicalGrid grid{Cell{}};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    grid.insert(static_cast<std::int32_t>(i), bodies[i].center, bodies[i].half_extents);
  }
  report(
      "grid", bodies, queries,
      [&](const Vec3& c, const Vec3& h, std::int64_t& visits) {
        grid.query(c, h, 0.0, [&](std::int32_t, const HierarchicalGrid::Image&) {
          ++visits;
          return true;
        });
      },
      cpu_seconds() - start);
  report(
      "grid, one hit", bodies, queries,
      [&](const Vec3& c, const Vec3& h, std::int64_t& visits) {
        grid.query(c, h, 0.0, [&](std::int32_t, const HierarchicalGrid::Image&) {
          ++visits;
          return false;
        });
      },
      0.0);
  if (kind != "polydisperse" || count <= 100000) {
    start = cpu_seconds();
    const SortedCells cells(bodies);
    report(
        "sorted cells", bodies, kind == "polydisperse" ? 50 : queries,
        [&](const Vec3& c, const Vec3& h, std::int64_t& visits) {
          cells.query(c, h, [&](std::int32_t) { ++visits; });
        },
        cpu_seconds() - start);
  }
  start = cpu_seconds();
  const BoxTree tree(bodies);
  report(
      "box tree", bodies, queries,
      [&](const Vec3& c, const Vec3& h, std::int64_t& visits) {
        tree.query(c, h, [&](std::int32_t) { ++visits; });
      },
      cpu_seconds() - start);
}

}  // namespace

int main() {
  for (const std::int64_t count : {1'000, 10'000, 100'000, 1'000'000}) {
    run("equal spheres", count, 0.3);
    run("polydisperse", count, 0.3);
    if (count <= 100'000) run("needles", count, 0.1);
  }
}
