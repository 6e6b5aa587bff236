#pragma once

/// @file
/// "Compute all roots numerically": the sign changes between equal samples, one after another.

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
#include <optional>

#include "packstone/geometry/published_ellipsoid_contact.hpp"

namespace packstone::published {

/// Where roots are looked for, and which count.
struct RootSearch {
  double from = 0.0;
  double to = 0.0;  ///< > from.
  int samples = 1;  ///< >= 1.
  PublishedForm parting_roots = PublishedForm::corrected;
};

/// A place and the value there.
struct Sample {
  double at = 0.0;
  double value = 0.0;
};

/// The lower end of a bracket of one root, about two units in the last place wide. Between
/// samples of opposite signs.
template <class F>
double refined_root(const F& f, const Sample& left, const Sample& right) {
  constexpr std::uintmax_t kMostSteps = 200;
  std::uintmax_t steps = kMostSteps;
  const boost::math::tools::eps_tolerance<double> tolerance;
  return boost::math::tools::toms748_solve(f, left.at, right.at, left.value, right.value, tolerance,
                                           steps)
      .first;
}

/// The first of first + width / 2^k, k = 1, 2, ... where f is above 0, as it is not at `first`: a
/// pair that touches has parted there. `first` again where there is none.
template <class F>
Sample sample_after_parting(const F& f, const Sample& first, double width) {
  constexpr int kMostHalvings = 40;
  for (int k = 0; k < kMostHalvings; ++k) {
    width *= 0.5;
    const Sample nearer{first.at + width, f(first.at + width)};
    if (nearer.value > 0.0) return nearer;
  }
  return first;
}

/// The first root of f that accept() takes.
template <class F, class Accept>
std::optional<double> first_root(const F& f, const RootSearch& search, const Accept& accept) {
  const bool falling_only = search.parting_roots == PublishedForm::corrected;
  const double width = search.to - search.from;
  Sample left{search.from, f(search.from)};
  if (falling_only && !(left.value > 0.0)) {
    left = sample_after_parting(f, left, width / search.samples);
  }
  for (int k = 1; k <= search.samples; ++k) {
    const double at = k == search.samples ? search.to : search.from + width * k / search.samples;
    const Sample right{at, f(at)};
    const bool falls = left.value > 0.0 && !(right.value > 0.0);
    const bool rises = !(left.value > 0.0) && right.value > 0.0;
    if (falls || (rises && !falling_only)) {
      const double root = refined_root(f, left, right);
      if (accept(root)) return root;
    }
    left = right;
  }
  return std::nullopt;
}

}  // namespace packstone::published
