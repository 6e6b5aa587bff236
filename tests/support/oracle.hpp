#pragma once

/// @file
/// Judges of pair kernels that share no code with them: support functions and membership in long
/// double, a derivative-free search for the gap, and libccd.

#include <cstdint>

#include "packstone/geometry/contact.hpp"

namespace packstone::oracle {

/// g(d / |d|), equation (1) of contact.hpp, in long double [L].
long double gap_along(const Body& a, const Body& b, const Vec3& r, const Vec3& d);

/// max over |d| = 1 of g(d) as found by `starts` searches with random steps, in long double [L].
/// Never above the true gap; below it when every search ends in a worse maximum.
long double search_gap(const Body& a, const Body& b, const Vec3& r, int starts, std::uint64_t seed,
                       const Vec3* hint = nullptr);

/// S(d), equation (1) of support.hpp, in long double [L].
long double support(const Body& body, const Vec3& d);

/// Gauge of the body at x: the factor that scales its surface through x [-]. In the body: <= 1.
long double gauge(const Body& body, const Vec3& x);

/// Is the certificate of a decision good? undecided counts as good.
bool certified(const Body& a, const Body& b, const Vec3& r, double min_gap,
               const Decision& decision);

/// libccd's answer; it errs near touching.
bool ccd_overlap(const Body& a, const Body& b, const Vec3& r);

}  // namespace packstone::oracle
