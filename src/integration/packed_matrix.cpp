#include "integration/packed_matrix.h"

#include "integration/simd_vector.h"

namespace whirl_twin {

namespace {

using Eigen::Index;

/// Runs of a panel that are parted by fewer columns of zeros are one.
constexpr Index kFewZeros = 4;

/// Two vectors of rows at a time, four columns at a time: eight sums under way, which have a
/// register each. Vectors wider than the machine's would not: compilers take them in parts through
/// memory.
template <int lanes>
WHIRL_TWIN_INLINE void multiplyBy(const double* entries, const PackedMatrix::Panel* panels,
                                  const PackedMatrix::Run* runs, Index count, bool backward,
                                  const double* y, double* result) noexcept {
  using Some = typename Vector<lanes>::Type;
  using Anywhere = typename Vector<lanes>::Anywhere;
  for (Index p = 0; p < count; ++p) {
    const Index panel = backward ? count - 1 - p : p;
    const PackedMatrix::Run* const first = runs + panels[panel].first_run;
    for (Index row = 0; row < PackedMatrix::kPanel; row += 2 * lanes) {
      const double* entry = entries + panels[panel].start + row;
      Some low[4] = {};
      Some high[4] = {};
      for (const PackedMatrix::Run* run = first; run != first + panels[panel].runs; ++run) {
        Index j = run->first;
        for (; j + 3 < run->end; j += 4, entry += 4 * PackedMatrix::kPanel) {
          for (int k = 0; k < 4; ++k) {
            const double* const column = entry + PackedMatrix::kPanel * k;
            low[k] += *reinterpret_cast<const Some*>(column) * y[j + k];
            high[k] += *reinterpret_cast<const Some*>(column + lanes) * y[j + k];
          }
        }
        for (; j < run->end; ++j, entry += PackedMatrix::kPanel) {
          low[0] += *reinterpret_cast<const Some*>(entry) * y[j];
          high[0] += *reinterpret_cast<const Some*>(entry + lanes) * y[j];
        }
      }
      double* const sums = result + panel * PackedMatrix::kPanel + row;
      *reinterpret_cast<Anywhere*>(sums) = (low[0] + low[1]) + (low[2] + low[3]);
      *reinterpret_cast<Anywhere*>(sums + lanes) = (high[0] + high[1]) + (high[2] + high[3]);
    }
  }
}

/// A few rows at a time: the sums of five vectors stay in the registers.
template <int lanes>
WHIRL_TWIN_INLINE void multiplyTogetherBy(const double* entries, const PackedMatrix::Panel* panels,
                                          const PackedMatrix::Run* runs, Index count, bool backward,
                                          const double* y, double* result) noexcept {
  using Some = typename Vector<lanes>::Type;
  constexpr auto kVectors = static_cast<Index>(PackedMatrix::kTogether);
  for (Index p = 0; p < count; ++p) {
    const Index panel = backward ? count - 1 - p : p;
    const PackedMatrix::Run* const first = runs + panels[panel].first_run;
    for (Index part = 0; part < PackedMatrix::kPanel; part += lanes) {
      const double* entry = entries + panels[panel].start + part;
      Some sums[kVectors] = {};
      for (const PackedMatrix::Run* run = first; run != first + panels[panel].runs; ++run) {
        for (Index j = run->first; j < run->end; ++j, entry += PackedMatrix::kPanel) {
          const Some some = *reinterpret_cast<const Some*>(entry);
          for (Index k = 0; k < kVectors; ++k) {
            sums[k] += some * y[kVectors * j + k];
          }
        }
      }
      double* const out = result + kVectors * (panel * PackedMatrix::kPanel + part);
      for (Index row = 0; row < lanes; ++row) {
        for (Index k = 0; k < kVectors; ++k) {
          out[kVectors * row + k] = sums[k][row];
        }
      }
    }
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
    const auto first_run = static_cast<Index>(runs_.size());
    panels_.push_back({static_cast<Index>(size), first_run, 0});
    for (Index j = 0; j < columns_; ++j) {
      if ((panel.col(j).array() == 0.0).all()) {
        continue;
      }
      const bool goes_on =
          static_cast<Index>(runs_.size()) > first_run && j - runs_.back().end < kFewZeros;
      if (!goes_on) {
        runs_.push_back({j, j});
      }
      const Index from = runs_.back().end;
      runs_.back().end = j + 1;
      Eigen::Map<Eigen::MatrixXd>(entries_.data() + size, kPanel, j + 1 - from) =
          panel.middleCols(from, j + 1 - from);
      size += static_cast<std::size_t>(kPanel * (j + 1 - from));
    }
    panels_.back().runs = static_cast<Index>(runs_.size()) - first_run;
  }
  entries_.resize(size);
  entries_.shrink_to_fit();
}

void PackedMatrix::multiply(const double* y, double* result) noexcept {
  backward_ = !backward_;
  inWidestVectors([&](auto lanes) WHIRL_TWIN_FLAT {
    multiplyBy<decltype(lanes)::value>(entries_.data(), panels_.data(), runs_.data(),
                                       static_cast<Index>(panels_.size()), backward_, y, result);
  });
}

void PackedMatrix::multiplyTogether(const double* y, double* result) noexcept {
  backward_ = !backward_;
  inWidestVectors([&](auto lanes) WHIRL_TWIN_FLAT {
    multiplyTogetherBy<decltype(lanes)::value>(entries_.data(), panels_.data(), runs_.data(),
                                               static_cast<Index>(panels_.size()), backward_, y,
                                               result);
  });
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
