#include "packstone/geometry/published_ellipsoid_contact.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "packstone/core/mat.hpp"
#include "packstone/core/random.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/ellipsoid_contact.hpp"
#include "support/validation_seed.hpp"

namespace packstone {
namespace {

struct EllipsoidPair {
  Ellipsoid a, b;
  Vec3 r;
};

struct Shape {
  const char* name;
  Vec3 semi_axes;
};

constexpr Shape kShapes[] = {
    {"2 prolate", {2, 1, 1}},   {"2 oblate", {2, 2, 1}},    {"5 prolate", {5, 1, 1}},
    {"5 oblate", {5, 5, 1}},    {"10 prolate", {10, 1, 1}}, {"10 oblate", {10, 10, 1}},
    {"40 prolate", {40, 1, 1}}, {"40 oblate", {40, 40, 1}}, {"1 : 0.5 : 0.2", {5, 2.5, 1}}};

// In a random direction, as far apart as touching bodies would be if they were `factor` as large.
Vec3 separation(RandomStream& random, const Ellipsoid& a, const Ellipsoid& b, double factor) {
  const Vec3 d = random_direction(random);
  return (factor / contact_scale(a, b, d).lower) * d;
}

// Two bodies of one shape, turned at random. `factor`: see separation().
EllipsoidPair equal_pair(RandomStream& random, const Vec3& semi_axes, double factor) {
  const Ellipsoid a{semi_axes, random_rotation(random)}, b{semi_axes, random_rotation(random)};
  return {a, b, separation(random, a, b, factor)};
}

// Two bodies of different shapes with aspects up to 10.
EllipsoidPair random_pair(RandomStream& random, double factor) {
  const auto body = [&] {
    const auto length = [&] { return std::pow(10.0, random.uniform(-0.5, 0.5)); };
    return Ellipsoid{{length(), length(), length()}, random_rotation(random)};
  };
  const Ellipsoid a = body(), b = body();
  return {a, b, separation(random, a, b, factor)};
}

using Matrix4 = std::array<std::array<long double, 4>, 4>;

// M^-T diag(1/a^2, 1/b^2, 1/c^2, -1) M^-1, equation (7b), in absolute coordinates.
Matrix4 homogeneous(const Ellipsoid& body, const Vec3& center) {
  const Mat3 r = to_matrix(body.orientation);
  Matrix4 m{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 axis = k == 0 ? r.col_x : k == 1 ? r.col_y : r.col_z;
    const long double weight = 1.0L / body.semi_axes[k] / body.semi_axes[k];
    const std::array<long double, 4> row{
        axis.x, axis.y, axis.z,
        -1.0L * axis.x * center.x - 1.0L * axis.y * center.y - 1.0L * axis.z * center.z};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) m[i][j] += weight * row[i] * row[j];
    }
  }
  m[3][3] -= 1.0L;
  return m;
}

// By elimination with pivots.
long double determinant(Matrix4 m) {
  long double product = 1.0L;
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i) {
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    }
    if (pivot != k) {
      std::swap(m[pivot], m[k]);
      product = -product;
    }
    product *= m[k][k];
    for (std::size_t i = k + 1; i < 4; ++i) {
      const long double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < 4; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  return product;
}

long double determinant_at(const Matrix4& a, const Matrix4& b, long double lambda) {
  Matrix4 m{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) m[i][j] = lambda * a[i][j] + b[i][j];
  }
  return determinant(m);
}

// p_1 (l - l_1) (l - l_2) (l - l_3) (l - l_4).
PublishedQuartic with_roots(double p_1, const std::array<double, 4>& roots) {
  PublishedQuartic p{p_1, 0, 0, 0, 0};
  for (std::size_t degree = 0; degree < 4; ++degree) {
    for (std::size_t k = degree + 1; k > 0; --k) p[k] -= roots[degree] * p[k - 1];
  }
  return p;
}

TEST_CASE("the quartic of algorithm 3 is the determinant that it stands for") {
  RandomStream random(41, StreamId::test);
  for (int i = 0; i < 500; ++i) {
    const EllipsoidPair pair = random_pair(random, random.uniform(0.01, 2.0));
    const Vec3 center = 3.0 * random_direction(random);
    const Matrix4 a = homogeneous(pair.a, center), b = homogeneous(pair.b, center + pair.r);
    const PublishedQuartic p = published_quartic(pair.a, pair.b, pair.r);
    for (const double lambda : {-3.0, -0.2, 0.1, 1.0, 7.0}) {
      long double value = 0.0L, size = 0.0L;
      for (const double p_k : p) {
        value = lambda * value + p_k;
        size = std::abs(lambda) * size + std::abs(p_k);
      }
      // Some ten roundings of each entry, and the rotations' own.
      CHECK(static_cast<double>(std::abs(value - determinant_at(a, b, lambda)) / size) < 1e-13);
    }
    // The fifth coefficient is the determinant of the second matrix, not of the first.
    CHECK(p[4] == Approx(static_cast<double>(determinant(b))));
    CHECK(p[4] != Approx(static_cast<double>(determinant(a))));
  }
}

