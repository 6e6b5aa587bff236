#include "packstone/tessellate/power_diagram.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "packstone/core/compensated_sum.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/random.hpp"

using namespace packstone;

namespace {

struct Scene {
  Cell box;
  std::vector<LaguerreSite> sites;
  std::vector<TessellationCell> owners;
};

Cell box_of(int dimension, int periodic) {
  Cell box;
  box.dimension = dimension;
  box.size = {1.0, 0.8, dimension == 3 ? 1.3 : 0.0};
  for (std::size_t a = 0; a < 3; ++a) {
    box.periodic[a] = static_cast<int>(a) < dimension && (periodic >> a & 1) != 0;
  }
  return box;
}

Vec3 random_place(const Cell& box, RandomStream& random) {
  return {random.uniform(0, box.size.x), random.uniform(0, box.size.y),
          box.dimension == 3 ? random.uniform(0, box.size.z) : 0.0};
}

double spacing(const Cell& box, int count) {
  return std::pow(volume(box) / count, 1.0 / box.dimension);
}

void add_owner(Scene& scene, const Vec3& center) { scene.owners.push_back({center, 0, 1}); }

// `count` sites, each its own owner, with balls of up to `radius` times their mean distance.
Scene scattered(int dimension, int periodic, int count, double radius, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test, 0);
  Scene scene{box_of(dimension, periodic), {}, {}};
  for (int i = 0; i < count; ++i) {
    const Vec3 at = random_place(scene.box, random);
    const double r = random.uniform(0, radius * spacing(scene.box, count));
    scene.sites.push_back({at, r * r, i});
    add_owner(scene, at);
  }
  return scene;
}

// Owners of `links` sites in a row each.
Scene chains(int dimension, int periodic, int count, int links, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test, 0);
  Scene scene{box_of(dimension, periodic), {}, {}};
  const double step = 0.4 * spacing(scene.box, count * links);
  for (int i = 0; i < count; ++i) {
    const Vec3 at = random_place(scene.box, random);
    Vec3 along = random_direction(random);
    if (dimension == 2) along = normalized(Vec3{along.x, along.y, 0});
    for (int k = 0; k < links; ++k) {
      const double off = k - 0.5 * (links - 1);
      scene.sites.push_back({at + step * off * along, step * step * (4.0 - 0.1 * off * off), i});
    }
    add_owner(scene, at);
  }
  return scene;
}

// Points of a lattice with this basis (in units of the lattice cells), repeated n times per axis.
Scene lattice(const Cell& box, const std::array<int, 3>& n, const std::vector<Vec3>& basis) {
  Scene scene{box, {}, {}};
  for (int i = 0; i < n[0]; ++i) {
    for (int j = 0; j < n[1]; ++j) {
      for (int k = 0; k < n[2]; ++k) {
        for (const Vec3& b : basis) {
          const Vec3 at{(i + b.x) / n[0] * box.size.x, (j + b.y) / n[1] * box.size.y,
                        (k + b.z) / n[2] * box.size.z};
          scene.sites.push_back({at, 0.25, static_cast<std::int32_t>(scene.owners.size())});
          add_owner(scene, at);
        }
      }
    }
  }
  return scene;
}

Tessellation diagram(const Scene& scene, int threads = 1) {
  return power_diagram(scene.box, scene.sites, scene.owners, RunContext{}.threads(threads));
}

double total(const Tessellation& t) {
  CompensatedSum sum;
  for (const CellShape& shape : cell_shapes(t)) sum.add(shape.measure);
  return sum.value();
}

// Edges of the facets in 3D, each once.
std::size_t edge_count(const Tessellation& t) {
  std::set<std::tuple<int, int, std::array<int, 3>>> edges;
  for (const Facet& f : t.facets) {
    for (int k = 0; k < f.corner_count; ++k) {
      FacetCorner a = t.corners[f.first_corner + k];
      FacetCorner b = t.corners[f.first_corner + (k + 1) % f.corner_count];
      std::array<int, 3> step;
      for (std::size_t x = 0; x < 3; ++x) step[x] = b.image[x] - a.image[x];
      if (b.vertex < a.vertex || (a.vertex == b.vertex && step < std::array<int, 3>{})) {
        std::swap(a, b);
        for (int& x : step) x = -x;
      }
      edges.insert({a.vertex, b.vertex, step});
    }
  }
  return edges.size();
}

