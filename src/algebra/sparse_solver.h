// Complex sparse linear systems, solved by Eigen's SparseLU, which is compiled once, in
// sparse_solver.cpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>
#include <memory>

namespace whirl_twin {

using ComplexSparseMatrix = Eigen::SparseMatrix<std::complex<double>>;

/// Solves one system after another: the order of elimination is computed again only where other
/// entries are zero.
class SparseSolver {
 public:
  SparseSolver();
  ~SparseSolver();
  SparseSolver(SparseSolver&&) noexcept;
  SparseSolver& operator=(SparseSolver&&) noexcept;

  /// a^-1 b; NaN of a singular matrix. [n x n], [n]
  Eigen::VectorXcd solve(const ComplexSparseMatrix& a, const Eigen::VectorXcd& b);

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace whirl_twin