TEST_CASE("eta_1 is the discriminant, whatever the roots") {
  RandomStream random(42, StreamId::test);
  for (int i = 0; i < 1000; ++i) {
    std::array<double, 4> roots{};
    for (double& root : roots) root = random.uniform(-2.0, 2.0);
    double discriminant = 1.0;
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < j; ++k) discriminant *= std::pow(roots[j] - roots[k], 2);
    }
    const PublishedEtas eta = published_etas(with_roots(random.uniform(-3.0, -0.3), roots));
    CHECK(eta.eta_1 == Approx(discriminant / 256.0).margin(1e-12));
    // Four real roots: what case 2 asks for, wherever they lie.
    CHECK(eta.eta_2 > 0.0);
    CHECK(eta.eta_5 > 0.0);
  }
}

TEST_CASE("a double root is read off eta_2 and eta_3, and cases 3 and 4 are positive ones") {
  RandomStream random(43, StreamId::test);
  for (int i = 0; i < 1000; ++i) {
    // Roots of the other sign well apart, so that eta_2 is not zero up to rounding.
    const double root = random.uniform(0.5, 2.0), q = random.uniform(0.5, 2.0), r = q + 0.3;
    const PublishedEtas generic = published_etas(with_roots(-1.0, {root, root, -q, -r}));
    CHECK(-3.0 * generic.eta_3 / generic.eta_2 == Approx(root).epsilon(1e-6));
    CHECK(published_touching(generic));
    // The same with all signs turned: the double root is negative, and Table 1 says so.
    CHECK_FALSE(published_touching(published_etas(with_roots(-1.0, {-root, -root, q, r}))));
    // Two double roots. Only the negative of what is printed as eta_4 is below 0.
    const PublishedEtas two = published_etas(with_roots(-1.0, {root, root, -q, -q}));
    CHECK(std::abs(two.eta_2) <= 1e-14 * two.eta_2_size);
    CHECK(two.eta_4 == Approx(-0.25 * root * q * (root + q) * (root + q)));
    CHECK(published_touching(two));
  }
}

TEST_CASE("four negative roots pass for separate as printed, and do not as corrected") {
  const PublishedQuartic deep = with_roots(-1.0, {-1, -2, -3, -4});
  CHECK(published_relation(deep, PublishedForm::printed) == PublishedRelation::separate);
  CHECK(published_relation(deep, PublishedForm::corrected) == PublishedRelation::overlapping);
  const PublishedQuartic apart = with_roots(-1.0, {1, 2, -3, -4});
  CHECK(published_relation(apart, PublishedForm::printed) == PublishedRelation::separate);
  CHECK(published_relation(apart, PublishedForm::corrected) == PublishedRelation::separate);
  const PublishedQuartic touching = with_roots(-1.0, {2, 2, -1, -4});
  CHECK(published_relation(touching, PublishedForm::corrected) == PublishedRelation::tangent);
  // Case 1 has the same gap: a double negative root beside two others, positive or negative.
  const PublishedQuartic double_apart = with_roots(-1.0, {1, 4, -2, -2});
  const PublishedQuartic double_deep = with_roots(-1.0, {-1, -4, -2, -2});
  for (const PublishedForm form : {PublishedForm::printed, PublishedForm::corrected}) {
    CHECK(published_relation(double_apart, form) == PublishedRelation::separate);
  }
  CHECK(published_relation(double_deep, PublishedForm::printed) == PublishedRelation::separate);
  CHECK(published_relation(double_deep, PublishedForm::corrected) ==
        PublishedRelation::overlapping);
  // Concentric bodies with different axes could not overlap more.
  const Ellipsoid a{{3, 2, 1}, {}}, b{{1, 2.5, 1.5}, {}};
  CHECK(published_relation(a, b, {}, PublishedForm::printed) == PublishedRelation::separate);
  CHECK(published_relation(a, b, {}, PublishedForm::corrected) == PublishedRelation::overlapping);
  CHECK(overlap(a, b, {}) == Verdict::overlapping);
}