// V - E + F - C in space, V - E + F in the plane.
long euler(const Tessellation& t) {
  const auto v = static_cast<long>(t.vertices.size()), f = static_cast<long>(t.facets.size()),
             c = static_cast<long>(t.cells.size());
  return t.box.dimension == 2 ? v - f + c : v - static_cast<long>(edge_count(t)) + f - c;
}

// The owner of x by (1) over all sites and 27 images of each, and by how much it wins.
std::pair<int, double> nearest_owner(const Scene& scene, const Vec3& x) {
  std::map<int, double> least;
  for (const LaguerreSite& site : scene.sites) {
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        for (int k = -1; k <= 1; ++k) {
          const std::array<int, 3> m{i, j, k};
          bool exists = true;
          for (std::size_t a = 0; a < 3; ++a) exists &= m[a] == 0 || scene.box.periodic[a];
          if (!exists) continue;
          const Vec3 at = wrapped(scene.box, site.at) + image_shift(scene.box, m);
          const double power = norm_sq(x - at) - site.weight;
          const auto [slot, fresh] = least.try_emplace(site.owner, power);
          if (!fresh) slot->second = std::min(slot->second, power);
        }
      }
    }
  }
  std::pair<int, double> best{-1, 0.0};
  double first = 1e300, second = 1e300;
  for (const auto& [owner, power] : least) {
    if (power < first) {
      second = first;
      first = power;
      best.first = owner;
    } else {
      second = std::min(second, power);
    }
  }
  best.second = second - first;
  return best;
}

// Twice the solid angle over 4 pi (the winding number) of a cell about x; in 2D the angle over 2
// pi.
double winding(const Tessellation& t, const CellFacets& facets, std::size_t c, const Vec3& x) {
  double angle = 0.0;
  for (auto e = facets.first[c]; e < facets.first[c + 1]; ++e) {
    const auto [k, outer] = facets.entries[e];
    const Facet& f = t.facets[k];
    const Vec3 shift = x + (outer ? image_shift(t.box, f.image) : Vec3{});
    const auto at = [&](int n) { return position(t, t.corners[f.first_corner + n]) - shift; };
    const double sign = outer ? -1.0 : 1.0;
    if (t.box.dimension == 2) {
      const Vec3 a = at(0), b = at(1);
      angle += sign * std::atan2(a.x * b.y - a.y * b.x, dot(a, b)) / (2 * std::numbers::pi);
      continue;
    }
    for (int n = 2; n < f.corner_count; ++n) {
      // A. Van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125-126.
      const Vec3 a = at(0), b = at(n - 1), d = at(n);
      const double la = norm(a), lb = norm(b), ld = norm(d);
      angle += sign *
               std::atan2(dot(a, cross(b, d)),
                          la * lb * ld + dot(a, b) * ld + dot(a, d) * lb + dot(b, d) * la) /
               (2 * std::numbers::pi);
    }
  }
  return angle;
}

bool holds(const Tessellation& t, const CellFacets& facets, std::size_t c, const Vec3& x) {
  double sum = 0.0;
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      for (int k = -2; k <= 2; ++k) {
        const std::array<int, 3> m{i, j, k};
        bool exists = true;
        for (std::size_t a = 0; a < 3; ++a) exists &= m[a] == 0 || t.box.periodic[a];
        if (exists) sum += winding(t, facets, c, x + image_shift(t.box, m));
      }
    }
  }
  return std::lround(sum) == 1;
}

void check_owners(const Scene& scene, int samples, std::uint64_t seed) {
  const Tessellation t = diagram(scene);
  const CellFacets facets = facets_of_cells(t);
  RandomStream random(seed, StreamId::test, 1);
  for (int s = 0; s < samples; ++s) {
    const Vec3 x = random_place(scene.box, random);
    const auto [owner, margin] = nearest_owner(scene, x);
    if (margin < 1e-9) continue;
    for (std::size_t c = 0; c < t.cells.size(); ++c) {
      REQUIRE(holds(t, facets, c, x) == (static_cast<int>(c) == owner));
    }
  }
}

