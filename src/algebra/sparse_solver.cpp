#include "algebra/sparse_solver.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <vector>

#include "algebra/constants.h"

namespace whirl_twin {

struct SparseSolver::Factors {
  Eigen::SparseLU<ComplexSparseMatrix> lu;
  std::vector<int> columns, rows;  // of the entries that the order of elimination is for

  bool isFor(const ComplexSparseMatrix& a) const {
    return a.outerSize() + 1 == static_cast<Eigen::Index>(columns.size()) &&
           a.nonZeros() == static_cast<Eigen::Index>(rows.size()) &&
           std::equal(columns.begin(), columns.end(), a.outerIndexPtr()) &&
           std::equal(rows.begin(), rows.end(), a.innerIndexPtr());
  }
};

SparseSolver::SparseSolver() : factors_(std::make_unique<Factors>()) {}
SparseSolver::~SparseSolver() = default;
SparseSolver::SparseSolver(SparseSolver&&) noexcept = default;
SparseSolver& SparseSolver::operator=(SparseSolver&&) noexcept = default;

Eigen::VectorXcd SparseSolver::solve(const ComplexSparseMatrix& a, const Eigen::VectorXcd& b) {
  if (!factors_->isFor(a)) {
    factors_->lu.analyzePattern(a);
    factors_->columns.assign(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1);
    factors_->rows.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  }
  factors_->lu.factorize(a);
  if (factors_->lu.info() != Eigen::Success) {
    return Eigen::VectorXcd::Constant(b.size(), std::complex<double>(kNaN, 0.0));
  }
  return factors_->lu.solve(b);
}

}  // namespace whirl_twin
