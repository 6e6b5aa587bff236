#include "packstone/structure/distribution.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "packstone/core/error.hpp"
#include "structure/tabulated_law.hpp"
#include "structure/truncated_normal.hpp"

namespace packstone {
namespace {

using Density = std::function<double(double)>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The oracle: the distribution function of a density on [lo, hi] by Simpson's rule on a fine grid,
// linear in between.
class SimpsonCdf {
 public:
  SimpsonCdf(const Density& density, double lo, double hi, int panels = 40'000)
      : lo_(lo), step_((hi - lo) / panels), sums_{0.0} {
    for (int i = 0; i < panels; ++i) {
      const double x = lo_ + i * step_;
      sums_.push_back(sums_.back() +
                      step_ / 6.0 *
                          (density(x) + 4.0 * density(x + 0.5 * step_) + density(x + step_)));
    }
  }
  double operator()(double x) const {
    const double place = std::clamp((x - lo_) / step_, 0.0, static_cast<double>(sums_.size() - 1));
    const auto i = std::min(static_cast<std::size_t>(place), sums_.size() - 2);
    const double part = place - static_cast<double>(i);
    return (sums_[i] + part * (sums_[i + 1] - sums_[i])) / sums_.back();
  }

 private:
  double lo_, step_;
  std::vector<double> sums_;
};

double kolmogorov_distance(std::vector<double> values, const Density& cdf) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double p = cdf(values[i]);
    const auto k = static_cast<double>(i);
    worst = std::max({worst, std::abs(p - k / n), std::abs((k + 1.0) / n - p)});
  }
  return worst;
}

constexpr int kCount = 40'000;

// P(D > 2.2 / sqrt(n)) = 1.2e-4; seeds are fixed.
const double kKolmogorovBound = 2.2 / std::sqrt(kCount);

std::vector<double> values_of(const Distribution& law, int power = 3, int count = kCount) {
  return draw(law, count, 42, StreamId::test, 7, power);
}

struct LawCase {
  const char* name;
  Distribution law;
  Density density;
  double lo, hi;
};

double normal_density(double x, double mean, double std) {
  const double z = (x - mean) / std;
  return std::exp(-0.5 * z * z);
}

double lognormal_density(double x, double mu, double sigma) {
  return x <= 0.0 ? 0.0 : normal_density(std::log(x), mu, sigma) / x;
}

double weibull_density(double x, double shape, double scale) {
  return std::pow(x / scale, shape - 1.0) * std::exp(-std::pow(x / scale, shape));
}

std::vector<LawCase> law_cases() {
  return {
      {"uniform", {UniformLaw{0.5, 2.0}}, [](double) { return 1.0; }, 0.5, 2.0},
      {"normal",
       {NormalLaw{1.0, 0.3, 0.2, 3.0}},
       [](double x) { return normal_density(x, 1.0, 0.3); },
       0.2,
       3.0},
      {"normal cut in the upper tail",
       {NormalLaw{1.0, 0.3, 1.5, 1.8}},
       [](double x) { return normal_density(x, 1.0, 0.3); },
       1.5,
       1.8},
      {"normal cut in the far lower tail",
       {NormalLaw{10.0, 0.3, 0.1, 1.0}},
       // Scaled by exp of its largest exponent, so as not to underflow.
       [](double x) { return std::exp(-0.5 * (x - 1.0) * (x + 1.0 - 20.0) / 0.09); },
       0.1,
       1.0},
      {"log-normal",
       {LognormalLaw{-0.2, 0.5, 0.1, 5.0}},
       [](double x) { return lognormal_density(x, -0.2, 0.5); },
       0.1,
       5.0},
      {"log-normal without bounds",
       {LognormalLaw{0.0, 0.3}},
       [](double x) { return lognormal_density(x, 0.0, 0.3); },
       0.05,
       8.0},
      {"Weibull",
       {WeibullLaw{2.5, 1.2, 0.3, 3.0}},
       [](double x) { return weibull_density(x, 2.5, 1.2); },
       0.3,
       3.0},
      {"Weibull of falling density",
       {WeibullLaw{0.7, 1.0, 0.2, 6.0}},
       [](double x) { return weibull_density(x, 0.7, 1.0); },
       0.2,
       6.0},
  };
}

TEST_CASE("values by number follow the density, truncation included") {
  for (const LawCase& c : law_cases()) {
    INFO(c.name);
    const auto values = values_of(c.law);
    CHECK(kolmogorov_distance(values, SimpsonCdf(c.density, c.lo, c.hi)) < kKolmogorovBound);
    for (double x : values) REQUIRE((x >= c.lo && x <= c.hi));
  }
}

TEST_CASE("values by volume follow the density over the power of the size") {
  for (const LawCase& c : law_cases()) {
    for (int power : {1, 2, 3}) {
      INFO(c.name << ", power " << power);
      Distribution law = c.law;
      law.by = Weighting::volume;
      const SimpsonCdf cdf([&](double x) { return c.density(x) / std::pow(x, power); }, c.lo, c.hi);
      CHECK(kolmogorov_distance(values_of(law, power), cdf) < kKolmogorovBound);
    }
  }
}

TEST_CASE("with by = volume the volume-weighted histogram is that of the law") {
  for (const LawCase& c : law_cases()) {
    INFO(c.name);
    Distribution law = c.law;
    law.by = Weighting::volume;
    const auto values = values_of(law);
    const SimpsonCdf cdf(c.density, c.lo, c.hi);
    double total = 0.0, square = 0.0;
    for (double x : values) {
      total += x * x * x;
      square += std::pow(x, 6);
    }
    for (int bin = 1; bin < 8; ++bin) {
      const double edge = c.lo + (c.hi - c.lo) * bin / 8.0;
      double below = 0.0;
      for (double x : values) below += x <= edge ? x * x * x : 0.0;
      // A share of weights has a variance below sum w^2 / (sum w)^2; five of its roots.
      CHECK(std::abs(below / total - cdf(edge)) < 5.0 * std::sqrt(square) / total);
    }
  }
}

TEST_CASE("a table gives its values in the proportion of their weights") {
  const TableLaw table{{1.0, 2.0, 4.0, 9.0}, {1.0, 3.0, 4.0, 0.0}};
  for (Weighting by : {Weighting::number, Weighting::volume}) {
    const auto values = values_of({table, by});
    std::vector<double> weight(4);
    double total = 0.0;
    for (double x : values) {
      const auto place = std::find(table.values.begin(), table.values.end(), x);
      REQUIRE(place != table.values.end());
      const double w = by == Weighting::volume ? x * x * x : 1.0;
      weight[static_cast<std::size_t>(place - table.values.begin())] += w;
      total += w;
    }
    CHECK(weight[3] == 0.0);
    // The rarest by number is 4 in the case by volume: 1 % of 40 000, so 5 % are one sigma.
    const double tolerance = by == Weighting::number ? 0.0125 : 0.25 * 0.5;
    for (int i = 0; i < 3; ++i) {
      CHECK(std::abs(weight[static_cast<std::size_t>(i)] / total - table.weights[i] / 8.0) <
            tolerance);
    }
  }
}

TEST_CASE("a mixture by number gives each part its share of the inclusions") {
  const MixtureLaw mixture{{{UniformLaw{1, 2}}, {ConstantLaw{5}}, {NormalLaw{10, 0.1, 9, 11}}},
                           {0.5, 0.3, 0.2}};
  const auto values = values_of({mixture});
  const auto share = [&](double lo, double hi) {
    return static_cast<double>(std::count_if(values.begin(), values.end(),
                                             [=](double x) { return x >= lo && x <= hi; })) /
           kCount;
  };
  CHECK(std::abs(share(1, 2) - 0.5) < 0.0125);
  CHECK(std::abs(share(5, 5) - 0.3) < 0.0125);
  CHECK(std::abs(share(9, 11) - 0.2) < 0.0125);
}

TEST_CASE("a mixture by volume gives each part its share of the volume") {
  const MixtureLaw inner{{{ConstantLaw{1.5}}, {UniformLaw{1.8, 2.0}}}, {1.0, 1.0}};
  const MixtureLaw mixture{{{UniformLaw{1.0, 1.2}},
                            {inner},
                            {LognormalLaw{std::log(3.0), 0.05, 2.5, 4.0}},
                            {WeibullLaw{8.0, 5.0, 4.5, 6.0}},
                            {NormalLaw{7.0, 0.2, 6.5, 8.0}}},
                           {0.3, 0.2, 0.2, 0.2, 0.1}};
  const auto values = values_of({mixture, Weighting::volume}, 3, 4 * kCount);
  double total = 0.0;
  for (double x : values) total += x * x * x;
  const auto share = [&](double lo, double hi) {
    double sum = 0.0;
    for (double x : values) sum += x >= lo && x <= hi ? x * x * x : 0.0;
    return sum / total;
  };
  // The largest part is 0.1 x 1.4 / 343 / <x^-3> = 1e-3 by number, 170 values: 8 % are one sigma.
  CHECK(std::abs(share(1.0, 1.2) - 0.3) < 0.015);
  CHECK(std::abs(share(1.5, 1.5) - 0.1) < 0.01);
  CHECK(std::abs(share(1.8, 2.0) - 0.1) < 0.01);
  CHECK(std::abs(share(2.5, 4.0) - 0.2) < 0.02);
  CHECK(std::abs(share(4.5, 6.0) - 0.2) < 0.03);
  CHECK(std::abs(share(6.5, 8.0) - 0.1) < 0.03);
}

TEST_CASE("a value depends on seed, stream, group and item, and on nothing else") {
  const Distribution law{LognormalLaw{0, 0.5}};
  const auto all = draw(law, 20, 1, StreamId::sizes, 3);
  const auto tail = draw(law, 5, 1, StreamId::sizes, 3, 3, 15);
  CHECK(std::equal(tail.begin(), tail.end(), all.begin() + 15));
  CHECK(draw(law, 1, 2, StreamId::sizes, 3).front() != all.front());
  CHECK(draw(law, 1, 1, StreamId::aspects, 3).front() != all.front());
  CHECK(draw(law, 1, 1, StreamId::sizes, 4).front() != all.front());
}

// The truncated normal quantile against an integral that knows nothing of erfc: with s = x - lo,
// the density is exp(-s (s + 2 lo) / 2).
TEST_CASE("the truncated normal law is exact in the body, in far tails and in narrow slits") {
  struct Interval {
    double lo, hi;
  };
  const Interval intervals[] = {{-1, 2},           {-6, 0.5},  {4.9, 5.5},     {5.1, 9},
                                {5.5, 5.51},       {20, 21},   {37, 60},       {40, 40.00005},
                                {300, 400},        {1e4, 2e4}, {0.3, 0.30005}, {-0.00002, 0.00002},
                                {1e3, 1e3 + 1e-5}, {2.0, 2.5}};
  for (const Interval& i : intervals) {
    INFO(i.lo << " to " << i.hi);
    const double reach = std::min(i.hi - i.lo, i.lo > 5.0 ? 45.0 / i.lo : 20.0);
    const SimpsonCdf cdf([&](double s) { return std::exp(-0.5 * s * (s + 2.0 * i.lo)); }, 0.0,
                         reach);
    const TruncatedNormal law(i.lo, i.hi), mirrored(-i.hi, -i.lo);
    for (double u : {1e-3, 0.1, 0.5, 0.9, 0.999}) {
      // The grid is linear in between: error up to (reach / 40 000)^2 |f'| / 8.
      CHECK(cdf(law.quantile(u) - i.lo) == Approx(u).epsilon(0).margin(2e-7));
      CHECK(mirrored.quantile(1.0 - u) == Approx(-law.quantile(u)).epsilon(1e-12));
    }
    CHECK(law.quantile(0x1p-53) >= i.lo);
    CHECK(law.quantile(1 - 0x1p-53) <= i.hi);
  }
}

TEST_CASE("the probability of an interval is the same however it is cut") {
  const auto mass = [](double lo, double hi) { return TruncatedNormal(lo, hi).log_mass(); };
  CHECK(mass(-kInfinity, kInfinity) == Approx(0.0).margin(1e-15));
  CHECK(mass(-1, 1) == Approx(std::log(0.68268949213708585)).epsilon(1e-13));
  // log(erfc(40 / sqrt(2)) / 2), computed with 30 digits.
  CHECK(mass(40, kInfinity) == Approx(-804.608442013753788).epsilon(1e-12));
  for (double lo : {-30.0, -3.0, 0.2, 4.99, 6.0, 50.0}) {
    double parts = 0.0;
    const double width = 1.0 / 16384.0;  // below 1e-4: the narrow way
    const double whole = mass(lo, lo + 64 * width);
    for (int i = 0; i < 64; ++i)
      parts += std::exp(mass(lo + i * width, lo + (i + 1) * width) - whole);
    // The narrow way is off by width^2 / 24 of the curvature: 1e-9 at most.
    CHECK(parts == Approx(1.0).epsilon(1e-8));
    CHECK(mass(-lo - 64 * width, -lo) == Approx(whole).epsilon(1e-12));
  }
}

TEST_CASE("a tabulated law inverts its own integral, wherever the density lives") {
  // Density x^-4: P(X < x) = (1 - x^-3) / (1 - 1000^-3) over nine decades of density.
  const TabulatedLaw power([](double x) { return -4.0 * std::log(x); }, {1.0, 1000.0});
  for (double u : {1e-12, 1e-3, 0.5, 0.999, 1.0 - 1e-6}) {
    const double x = std::pow(1.0 - u * (1.0 - 1e-9), -1.0 / 3.0);
    CHECK(power.quantile(u) == Approx(x).epsilon(1e-9));
  }
  CHECK(power.log_integral() == Approx(std::log((1.0 - 1e-9) / 3.0)).epsilon(1e-12));
  // A peak of width 1e-5 that the first panels step over.
  const TabulatedLaw peak([](double x) { return -0.5 * std::pow((x - 1.2345) / 1e-5, 2); },
                          {1.0, 1.2344, 1.2346, 2.0});
  CHECK(peak.quantile(0.5) == Approx(1.2345).epsilon(1e-11));
  CHECK(peak.log_integral() ==
        Approx(std::log(1e-5 * std::sqrt(2 * std::acos(-1.0)))).epsilon(1e-10));
}

TEST_CASE("a log-normal law from its moments has these moments") {
  const auto values = values_of({lognormal_from_moments(2.0, 0.8)}, 3, 4 * kCount);
  double mean = 0.0, square = 0.0;
  for (double x : values) mean += x / (4 * kCount);
  for (double x : values) square += (x - mean) * (x - mean) / (4 * kCount);
  CHECK(mean == Approx(2.0).epsilon(5 * 0.4 / std::sqrt(4 * kCount)));
  CHECK(std::sqrt(square) == Approx(0.8).epsilon(0.02));
  CHECK_THROWS_AS(lognormal_from_moments(0.0, 1.0), InvalidArgument);
  CHECK_THROWS_AS(lognormal_from_moments(1.0, -1.0), InvalidArgument);
}

TEST_CASE("the support is what can be drawn") {
  const auto range = [](const Distribution& law) { return support_of(law); };
  CHECK(range({ConstantLaw{3}}).min == 3.0);
  CHECK(range({UniformLaw{1, 2}}).max == Approx(2.0));
  CHECK(range({NormalLaw{1.0, 0.1}}).min > 0.17);
  CHECK(range({NormalLaw{1.0, 0.2}}).min < 0.0);
  CHECK(range({NormalLaw{1.0, 0.2, 0.5, 1.5}}).min == Approx(0.5));
  CHECK(range({LognormalLaw{0, 1}}).min > 0.0);
  CHECK(range({LognormalLaw{0, 1}}).max < 5000.0);
  CHECK(range({TableLaw{{-1, 1, 2}, {0, 1, 1}}}).min == 1.0);
  const MixtureLaw mixture{{{ConstantLaw{1}}, {ConstantLaw{9}}, {UniformLaw{2, 3}}}, {1, 0, 1}};
  CHECK(range({mixture}).min == 1.0);
  CHECK(range({mixture}).max == Approx(3.0));
}

TEST_CASE("laws without width give their one value") {
  for (Weighting by : {Weighting::number, Weighting::volume}) {
    CHECK(values_of({UniformLaw{2, 2}, by}, 3, 1).front() == 2.0);
    CHECK(values_of({NormalLaw{2, 0, 1, 3}, by}, 3, 1).front() == 2.0);
    CHECK(values_of({NormalLaw{2, 1, 1.5, 1.5}, by}, 3, 1).front() == 1.5);
    CHECK(values_of({LognormalLaw{0, 0}, by}, 3, 1).front() == 1.0);
    CHECK(values_of({LognormalLaw{0, 1, 3, 3}, by}, 3, 1).front() == 3.0);
    CHECK(values_of({WeibullLaw{2, 1, 0.4, 0.4}, by}, 3, 1).front() == 0.4);
  }
}

TEST_CASE("laws that are none are refused with the parameter, its value and its range") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const Distribution& law, const char* message) {
    CHECK_THROWS_AS(check_distribution(law, "size"), InvalidArgument);
    CHECK_THROWS_WITH(check_distribution(law, "size"), Catch::Contains(message));
  };
  refused({ConstantLaw{nan}}, "size = nan");
  refused({UniformLaw{2, 1}}, "size.uniform[0] = 2, allowed are numbers <= uniform[1] = 1");
  refused({NormalLaw{1, -0.5}}, "size.std = -0.5, allowed are finite numbers >= 0");
  refused({NormalLaw{1, 1, 3, 2}}, "size.min = 3, allowed are numbers <= max = 2");
  refused({NormalLaw{1, 0, 2, 3}}, "outside its bounds min = 2 and max = 3");
  refused({LognormalLaw{0, -1}}, "size.sigma = -1");
  refused({LognormalLaw{0, 1, -2, -1}}, "size.max = -1, allowed are finite numbers > 0");
  refused({WeibullLaw{0, 1}}, "size.shape = 0");
  refused({WeibullLaw{1, -1}}, "size.scale = -1");
  refused({TableLaw{{1, 2}, {1}}}, "2 entries and 1 weights");
  refused({TableLaw{}}, "at least one");
  refused({TableLaw{{1, 2}, {1, -1}}}, "size.table.weight[1] = -1");
  refused({TableLaw{{1, 2}, {0, 0}}}, "sum of weights = 0");
  refused({MixtureLaw{{{UniformLaw{2, 1}}}, {1}}}, "size.mixture[0].uniform[0] = 2");
  refused({MixtureLaw{}}, "at least one");
  refused({UniformLaw{0, 1}, Weighting::volume},
          "size.uniform[0] = 0, allowed are numbers > 0 when");
  refused({NormalLaw{1, 0.1}, Weighting::volume}, "size.min = -1e+300");
  refused({WeibullLaw{2, 1}, Weighting::volume}, "size.min = 0");
  refused({TableLaw{{0, 1}, {1, 1}}, Weighting::volume}, "size.table.value[0] = 0");
  refused({MixtureLaw{{{UniformLaw{0, 1}}}, {1}}, Weighting::volume}, "size.mixture[0].uniform[0]");
  CHECK_THROWS_AS(draw({UniformLaw{2, 1}}, 1, 1, StreamId::test, 0), InvalidArgument);
}

TEST_CASE("only a constant law is constant") {
  CHECK(is_constant({ConstantLaw{}}));
  CHECK_FALSE(is_constant({UniformLaw{1, 1}}));
}

}  // namespace
}  // namespace packstone