struct Judged {
  int overlapping = 0, separated = 0;
  std::array<int, 2> overlaps_called_separate{};
  int separated_called_overlapping = 0;
  double deepest_root = 0.0;  // Largest factor, see separation(), of an overlap called separate.

  double percent(PublishedForm form) const {
    return 100.0 * overlaps_called_separate[static_cast<std::size_t>(form)] /
           std::max(1, overlapping);
  }
};

// Random pairs as far apart as 0.01 to 1.5 of touching; the truth is the verdict of decide().
Judged judge(const Vec3& semi_axes, int pairs, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test, static_cast<std::uint64_t>(semi_axes.x),
                      static_cast<std::uint64_t>(semi_axes.y));
  Judged judged;
  for (int i = 0; i < pairs; ++i) {
    const double factor = random.uniform(0.01, 1.5);
    const EllipsoidPair pair = equal_pair(random, semi_axes, factor);
    const Verdict truth = overlap(pair.a, pair.b, pair.r);
    if (truth == Verdict::undecided) continue;
    ++(truth == Verdict::overlapping ? judged.overlapping : judged.separated);
    for (const PublishedForm form : {PublishedForm::printed, PublishedForm::corrected}) {
      const bool apart =
          published_relation(pair.a, pair.b, pair.r, form) == PublishedRelation::separate;
      if (truth == Verdict::separated) {
        judged.separated_called_overlapping += !apart;
      } else if (apart) {
        ++judged.overlaps_called_separate[static_cast<std::size_t>(form)];
        judged.deepest_root = std::max(judged.deepest_root, factor);
      }
    }
  }
  return judged;
}

// Pairs within 1 % of touching whose neighborhoods, 1.2 times as large, are called separate: the
// share, in percent, of collisions that Algorithm 6 does not look for.
double skipped_percent(const Vec3& semi_axes, PublishedForm form, int pairs, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test, static_cast<std::uint64_t>(semi_axes.x),
                      static_cast<std::uint64_t>(semi_axes.y));
  int skipped = 0;
  for (int i = 0; i < pairs; ++i) {
    EllipsoidPair pair = equal_pair(random, semi_axes, random.uniform(1.0, 1.01));
    pair.a.semi_axes *= 1.2;
    pair.b.semi_axes *= 1.2;
    skipped += published_relation(pair.a, pair.b, pair.r, form) == PublishedRelation::separate;
  }
  return 100.0 * skipped / pairs;
}

TEST_CASE("the printed table calls overlapping pairs separate, the corrected one none") {
  for (const Shape& shape : kShapes) {
    CAPTURE(shape.name);
    const Judged judged = judge(shape.semi_axes, 3000, 44);
    CHECK(judged.overlapping > 1500);
    CHECK(judged.separated > 800);
    CHECK(judged.percent(PublishedForm::printed) > 0.2);
    CHECK(judged.percent(PublishedForm::corrected) == 0.0);
    CHECK(judged.separated_called_overlapping == 0);
  }
}

TEST_CASE("the neighborhoods of long and flat pairs about to touch pass for separate") {
  for (const Shape& shape : kShapes) {
    CAPTURE(shape.name);
    const double printed = skipped_percent(shape.semi_axes, PublishedForm::printed, 2000, 45);
    if (shape.semi_axes.x >= 10.0) CHECK(printed > 1.0);
    if (shape.semi_axes.x <= 2.0) CHECK(printed == 0.0);
    CHECK(skipped_percent(shape.semi_axes, PublishedForm::corrected, 2000, 45) == 0.0);
  }
}

