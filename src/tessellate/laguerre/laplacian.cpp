#include "tessellate/laguerre/laplacian.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstddef>

namespace packstone::laguerre {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

// Relative residual of conjugate gradients: Newton's method sees to the rest.
constexpr double kResidual = 1e-10;

// Without the row and column of the first owner.
Matrix pinned_laplacian(const std::vector<Coupling>& couplings, std::size_t owners) {
  std::vector<double> diagonal(owners, 0.0);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * couplings.size() + owners);
  for (const Coupling& c : couplings) {
    diagonal[static_cast<std::size_t>(c.a)] += c.value;
    diagonal[static_cast<std::size_t>(c.b)] += c.value;
    if (c.a == 0) continue;
    entries.emplace_back(c.a - 1, c.b - 1, -c.value);
    entries.emplace_back(c.b - 1, c.a - 1, -c.value);
  }
  for (std::size_t k = 1; k < owners; ++k) {
    const double own = diagonal[k] > 0.0 ? diagonal[k] : 1.0;
    entries.emplace_back(static_cast<int>(k) - 1, static_cast<int>(k) - 1, own);
  }
  Matrix matrix(static_cast<int>(owners) - 1, static_cast<int>(owners) - 1);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class Solver>
bool solve(Solver& solver, const Matrix& matrix, const Eigen::VectorXd& right, Eigen::VectorXd& x) {
  solver.compute(matrix);
  if (solver.info() != Eigen::Success) return false;
  x = solver.solve(right);
  return solver.info() == Eigen::Success && x.allFinite();
}

}  // namespace

std::vector<double> solve_laplacian(const std::vector<Coupling>& couplings,
                                    const std::vector<double>& right, int dimension) {
  const std::size_t owners = right.size();
  std::vector<double> x(owners, 0.0);
  if (owners < 2) return x;
  const Matrix matrix = pinned_laplacian(couplings, owners);
  const Eigen::Map<const Eigen::VectorXd> rest(right.data() + 1,
                                               static_cast<Eigen::Index>(owners) - 1);
  Eigen::VectorXd solution;
  bool solved = false;
  if (dimension == 3) {
    Eigen::ConjugateGradient<Matrix, Eigen::Lower, Eigen::IncompleteCholesky<double>> gradients;
    gradients.setTolerance(kResidual);
    solved = solve(gradients, matrix, rest, solution);
  }
  if (!solved) {
    Eigen::SimplicialLDLT<Matrix> cholesky;
    solved = solve(cholesky, matrix, rest, solution);
  }
  if (!solved) return {};
  Eigen::Map<Eigen::VectorXd>(x.data() + 1, static_cast<Eigen::Index>(owners) - 1) = solution;
  return x;
}

}  // namespace packstone::laguerre
