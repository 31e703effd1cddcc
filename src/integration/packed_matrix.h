// A dense matrix packed for matrix-vector products, the main cost of an exact linear step.
//
// Its rows lie in panels of sixteen, each read once sequentially; columns that are zero throughout
// a panel are omitted, so that a triangular matrix costs half, and zero blocks nothing. On x86-64
// the loop is compiled for several vector widths (simd_vector.h) and the width of the processor is
// used; processors with fused multiply-add differ from others in the last bits.
#pragma once

#include <Eigen/Core>
#include <boost/align/aligned_allocator.hpp>
#include <cstddef>
#include <vector>

namespace whirl_twin {

class PackedMatrix {
 public:
  static constexpr Eigen::Index kPanel = 16;  ///< rows

  static constexpr std::size_t kTogether = 5;

  /// Adjacent columns of a panel.
  struct Run {
    Eigen::Index first;
    Eigen::Index end;
  };
  struct Panel {
    Eigen::Index start;      ///< of its entries
    Eigen::Index first_run;  ///< of its runs
    Eigen::Index runs;
  };

  PackedMatrix() = default;
  explicit PackedMatrix(const Eigen::MatrixXd& matrix);

  Eigen::Index rows() const { return rows_; }  ///< of the result: a whole number of panels
  Eigen::Index columns() const { return columns_; }

  /// result[0 .. rows()) = M y, zero beyond the matrix' own rows. Real-time safe.
  void multiply(const double* y, double* result) noexcept;
  /// The same of kTogether vectors, whose numbers lie side by side, one of each at a time, as do
  /// those of the results: entries are read once for all of them.
  void multiplyTogether(const double* y, double* result) noexcept;

 private:
  Eigen::Index rows_ = 0;
  Eigen::Index columns_ = 0;
  std::vector<Panel> panels_;
  std::vector<Run> runs_;
  bool backward_ = false;  ///< every other time: what was read last is still in the cache
  /// At the start of a cache line: a load of eight that straddles two costs twice.
  std::vector<double, boost::alignment::aligned_allocator<double, 64>> entries_;
};

/// The increments' rows and below them, for the work y^T W y of symmetric W, those of the upper
/// triangle U with y^T U y = y^T W y.
Eigen::MatrixXd stackedStep(const Eigen::MatrixXd& increment, const Eigen::MatrixXd& work);

/// The same as the matrix of a step.
PackedMatrix stepMatrix(const Eigen::MatrixXd& increment, const Eigen::MatrixXd& work);

}  // namespace whirl_twin
