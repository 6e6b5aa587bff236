#pragma once

/// @file
/// Eigenvalues and eigenvectors of a symmetric 3x3 matrix.

#include "packstone/core/mat.hpp"
#include "packstone/core/vec.hpp"

namespace packstone {

/// A = rotated_diagonal(vectors, values).
struct SymmetricEigen {
  Vec3 values;   ///< Descending.
  Mat3 vectors;  ///< Columns: unit eigenvectors in the order of `values`, a right-handed frame.
};

/// By cyclic Jacobi rotations (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed. 2013,
/// section 8.5). Error of A = V diag(values) V^T below 1e-15 |A|. Entries that are 0 stay 0: the
/// eigenvectors of a diagonal matrix are coordinate axes exactly, up to sign.
[[nodiscard]] SymmetricEigen symmetric_eigen(const SymMat3& a) noexcept;

}  // namespace packstone