std::uint64_t hash_of(const Tessellation& t) {
  std::uint64_t hash = 1469598103934665603U;
  const auto add = [&](std::uint64_t bits) { hash = (hash ^ bits) * 1099511628211U; };
  for (const Vec3& v : t.vertices) {
    for (std::size_t a = 0; a < 3; ++a) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &v[a], sizeof bits);
      add(bits);
    }
  }
  for (const FacetCorner& c : t.corners) {
    add(static_cast<std::uint64_t>(c.vertex));
    for (const int m : c.image) add(static_cast<std::uint64_t>(m));
  }
  for (const Facet& f : t.facets) add(static_cast<std::uint64_t>(f.inner * 1000003 + f.outer));
  return hash;
}

}  // namespace

TEST_CASE("power cells fill the box and close, whatever axes are periodic") {
  for (const int dimension : {2, 3}) {
    for (int periodic = 0; periodic < 1 << dimension; ++periodic) {
      for (const int count : {1, 2, 3, 7, 40, 500}) {
        for (const double radius : {0.0, 0.5, 3.0}) {
          const Scene scene = scattered(dimension, periodic, count, radius, 7);
          const Tessellation t = diagram(scene);
          INFO(dimension << "D, periodic " << periodic << ", " << count << " sites");
          CHECK_NOTHROW(check_well_formed(t));
          CHECK(std::abs(total(t) / volume(t.box) - 1.0) < 1e-12);
        }
      }
      const Tessellation t = diagram(chains(dimension, periodic, 60, 9, 8));
      CHECK_NOTHROW(check_well_formed(t));
      CHECK(std::abs(total(t) / volume(t.box) - 1.0) < 1e-12);
    }
  }
}

TEST_CASE("a point belongs to the owner that is nearest in power, by brute force") {
  for (const int periodic : {0, 1, 3}) {
    check_owners(scattered(2, periodic, 60, 1.0, 11), 300, 12);
    check_owners(scattered(2, periodic, 3, 0.5, 11), 300, 12);
    check_owners(chains(2, periodic, 20, 7, 13), 300, 14);
  }
  for (const int periodic : {0, 4, 7}) {
    check_owners(scattered(3, periodic, 30, 1.0, 15), 15, 16);
    check_owners(scattered(3, periodic, 3, 0.5, 15), 40, 16);
    check_owners(chains(3, periodic, 6, 5, 17), 15, 18);
  }
}

TEST_CASE("as many vertices, edges and faces as Euler's formula wants") {
  for (const int dimension : {2, 3}) {
    const int all = (1 << dimension) - 1;
    for (const int periodic : {0, 1, all}) {
      const Tessellation t = diagram(scattered(dimension, periodic, 300, 0.3, 21));
      REQUIRE(std::all_of(t.cells.begin(), t.cells.end(),
                          [](const TessellationCell& c) { return c.parts == 1; }));
      // Of the torus 0, of what has a wall 1, or 0 where it is a ring.
      const long expected = periodic == 0 ? 1 : 0;
      CHECK(euler(t) == expected);
    }
  }
}

