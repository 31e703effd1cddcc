#include "signal/resonance_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "algebra/dense.h"
#include "signal/run_up_response.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxResonances = 4;
constexpr double kUnknownDamping = 0.05;
constexpr double kMinPeak = 0.05;  // of the highest
constexpr double kTried = 1.0e-6;  // relative change of an unknown for its derivative
constexpr int kSteps = 100;
constexpr double kDone = 1.0e-12;  // relative decrease of the residual

std::complex<double> response(double speed, double critical, double damping) {
  const double square = speed * speed;
  return square /
         std::complex<double>(critical * critical - square, 2.0 * damping * critical * speed);
}

/// The linear problem at critical speeds and damping ratios, of which the logarithms are unknown.
class Projection {
 public:
  Projection(const std::vector<SpeedVector>& vectors, const Eigen::VectorXd& logarithms)
      : modes_(logarithms.size() / 2) {
    const auto rows = static_cast<Eigen::Index>(vectors.size());
    matrix_.resize(2 * rows, 2 * (modes_ + 1));
    Eigen::VectorXd measured(2 * rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const SpeedVector& one = vectors[static_cast<std::size_t>(i)];
      measured.segment<2>(2 * i) << one.vector.real(), one.vector.imag();
      for (Eigen::Index k = 0; k <= modes_; ++k) {
        const std::complex<double> h = k == 0 ? 1.0
                                              : response(one.speed, std::exp(logarithms[2 * k - 2]),
                                                         std::exp(logarithms[2 * k - 1]));
        matrix_.block<2, 2>(2 * i, 2 * k) << h.real(), -h.imag(), h.imag(), h.real();
      }
    }
    factors_ = PivotedQr(matrix_).solve(measured);
    residual_ = measured - matrix_ * factors_;
  }

  std::complex<double> factor(Eigen::Index k) const {
    return {factors_[2 * k], factors_[2 * k + 1]};
  }
  const Eigen::VectorXd& residual() const { return residual_; }
  const Eigen::MatrixXd& matrix() const { return matrix_; }

 private:
  Eigen::Index modes_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd factors_, residual_;
};

Eigen::MatrixXd derivatives(const std::vector<SpeedVector>& vectors, const Eigen::VectorXd& at) {
  const Eigen::Index rows = 2 * static_cast<Eigen::Index>(vectors.size());
  Eigen::MatrixXd jacobian(rows, at.size());
  for (Eigen::Index j = 0; j < at.size(); ++j) {
    Eigen::VectorXd above = at, below = at;
    above[j] += kTried;
    below[j] -= kTried;
    jacobian.col(j) =
        (Projection(vectors, above).residual() - Projection(vectors, below).residual()) /
        (2.0 * kTried);
  }
  return jacobian;
}

/// Levenberg & Marquardt.
Eigen::VectorXd leastSquares(const std::vector<SpeedVector>& vectors, Eigen::VectorXd at) {
  double damping = 1.0e-3;
  double square = Projection(vectors, at).residual().squaredNorm();
  for (int step = 0; step < kSteps && at.size() > 0; ++step) {
    const Eigen::MatrixXd jacobian = derivatives(vectors, at);
    const Eigen::VectorXd gradient = jacobian.transpose() * Projection(vectors, at).residual();
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd next = at - LuFactors<double>(normal).solve(gradient);
    const double reached = next.allFinite() && next.cwiseAbs().maxCoeff() < 50.0
                               ? Projection(vectors, next).residual().squaredNorm()
                               : square;
    if (!(reached < square)) {
      damping *= 10.0;
      if (damping > 1.0e9) {
        break;
      }
      continue;
    }
    const bool done = square - reached < kDone * square;
    at = next;
    square = reached;
    damping *= 0.1;
    if (done) {
      break;
    }
  }
  return at;
}

/// Logarithms of critical speeds and damping ratios, by the peaks less the slowest vectors.
Eigen::VectorXd startOf(const std::vector<SpeedVector>& vectors) {
  const std::size_t slowest = std::max<std::size_t>(2, vectors.size() / 20);
  std::complex<double> roll = 0.0;
  for (std::size_t i = 0; i < slowest; ++i) {
    roll += vectors[i].vector / static_cast<double>(slowest);
  }
  RunUpResponse run;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    run.take(static_cast<double>(i), vectors[i].speed, std::abs(vectors[i].vector - roll));
  }
  std::vector<ResponsePeak> peaks = run.peaks();
  std::sort(peaks.begin(), peaks.end(),
            [](const auto& a, const auto& b) { return a.amplitude > b.amplitude; });
  while (!peaks.empty() && (peaks.size() > kMaxResonances ||
                            peaks.back().amplitude < kMinPeak * peaks.front().amplitude)) {
    peaks.pop_back();
  }
  std::sort(peaks.begin(), peaks.end(),
            [](const auto& a, const auto& b) { return a.speed < b.speed; });
  Eigen::VectorXd start(2 * static_cast<Eigen::Index>(peaks.size()));
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    const double factor = peaks[k].amplification_factor.value_or(0.5 / kUnknownDamping);
    start.segment<2>(2 * static_cast<Eigen::Index>(k)) << std::log(peaks[k].speed),
        std::log(0.5 / factor);
  }
  return start;
}

}  // namespace

std::complex<double> ResonanceFit::at(double speed) const {
  std::complex<double> sum = slow_roll;
  for (const FittedResonance& one : resonances) {
    sum += one.residue * response(speed, one.speed, one.damping_ratio);
  }
  return sum;
}

ResonanceFit fitResonances(const std::vector<SpeedVector>& vectors) {
  const Eigen::VectorXd found = leastSquares(vectors, startOf(vectors));
  const Projection best(vectors, found);
  const auto rows = static_cast<double>(best.residual().size());
  const Eigen::Index modes = found.size() / 2;
  const double left = std::max(1.0, rows - static_cast<double>(4 * modes + 2));
  const double variance = best.residual().squaredNorm() / left;
  ResonanceFit fit;
  fit.rms = std::sqrt(2.0 * best.residual().squaredNorm() / rows);
  fit.slow_roll = best.factor(0);
  const Eigen::MatrixXd linear = best.matrix().transpose() * best.matrix();
  fit.slow_roll_deviation = std::sqrt(variance * LuFactors<double>(linear).inverse()(0, 0));
  const Eigen::MatrixXd jacobian = derivatives(vectors, found);
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const Eigen::MatrixXd covariance =
      modes > 0 ? Eigen::MatrixXd(variance * LuFactors<double>(normal).inverse()) : normal;
  for (Eigen::Index k = 0; k < modes; ++k) {
    FittedResonance one;
    one.speed = std::exp(found[2 * k]);
    one.speed_deviation = one.speed * std::sqrt(covariance(2 * k, 2 * k));
    one.damping_ratio = std::exp(found[2 * k + 1]);
    one.damping_ratio_deviation = one.damping_ratio * std::sqrt(covariance(2 * k + 1, 2 * k + 1));
    one.residue = best.factor(k + 1);
    fit.resonances.push_back(one);
  }
  std::sort(fit.resonances.begin(), fit.resonances.end(),
            [](const auto& a, const auto& b) { return a.speed < b.speed; });
  return fit;
}

}  // namespace whirl_twin
