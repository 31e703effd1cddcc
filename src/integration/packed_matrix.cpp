#include "integration/packed_matrix.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define WHIRL_TWIN_VECTOR_WIDTHS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WHIRL_TWIN_VECTOR_WIDTHS
#endif

namespace whirl_twin {

namespace {

using Eigen::Index;

/// Eight doubles that may lie anywhere; narrower machines take them in parts.
typedef double Eight __attribute__((vector_size(64), aligned(8)));

WHIRL_TWIN_VECTOR_WIDTHS
void multiplyPanels(const double* entries, Index panels, const Index* first, Index columns,
                    const double* y, double* result) noexcept {
  for (Index p = 0; p < panels; ++p) {
    // Even and odd columns apart: four sums under way at a time.
    Eight low = {};
    Eight high = {};
    Eight low_odd = {};
    Eight high_odd = {};
    Index j = first[p];
    for (; j + 1 < columns; j += 2, entries += 2 * PackedMatrix::kPanel) {
      low += *reinterpret_cast<const Eight*>(entries) * y[j];
      high += *reinterpret_cast<const Eight*>(entries + 8) * y[j];
      low_odd += *reinterpret_cast<const Eight*>(entries + 16) * y[j + 1];
      high_odd += *reinterpret_cast<const Eight*>(entries + 24) * y[j + 1];
    }
    if (j < columns) {
      low += *reinterpret_cast<const Eight*>(entries) * y[j];
      high += *reinterpret_cast<const Eight*>(entries + 8) * y[j];
      entries += PackedMatrix::kPanel;
    }
    *reinterpret_cast<Eight*>(result) = low + low_odd;
    *reinterpret_cast<Eight*>(result + 8) = high + high_odd;
    result += PackedMatrix::kPanel;
  }
}

}  // namespace

PackedMatrix::PackedMatrix(const Eigen::MatrixXd& matrix)
    : rows_((matrix.rows() + kPanel - 1) / kPanel * kPanel), columns_(matrix.cols()) {
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(rows_, columns_);
  padded.topRows(matrix.rows()) = matrix;
  entries_.resize(rows_ * columns_);
  Index size = 0;
  for (Index p = 0; p < rows_ / kPanel; ++p) {
    const auto panel = padded.middleRows(p * kPanel, kPanel);
    Index first = 0;
    while (first < columns_ && (panel.col(first).array() == 0.0).all()) {
      ++first;
    }
    first_.push_back(first);
    Eigen::Map<Eigen::MatrixXd>(entries_.data() + size, kPanel, columns_ - first) =
        panel.rightCols(columns_ - first);
    size += kPanel * (columns_ - first);
  }
  entries_.conservativeResize(size);
}

void PackedMatrix::multiply(const double* y, double* result) const noexcept {
  multiplyPanels(entries_.data(), rows_ / kPanel, first_.data(), columns_, y, result);
}

}  // namespace whirl_twin