TEST_CASE("disjoint balls lie in their own cells") {
  for (const int dimension : {2, 3}) {
    Scene scene{box_of(dimension, 7), {}, {}};
    RandomStream random(31, StreamId::test, 0);
    for (int trial = 0; trial < 4000; ++trial) {
      const double r = random.uniform(0.005, 0.06);
      const Vec3 at = random_place(scene.box, random);
      const bool free =
          std::none_of(scene.sites.begin(), scene.sites.end(), [&](const LaguerreSite& other) {
            Vec3 d = other.at - at;
            for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
              d[a] -= scene.box.size[a] * std::round(d[a] / scene.box.size[a]);
            }
            return norm(d) < r + std::sqrt(other.weight);
          });
      if (!free) continue;
      scene.sites.push_back({at, r * r, static_cast<std::int32_t>(scene.owners.size())});
      add_owner(scene, at);
    }
    const Tessellation t = diagram(scene);
    const CellFacets facets = facets_of_cells(t);
    for (std::size_t c = 0; c < t.cells.size(); ++c) {
      REQUIRE(t.cells[c].parts == 1);
      for (auto e = facets.first[c]; e < facets.first[c + 1]; ++e) {
        const auto [k, outer] = facets.entries[e];
        const Facet& f = t.facets[k];
        const Vec3 shift = outer ? image_shift(t.box, f.image) : Vec3{};
        const auto at = [&](int n) { return position(t, t.corners[f.first_corner + n]) - shift; };
        const Vec3 along = at(1) - at(0);
        Vec3 normal = dimension == 2 ? Vec3{along.y, -along.x, 0} : Vec3{};
        for (int n = 2; n < f.corner_count; ++n) normal += cross(at(n - 1) - at(0), at(n) - at(0));
        if (norm(normal) < 1e-9) continue;
        const double sign = outer ? -1.0 : 1.0;
        const double distance = sign * dot(normalized(normal), at(0) - scene.sites[c].at);
        REQUIRE(distance >= std::sqrt(scene.sites[c].weight) - 1e-8);
      }
    }
  }
}

TEST_CASE("lattices: where many cells meet in one place there is one vertex") {
  Cell square = cell_2d(1, 1);
  const Tessellation squares = diagram(lattice(square, {30, 30, 1}, {{0.5, 0.5, 0}}));
  CHECK(squares.vertices.size() == 900);
  CHECK(squares.facets.size() == 1800);
  CHECK_NOTHROW(check_well_formed(squares));

  const Tessellation walled =
      diagram(lattice(cell_2d(1, 1, false, false), {30, 30, 1}, {{0.5, 0.5, 0}}));
  CHECK(walled.vertices.size() == 31 * 31);
  CHECK(walled.facets.size() == 2 * 30 * 31);

  // Disks in contact: 3 vertices a cell, as everywhere where no four cells meet.
  const Tessellation hexagons =
      diagram(lattice(cell_2d(1, std::sqrt(3.0)), {17, 17, 1}, {{0, 0, 0}, {0.5, 0.5, 0}}));
  CHECK(hexagons.vertices.size() == 2 * 2 * 17 * 17);
  CHECK(hexagons.facets.size() == 3 * 2 * 17 * 17);

  const Cell cube;
  const Tessellation cubes = diagram(lattice(cube, {7, 7, 7}, {{0, 0, 0}}));
  CHECK(cubes.vertices.size() == 343);
  CHECK(cubes.facets.size() == 3 * 343);

  // Rhombic dodecahedra: 8 vertices shared by 4 and 6 shared by 6, 12 faces.
  const Tessellation fcc =
      diagram(lattice(cube, {5, 5, 5}, {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}));
  CHECK(fcc.vertices.size() == 3 * 500);
  CHECK(fcc.facets.size() == 6 * 500);

  // Truncated octahedra.
  const Tessellation bcc = diagram(lattice(cube, {6, 6, 6}, {{0, 0, 0}, {0.5, 0.5, 0.5}}));
  CHECK(bcc.vertices.size() == 6 * 432);
  CHECK(bcc.facets.size() == 7 * 432);
  for (const Tessellation& t : {cubes, fcc, bcc}) {
    CHECK_NOTHROW(check_well_formed(t));
    CHECK(euler(t) == 0);
    for (const CellShape& shape : cell_shapes(t)) {
      CHECK(shape.measure == Approx(1.0 / static_cast<double>(t.cells.size())));
      CHECK(shape.aspect == Approx(1.0));
    }
  }
}

TEST_CASE("lattices shaken by less than, about and more than what counts as one place") {
  RandomStream random(41, StreamId::test, 0);
  for (const int dimension : {2, 3}) {
    for (double shake = 1e-16; shake < 1e-5; shake *= 10.0) {
      Cell box = dimension == 2 ? cell_2d(1, 1) : Cell{};
      const int n = dimension == 2 ? 20 : 6;
      Scene scene = lattice(box, {n, n, dimension == 2 ? 1 : n}, {{0.5, 0.5, 0.5}});
      for (LaguerreSite& site : scene.sites) {
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
          site.at[a] += shake * random.uniform(-1, 1);
        }
        if (dimension == 2) site.at.z = 0.0;
      }
      const Tessellation t = diagram(scene);
      INFO(dimension << "D, " << shake << ", open " << open_ridges(t));
      CHECK_NOTHROW(check_well_formed(t));
      CHECK(std::abs(total(t) - 1.0) < 1e-12);
    }
  }
}

