// A dense matrix made to be multiplied by a vector once a step: the whole cost of an exact linear
// step.
//
// Its rows lie in panels of sixteen, each read once from end to end; columns that are zero at the
// start of a panel are left out, so that a triangle costs half. On x86-64 the loop is compiled
// for several vector widths and the machine's own is taken at start; products and sums are made one
// by one in the order of the columns, never fused, so that every machine gives the same bits.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace whirl_twin {

class PackedMatrix {
 public:
  static constexpr Eigen::Index kPanel = 16;  ///< rows

  PackedMatrix() = default;
  explicit PackedMatrix(const Eigen::MatrixXd& matrix);

  Eigen::Index rows() const { return rows_; }  ///< of the result: a whole number of panels
  Eigen::Index columns() const { return columns_; }

  /// result[0 .. rows()) = M y, zero beyond the matrix' own rows. Real-time safe.
  void multiply(const double* y, double* result) const noexcept;

 private:
  Eigen::Index rows_ = 0;
  Eigen::Index columns_ = 0;
  std::vector<Eigen::Index> first_;  // column of each panel that is not zero
  Eigen::VectorXd entries_;          // Eigen aligns it
};

}  // namespace whirl_twin
