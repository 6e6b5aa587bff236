#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "packstone/core/parallel.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "support/oracle.hpp"
#include "support/pair_zoo.hpp"
#include "support/validation_seed.hpp"

using namespace packstone;
using zoo::Pair;
using zoo::PairClass;
using zoo::Zoo;

namespace {

// What judging the decisions on many pairs has counted.
struct Tally {
  long pairs = 0;
  long separated = 0;
  long overlapping = 0;
  long undecided = 0;
  long uncertified = 0;          // certificate refused by the oracle
  long undecided_untouched = 0;  // undecided, yet farther from touching than 1e-12 of the size
  long ccd_differs = 0;
};

// Touching within 1e-12 of the size is where a decision may stay open. A search from the best
// direction nearly always shows it; on the ridges of nearly parallel cylinders it stops early, and
// starts again from the normal of the gap. Any start will do: g is evaluated in long double.
bool nearly_touching(const Pair& p, const Decision& decision) {
  const long double limit = 1e-12L * zoo::size_of(p);
  const Vec3 normal = gap(p.a, p.b, p.r).normal;
  return std::abs(oracle::search_gap(p.a, p.b, p.r, 1, 1, &decision.witness)) <= limit ||
         std::abs(oracle::search_gap(p.a, p.b, p.r, 40, 2, &normal)) <= limit;
}

// libccd errs where bodies nearly touch, so it is asked about the classes that are not tangent.
bool ccd_may_judge(PairClass pair_class) {
  return pair_class < PairClass::concentric || pair_class == PairClass::far;
}

void judge(const Pair& p, bool ask_ccd, Tally& tally) {
  const Decision decision = decide(p.a, p.b, p.r);
  ++tally.pairs;
  tally.separated += decision.verdict == Verdict::separated;
  tally.overlapping += decision.verdict == Verdict::overlapping;
  if (!oracle::certified(p.a, p.b, p.r, 0.0, decision)) ++tally.uncertified;
  if (decision.verdict == Verdict::undecided) {
    ++tally.undecided;
    if (!nearly_touching(p, decision)) ++tally.undecided_untouched;
  } else if (ask_ccd) {
    const bool overlapping = decision.verdict == Verdict::overlapping;
    const bool ccd = oracle::ccd_overlap(p.a, p.b, p.r);
    if (ccd == overlapping) return;
    const long double gap = oracle::search_gap(p.a, p.b, p.r, 4, 2);
    if (std::abs(gap) > 1e-3L * zoo::size_of(p)) ++tally.ccd_differs;
  }
}

Tally judge_class(ShapeKind a, ShapeKind b, PairClass pair_class, long count, std::uint64_t seed) {
  Zoo zoo(seed + 1000 * static_cast<int>(pair_class) + 100 * static_cast<int>(a) +
          10 * static_cast<int>(b));
  Tally tally;
  for (long i = 0; i < count; ++i) {
    judge(zoo.pair(a, b, pair_class), ccd_may_judge(pair_class) && i % 64 == 0, tally);
  }
  return tally;
}

void require_clean(const Tally& tally) {
  CHECK(tally.uncertified == 0);
  CHECK(tally.undecided_untouched == 0);
  CHECK(tally.ccd_differs == 0);
}

// One class of one kind of pair: as much as a thread takes at a time.
struct Job {
  ShapeKind a, b;
  PairClass pair_class;
  Tally tally;
};

void print(const Job& job) {
  const Tally& t = job.tally;
  std::printf(
      "%-14s %-14s %-11s pairs %8ld sep %8ld over %8ld undecided %6ld (%ld) refused %ld ccd %ld\n",
      std::string(name(job.a)).c_str(), std::string(name(job.b)).c_str(),
      std::string(zoo::name(job.pair_class)).c_str(), t.pairs, t.separated, t.overlapping,
      t.undecided, t.undecided_untouched, t.uncertified, t.ccd_differs);
}

std::vector<Job> all_jobs() {
  std::vector<Job> jobs;
  for (const auto& [a, b] : zoo::kinds_of_pairs()) {
    for (int i = 0; i < zoo::kPairClasses; ++i)
      jobs.push_back({a, b, static_cast<PairClass>(i), {}});
  }
  return jobs;
}

}  // namespace

TEST_CASE("decide has no false verdict on a hundred thousand pairs of each kind") {
  for (const auto& [a, b] : zoo::kinds_of_pairs()) {
    for (int i = 0; i < zoo::kPairClasses; ++i) {
      const auto pair_class = static_cast<PairClass>(i);
      CAPTURE(name(a), name(b), zoo::name(pair_class));
      const Tally tally = judge_class(a, b, pair_class, 100'000 / zoo::kPairClasses, 1);
      require_clean(tally);
      // Classes that should hold both verdicts do.
      if (pair_class >= PairClass::tangent_2 || pair_class == PairClass::near) {
        CHECK(tally.separated > 0);
        CHECK(tally.overlapping > 0);
      }
    }
  }
}

TEST_CASE("validation: decide has no false verdict on ten million pairs of each kind",
          "[validation]") {
  const char* count_text = std::getenv("PACKSTONE_PAIRS");
  const long count = (count_text ? std::atol(count_text) : 10'000'000) / zoo::kPairClasses;
  const std::uint64_t seed = validation_seed(77);
  std::vector<Job> jobs = all_jobs();
  const auto run = [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      Job& job = jobs[static_cast<std::size_t>(i)];
      job.tally = judge_class(job.a, job.b, job.pair_class, count, seed);
    }
  };
  parallel_for(static_cast<std::int64_t>(jobs.size()), 0, 1, run);
  for (const Job& job : jobs) {
    print(job);
    require_clean(job.tally);
  }
}