TEST_CASE("a hidden site has an empty cell, and of equal sites in one place the first has it") {
  for (const int dimension : {2, 3}) {
    Scene scene = scattered(dimension, 7, 30, 0.3, 51);
    scene.sites.push_back({scene.sites[4].at + Vec3{0.01, 0, 0}, scene.sites[4].weight - 1.0, 30});
    add_owner(scene, scene.sites[4].at);
    scene.sites.push_back({scene.sites[5].at, scene.sites[5].weight, 31});
    add_owner(scene, scene.sites[5].at);
    const Tessellation t = diagram(scene);
    CHECK_NOTHROW(check_well_formed(t));
    CHECK(t.cells[30].parts == 0);
    CHECK(t.cells[31].parts == 0);
    CHECK(t.cells[5].parts == 1);
    CHECK(cell_shapes(t)[30].measure == 0.0);
    CHECK(std::abs(total(t) / volume(t.box) - 1.0) < 1e-12);
  }
}

TEST_CASE("one site in a periodic box meets its own images only") {
  Scene scene{cell_2d(2, 1), {{{0.3, 0.2, 0}, 0.1, 0}}, {{{0.3, 0.2, 0}, 0, 1}}};
  const auto contacts = cell_contacts(diagram(scene));
  REQUIRE(contacts.size() == 2);
  CHECK(contacts[0].image == std::array<int, 3>{0, 1, 0});
  CHECK(contacts[0].measure == Approx(2.0));
  CHECK(contacts[1].image == std::array<int, 3>{1, 0, 0});
  CHECK(contacts[1].measure == Approx(1.0));
  const CellShape shape = cell_shapes(diagram(scene))[0];
  CHECK(shape.centroid.x == Approx(0.3));
  CHECK(shape.aspect == Approx(2.0));
}

TEST_CASE("two sites in a periodic box meet each other on both sides") {
  Scene scene{cell_2d(1, 1), {{{0.25, 0.5, 0}, 0, 0}, {{0.75, 0.5, 0}, 0, 1}}, {}};
  for (const LaguerreSite& site : scene.sites) add_owner(scene, site.at);
  const auto contacts = cell_contacts(diagram(scene));
  REQUIRE(contacts.size() == 4);
  CHECK(contacts[1].b == 1);
  CHECK(contacts[1].image == std::array<int, 3>{-1, 0, 0});
  CHECK(contacts[2].image == std::array<int, 3>{0, 0, 0});
  CHECK(contacts[1].measure == Approx(1.0));
}

TEST_CASE("an owner whose sites go around the box has one cell that meets itself") {
  Scene scene{cell_2d(1, 1), {}, {{{0, 0.25, 0}, 0, 1}, {{0, 0.75, 0}, 0, 1}}};
  for (int k = 0; k < 10; ++k) {
    scene.sites.push_back({{0.1 * k, 0.25, 0}, 0.0, 0});
    scene.sites.push_back({{0.1 * k, 0.75, 0}, 0.0, 1});
  }
  const Tessellation t = diagram(scene);
  CHECK_NOTHROW(check_well_formed(t));
  CHECK(t.cells[0].parts == 1);
  const auto contacts = cell_contacts(t);
  CHECK(contacts[0].a == 0);
  CHECK(contacts[0].b == 0);
  CHECK(contacts[0].image == std::array<int, 3>{1, 0, 0});
  CHECK(cell_shapes(t)[0].measure == Approx(0.5));
}

