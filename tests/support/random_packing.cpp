#include "support/random_packing.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include "packstone/core/random.hpp"
#include "scenes.hpp"
#include "support/random_body.hpp"

namespace packstone::test {
namespace {

// Over many powers of ten, so that short and long decimals and exponents all occur.
double random_length(RandomStream& random) { return std::pow(10.0, random.uniform(-12.0, 12.0)); }

Certificate random_certificate(RandomStream& random) {
  Certificate c;
  c.count = static_cast<std::int64_t>(random.bits() >> 1);
  c.fraction = random.uniform();
  c.groups = {{"first", 3, random.uniform()}, {"nothing", 0, 0.0}};
  c.min_gap = random.uniform();
  c.smallest_gap = random.below(4) == 0 ? INFINITY : random.uniform(-1.0, 1.0);
  c.smallest_gap_error = 1e-16 * random.uniform();
  c.worst_pair = {static_cast<std::int64_t>(random.below(100)), -1};
  c.worst_image = {-1, 0, 2};
  c.overlaps = static_cast<std::int64_t>(random.below(3));
  c.gaps_below = static_cast<std::int64_t>(random.below(3));
  c.outside_walls = static_cast<std::int64_t>(random.below(3));
  c.pairs_checked = static_cast<std::int64_t>(random.bits() >> 1);
  return c;
}

Provenance random_provenance(RandomStream& random) {
  Provenance p;
  p.method = "rsa";
  p.stop = "target_reached \"quoted\" \\ \n \u00e4\u03b2\U0001F600";
  p.version = "0.1.0";
  p.seed = random.bits();
  p.seconds = random.uniform();
  p.recipe_json = R"({"zeta":{"size":[1,1.5,-0.0,1e-300]},"alpha":[true,null,"x",[],{}]})";
  return p;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

Packing random_packing(int dimension, int count, std::uint64_t seed,
                       std::optional<ShapeKind> shape) {
  RandomStream random(seed, StreamId::test);
  Packing packing;
  const Vec3 size{random.uniform(0.1, 10.0), random.uniform(0.1, 10.0), random.uniform(0.1, 10.0)};
  packing.cell = dimension == 2 ? cell_2d(size.x, size.y, random.below(2) == 0)
                                : Cell{3, size, {true, random.below(2) == 0, false}};
  packing.groups = {"first", "nothing", "with \"quotes\", commas and \u00fc"};
  for (int i = 0; i < count; ++i) {
    Inclusion inclusion;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
      inclusion.center[axis] = random.uniform() * packing.cell.size[axis];
    }
    inclusion.body = random_body(shape ? *shape : random_shape(dimension, random), random,
                                 [&] { return random_length(random); });
    inclusion.group = random.below(2) == 0 ? 0 : 2;
    packing.inclusions.push_back(inclusion);
  }
  packing.certificate = random_certificate(random);
  packing.provenance = random_provenance(random);
  return packing;
}

bool same_bits(const Packing& a, const Packing& b) {
  // == confuses 0.0 and -0.0; the hash of the inclusions does not.
  return a.cell == b.cell && a.groups == b.groups && a.inclusions == b.inclusions &&
         scenes::state_hash(a) == scenes::state_hash(b) && a.certificate == b.certificate &&
         a.provenance == b.provenance &&
         (!a.certificate || same_bits(a.certificate->smallest_gap, b.certificate->smallest_gap));
}

}  // namespace packstone::test
