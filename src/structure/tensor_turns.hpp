#pragma once

/// @file
/// How turns of axes change the mean of u u^T: the linear algebra of exact_tensor.hpp.
///
/// With P = 1 - u u^T and B_a the orthonormal (Mandel) basis of the symmetric matrices, an axis
/// that moves by P S u, S = sum s_a B_a, changes its u u^T by sum_b 2 s_b (P B_a u).(P B_b u) along
/// B_a.

#include <array>

#include "packstone/core/mat.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

using Vec6 = std::array<double, 6>;
using Mat6 = std::array<Vec6, 6>;

/// Components of a symmetric matrix in the basis B_a, and the matrix of such components.
[[nodiscard]] Vec6 components(const SymMat3& a);
[[nodiscard]] SymMat3 from_components(const Vec6& s);

/// P B_a u for the six B_a.
[[nodiscard]] std::array<Vec3, 6> basis_turns(const Vec3& u);

/// Adds weight (P B_a u).(P B_b u) to the lower triangle of `sum`.
void add_products(const std::array<Vec3, 6>& turns, double weight, Mat6& sum);

/// A sum of products, made symmetric and fit to be solved: a weight on the trace, which no turn
/// changes, and a floor on the diagonal, which settles what no axis has a component in.
[[nodiscard]] Mat6 made_definite(Mat6 sum);

/// Solves g x = right by L D L^T without pivots; g is positive definite.
[[nodiscard]] Vec6 solve(Mat6 g, Vec6 right);

}  // namespace packstone