TEST_CASE("table of overlaps that the published table calls separate", "[validation]") {
  std::printf("| shape | called separate %% | corrected | up to | neighborhoods separate %% |\n");
  for (const Shape& shape : kShapes) {
    const Judged judged = judge(shape.semi_axes, 200'000, validation_seed(46));
    const double skipped =
        skipped_percent(shape.semi_axes, PublishedForm::printed, 200'000, validation_seed(47));
    std::printf("| %s | %.2f | %d | %.3f | %.2f |\n", shape.name,
                judged.percent(PublishedForm::printed), judged.overlaps_called_separate[1],
                judged.deepest_root, skipped);
    CHECK(judged.percent(PublishedForm::printed) > 0.2);
    CHECK(judged.overlaps_called_separate[1] == 0);
    CHECK(judged.separated_called_overlapping == 0);
  }
}

// Percent of pairs just apart and just overlapping, by the factor 1 +- delta, that Table 1 calls
// the other way. decide() is never wrong about them.
struct Wrong {
  double published = 0.0;
  int proven = 0;
};

template <class Draw>
Wrong wrong_next_to_touching(const Draw& draw, double delta, int pairs, std::uint64_t seed) {
  RandomStream random(seed, StreamId::test);
  int published = 0, proven = 0;
  for (int i = 0; i < pairs; ++i) {
    const bool apart = i % 2 == 0;
    const EllipsoidPair pair = draw(random, apart ? 1.0 + delta : 1.0 - delta);
    published += apart != (published_relation(pair.a, pair.b, pair.r, PublishedForm::corrected) ==
                           PublishedRelation::separate);
    proven +=
        overlap(pair.a, pair.b, pair.r) != (apart ? Verdict::separated : Verdict::overlapping);
  }
  return {100.0 * published / pairs, proven};
}

// Equal bodies whose axes are turned against each other by `tilt`.
EllipsoidPair tilted_pair(RandomStream& random, double aspect, double tilt, double factor) {
  const Ellipsoid a{{aspect, 1, 1}, random_rotation(random)};
  const Quaternion turn = from_axis_angle(random_direction(random), tilt);
  const Ellipsoid b{a.semi_axes, normalized(turn * a.orientation)};
  return {a, b, separation(random, a, b, factor)};
}

auto spheroids(double aspect) {
  return [aspect](RandomStream& random, double factor) {
    return equal_pair(random, {aspect, 1, 1}, factor);
  };
}

auto tilted(double aspect, double tilt) {
  return [aspect, tilt](RandomStream& random, double factor) {
    return tilted_pair(random, aspect, tilt, factor);
  };
}

TEST_CASE("rounding decides about spheres and equal bodies with parallel axes, at any gap") {
  for (const double delta : {1e-1, 1e-4, 1e-8}) {
    CAPTURE(delta);
    for (const Wrong& wrong : {wrong_next_to_touching(spheroids(1.0), delta, 1000, 48),
                               wrong_next_to_touching(tilted(5.0, 0.0), delta, 1000, 49)}) {
      CHECK(wrong.published > 10.0);
      CHECK(wrong.proven == 0);
    }
  }
}

TEST_CASE("the discriminant loses digits near spheres and near parallel axes, not elsewhere") {
  const Wrong near_sphere = wrong_next_to_touching(spheroids(1.0001), 1e-10, 1000, 50);
  CHECK(near_sphere.published > 20.0);
  CHECK(near_sphere.proven == 0);
  const Wrong near_parallel = wrong_next_to_touching(tilted(5.0, 1e-5), 1e-8, 1000, 51);
  CHECK(near_parallel.published > 5.0);
  CHECK(near_parallel.proven == 0);
  for (const double aspect : {1.1, 2.0, 10.0}) {
    CAPTURE(aspect);
    CHECK(wrong_next_to_touching(spheroids(aspect), 1e-8, 1000, 52).published == 0.0);
  }
}

TEST_CASE("table of wrong verdicts next to touching", "[validation]") {
  const auto row = [](const char* label, const auto& draw) {
    std::printf("| %s |", label);
    int proven = 0;
    for (const double delta : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
      const Wrong wrong = wrong_next_to_touching(draw, delta, 20'000, validation_seed(53));
      std::printf(" %.2f |", wrong.published);
      proven += delta > 1e-11 ? wrong.proven : 0;
    }
    std::printf("\n");
    CHECK(proven == 0);
  };
  row("sphere", spheroids(1.0));
  row("1 : 1.00001", spheroids(1.00001));
  row("1 : 1.001", spheroids(1.001));
  row("2 prolate", spheroids(2.0));
  row("10 prolate", spheroids(10.0));
  row("40 prolate", spheroids(40.0));
  row("5 prolate, parallel", tilted(5.0, 0.0));
  row("5 prolate, axes tilted by 1e-5", tilted(5.0, 1e-5));
}

TEST_CASE("touching bodies touch where the published null vector says") {
  RandomStream random(54, StreamId::test);
  for (int i = 0; i < 500; ++i) {
    const EllipsoidPair pair = random_pair(random, 1.0);
    const PublishedTouch touch = published_touch(pair.a, pair.b, pair.r);
    const Gap truth = gap(pair.a, pair.b, pair.r);
    CHECK(norm(touch.point - truth.point_a) < 1e-5 * norm(pair.r));
    CHECK(norm(touch.normal - truth.normal) < 1e-5);
    const PublishedEtas eta = published_etas(published_quartic(pair.a, pair.b, pair.r));
    CHECK(touch.root == Approx(-3.0 * eta.eta_3 / eta.eta_2).epsilon(1e-3));
    CHECK(published_touching(eta));
  }
}

}  // namespace
}  // namespace packstone
