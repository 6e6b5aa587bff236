#pragma once

/// @file
/// Moves unit vectors a little so that their second moment is exactly a given one.

#include <vector>

#include "packstone/core/vec.hpp"

namespace packstone {

/// Moves `axes` so that <u u^T> = diag(target): target descending, >= 0, of sum 1; components of
/// `axes` where target is 0 are 0, and stay so. The number of axes is at least that of the entries
/// of target that are > 0.
///
/// Gauss-Newton with the smallest turns. With P_i = 1 - u_i u_i^T and B_a an orthonormal basis of
/// the symmetric matrices, the map u -> (1 + S) u / |(1 + S) u|, S = sum s_a B_a, changes the
/// tensor by G s to first order,
///   (1)  G_ab = (2 / N) sum_i (P_i B_a u_i) . (P_i B_b u_i),
/// and S is the solution of G s = (target - <u u^T>)_a. A linear map followed by normalization
/// takes an angular central Gaussian law to another, so that a sample stays a sample of that
/// family. 3 to 6 iterations. Where they do not converge (a handful of axes) exact_axes() takes
/// over.
void make_exact(std::vector<Vec3>& axes, const Vec3& target);

/// The construction behind it, for any number of axes: the rows of the 3 x N matrix of axes are
/// made orthogonal with norms sqrt(N target), then rotations of two columns each, which keep
/// sum u u^T, bring one column after the other to length 1. I. S. Dhillon, R. W. Heath, M. A.
/// Sustik, J. A. Tropp, SIAM J. Matrix Anal. Appl. 27 (2005) 61-71.
[[nodiscard]] std::vector<Vec3> exact_axes(const std::vector<Vec3>& start, const Vec3& target);

}  // namespace packstone
