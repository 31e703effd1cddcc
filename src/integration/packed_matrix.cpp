#include "integration/packed_matrix.h"

#include "integration/vector_widths.h"

namespace whirl_twin {

namespace {

using Eigen::Index;

/// Eight doubles; narrower machines take them in parts.
typedef double Eight __attribute__((vector_size(64)));
/// Eight doubles that may lie anywhere.
typedef double EightAnywhere __attribute__((vector_size(64), aligned(8)));

WHIRL_TWIN_VECTOR_WIDTHS
void multiplyPanels(const double* entries, const PackedMatrix::Panel* panels, Index count,
                    bool backward, Index columns, const double* y, double* result) noexcept {
  for (Index p = 0; p < count; ++p) {
    const Index panel = backward ? count - 1 - p : p;
    const double* entry = entries + panels[panel].start;
    // Four columns at a time: eight sums under way.
    Eight low[4] = {};
    Eight high[4] = {};
    Index j = panels[panel].first_column;
    for (; j + 3 < columns; j += 4, entry += 4 * PackedMatrix::kPanel) {
      for (int k = 0; k < 4; ++k) {
        low[k] += *reinterpret_cast<const Eight*>(entry + PackedMatrix::kPanel * k) * y[j + k];
        high[k] += *reinterpret_cast<const Eight*>(entry + PackedMatrix::kPanel * k + 8) * y[j + k];
      }
    }
    for (; j < columns; ++j, entry += PackedMatrix::kPanel) {
      low[0] += *reinterpret_cast<const Eight*>(entry) * y[j];
      high[0] += *reinterpret_cast<const Eight*>(entry + 8) * y[j];
    }
    double* const sums = result + panel * PackedMatrix::kPanel;
    *reinterpret_cast<EightAnywhere*>(sums) = (low[0] + low[1]) + (low[2] + low[3]);
    *reinterpret_cast<EightAnywhere*>(sums + 8) = (high[0] + high[1]) + (high[2] + high[3]);
  }
}

}  // namespace

PackedMatrix::PackedMatrix(const Eigen::MatrixXd& matrix)
    : rows_((matrix.rows() + kPanel - 1) / kPanel * kPanel), columns_(matrix.cols()) {
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(rows_, columns_);
  padded.topRows(matrix.rows()) = matrix;
  entries_.resize(static_cast<std::size_t>(rows_ * columns_));
  std::size_t size = 0;
  for (Index p = 0; p < rows_ / kPanel; ++p) {
    const auto panel = padded.middleRows(p * kPanel, kPanel);
    Index first = 0;
    while (first < columns_ && (panel.col(first).array() == 0.0).all()) {
      ++first;
    }
    panels_.push_back({static_cast<Index>(size), first});
    Eigen::Map<Eigen::MatrixXd>(entries_.data() + size, kPanel, columns_ - first) =
        panel.rightCols(columns_ - first);
    size += static_cast<std::size_t>(kPanel * (columns_ - first));
  }
  entries_.resize(size);
  entries_.shrink_to_fit();
}

void PackedMatrix::multiply(const double* y, double* result) noexcept {
  backward_ = !backward_;
  multiplyPanels(entries_.data(), panels_.data(), static_cast<Index>(panels_.size()), backward_,
                 columns_, y, result);
}

Eigen::MatrixXd stackedStep(const Eigen::MatrixXd& increment, const Eigen::MatrixXd& work) {
  Eigen::MatrixXd both(increment.rows() + work.rows(), increment.cols());
  both << increment, 2.0 * Eigen::MatrixXd(work.triangularView<Eigen::StrictlyUpper>());
  both.bottomRows(work.rows()).diagonal() = work.diagonal();
  return both;
}

PackedMatrix stepMatrix(const Eigen::MatrixXd& increment, const Eigen::MatrixXd& work) {
  return PackedMatrix(stackedStep(increment, work));
}

}  // namespace whirl_twin