TEST_CASE("the cell of an owner may be in parts") {
  Scene scene{cell_2d(1, 1, false, false), {}, {{{0, 0, 0}, 0, 1}, {{0.5, 0.5, 0}, 0, 1}}};
  scene.sites = {{{0.1, 0.5, 0}, 0, 0}, {{0.5, 0.5, 0}, 0, 1}, {{0.9, 0.5, 0}, 0, 0}};
  const Tessellation t = diagram(scene);
  CHECK(t.cells[0].parts == 2);
  CHECK(t.cells[1].parts == 1);
  CHECK(cell_shapes(t)[0].measure == Approx(0.6));
}

TEST_CASE("facets between sites of one owner vanish, their measures add up") {
  for (const int dimension : {2, 3}) {
    const Scene merged = chains(dimension, 7, 40, 6, 61);
    Scene apart = merged;
    apart.owners.clear();
    for (std::size_t i = 0; i < apart.sites.size(); ++i) {
      apart.sites[i].owner = static_cast<std::int32_t>(i);
      add_owner(apart, apart.sites[i].at);
    }
    const auto whole = cell_shapes(diagram(merged)), pieces = cell_shapes(diagram(apart));
    for (std::size_t g = 0; g < whole.size(); ++g) {
      double measure = 0.0;
      Vec3 first;
      for (std::size_t k = 6 * g; k < 6 * g + 6; ++k) {
        measure += pieces[k].measure;
        first += pieces[k].measure * pieces[k].centroid;
      }
      CHECK(whole[g].measure == Approx(measure).epsilon(1e-11));
      CHECK(norm(whole[g].centroid - first / measure) < 1e-9);
    }
  }
}

TEST_CASE("a diagram moves with its sites, and one number more in all weights changes nothing") {
  for (const int dimension : {2, 3}) {
    const Scene scene = chains(dimension, 7, 40, 6, 71);
    Scene moved = scene;
    const Vec3 shift{3.21, -0.77, dimension == 3 ? 0.4 : 0.0};
    for (LaguerreSite& site : moved.sites) {
      site.at += shift;
      site.weight += 0.3;
    }
    const Tessellation a = diagram(scene), b = diagram(moved);
    const auto before = cell_shapes(a), after = cell_shapes(b);
    for (std::size_t c = 0; c < before.size(); ++c) {
      CHECK(after[c].measure == Approx(before[c].measure).epsilon(1e-10));
      CHECK(norm(after[c].centroid - before[c].centroid - shift) < 1e-10);
    }
    CHECK(a.facets.size() == b.facets.size());
    CHECK(a.vertices.size() == b.vertices.size());
  }
}

TEST_CASE("sites may stand beyond walls") {
  for (const int dimension : {2, 3}) {
    Scene scene = scattered(dimension, 0, 100, 0.5, 81);
    for (std::size_t i = 0; i < 30; ++i) scene.sites[i].at.x -= 0.3;
    for (std::size_t i = 30; i < 60; ++i) scene.sites[i].at.y += 0.2;
    const Tessellation t = diagram(scene);
    CHECK_NOTHROW(check_well_formed(t));
    CHECK(std::abs(total(t) / volume(t.box) - 1.0) < 1e-12);
    check_owners(scene, dimension == 2 ? 200 : 10, 82);
  }
}

TEST_CASE("power_diagram gives the same bits for any number of threads") {
  for (const int dimension : {2, 3}) {
    const Scene scene = chains(dimension, 3, 300, 5, 91);
    const std::uint64_t one = hash_of(diagram(scene, 1));
    CHECK(hash_of(diagram(scene, 2)) == one);
    CHECK(hash_of(diagram(scene, 3)) == one);
  }
}

TEST_CASE("power_diagram refuses what is no diagram") {
  const Scene scene = scattered(2, 3, 3, 0.5, 1);
  CHECK_THROWS_AS(power_diagram(scene.box, {}, scene.owners), InvalidArgument);
  Scene bad = scene;
  bad.sites[1].owner = 3;
  CHECK_THROWS_AS(diagram(bad), InvalidArgument);
  bad = scene;
  bad.sites[2].weight = std::nan("");
  CHECK_THROWS_AS(diagram(bad), InvalidArgument);
  bad = scene;
  bad.box.size.x = -1;
  CHECK_THROWS_AS(diagram(bad), InvalidArgument);
}
