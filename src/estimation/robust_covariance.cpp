#include "estimation/robust_covariance.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstddef>

#include "algebra/dense.h"

namespace whirl_twin {

namespace {

/// Maximum number of blocks. Beyond it the two neighbours with the smallest information are merged:
/// information concentrated at a resonance keeps its resolution.
constexpr std::size_t kMaxBlocks = 64;
constexpr double kNormal975 = 1.959963984540054;

Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix) {
  return Ldlt(matrix).solve(
      Eigen::MatrixXd(Eigen::MatrixXd::Identity(matrix.rows(), matrix.rows())));
}

/// Ratio of Student's 97.5 % point to the normal one.
double studentsFactor(double freedom) {
  const boost::math::students_t distribution(std::max(1.0, freedom));
  return boost::math::quantile(distribution, 0.975) / kNormal975;
}

}  // namespace

RobustCovariance::RobustCovariance(const Eigen::VectorXd& sizes, const Eigen::VectorXd& walk)
    : all_(sizes.size()), factors_(Eigen::VectorXd::Ones(sizes.size())) {
  for (Eigen::Index i = 0; i < all_; ++i) {
    if (sizes[i] > 0.0) {
      estimated_.push_back(i);
    }
  }
  const auto n = static_cast<Eigen::Index>(estimated_.size());
  sizes_.resize(n);
  walk_.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index k = estimated_[static_cast<std::size_t>(i)];
    sizes_[i] = sizes[k];
    walk_[i] = walk[k] / (sizes[k] * sizes[k]);
  }
  restart(Eigen::VectorXd::Zero(all_), sizes.cwiseAbs2().asDiagonal());
}

Eigen::VectorXd RobustCovariance::scaled(const Eigen::VectorXd& numbers) const {
  Eigen::VectorXd x(sizes_.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = numbers[estimated_[static_cast<std::size_t>(i)]] / sizes_[i];
  }
  return x;
}

Eigen::MatrixXd RobustCovariance::scaled(const Eigen::MatrixXd& covariance) const {
  Eigen::MatrixXd p(sizes_.size(), sizes_.size());
  for (Eigen::Index i = 0; i < p.rows(); ++i) {
    for (Eigen::Index j = 0; j < p.cols(); ++j) {
      p(i, j) = covariance(estimated_[static_cast<std::size_t>(i)],
                           estimated_[static_cast<std::size_t>(j)]) /
                (sizes_[i] * sizes_[j]);
    }
  }
  return p;
}

void RobustCovariance::setLast(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance) {
  last_ = scaled(numbers);
  covariance_ = scaled(covariance);
  information_ = inverse(covariance_);
}

void RobustCovariance::restart(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance) {
  factors_.setOnes();
  resume(numbers, covariance);
}

void RobustCovariance::resume(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance) {
  if (estimated_.empty()) {
    return;
  }
  setLast(numbers, covariance);
  blocks_.clear();
  Eigen::VectorXd factors(sizes_.size());
  for (Eigen::Index i = 0; i < factors.size(); ++i) {
    factors[i] = factors_[estimated_[static_cast<std::size_t>(i)]];
  }
  const Eigen::MatrixXd wider = factors.asDiagonal() * covariance_ * factors.asDiagonal();
  start_ = information_ * wider * information_;
}

void RobustCovariance::add(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& covariance,
                           double duration) {
  if (estimated_.empty()) {
    return;
  }
  const Eigen::VectorXd x = last_;
  Eigen::MatrixXd before = information_;
  if (walk_.maxCoeff() > 0.0) {
    Eigen::MatrixXd walked = covariance_;
    for (Eigen::Index i = 0; i < walk_.size(); ++i) {
      // As in the filter: the uncertainty does not grow beyond the initial one.
      walked(i, i) += covariance_(i, i) < 1.0 ? walk_[i] * duration : 0.0;
    }
    before = inverse(walked);
    const Eigen::MatrixXd less = before * covariance_;
    start_ = less * start_ * less.transpose();
    for (Block& block : blocks_) {
      block.information = less * block.information;
      block.weighted = less * block.weighted;
    }
  }
  setLast(numbers, covariance);
  blocks_.push_back({information_ - before, information_ * last_ - before * x});
  judge();
}

void RobustCovariance::judge() {
  const Eigen::Index n = sizes_.size();
  const Eigen::VectorXd expected = covariance_.diagonal();
  Eigen::VectorXd variance = (covariance_ * start_ * covariance_).diagonal();
  Eigen::VectorXd lagged = Eigen::VectorXd::Zero(n), sum = lagged, squares = lagged;
  Eigen::VectorXd before = lagged;
  std::vector<double> shares;
  for (const Block& block : blocks_) {
    const Eigen::VectorXd off = covariance_ * (block.weighted - block.information * last_);
    variance += off.cwiseAbs2();
    lagged += 2.0 * off.cwiseProduct(before);
    before = off;
    const Eigen::MatrixXd part = covariance_ * block.information * covariance_;
    const Eigen::VectorXd weight = part.diagonal().cwiseMax(0.0);
    sum += weight;
    squares += weight.cwiseAbs2();
    shares.push_back(weight.cwiseQuotient(expected).sum());
  }
  variance += lagged.cwiseMax(0.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double blocks = squares[i] > 0.0 ? sum[i] * sum[i] / squares[i] : 1.0;
    const double ratio = std::sqrt(variance[i] / expected[i]) * studentsFactor(blocks - 1.0);
    factors_[estimated_[static_cast<std::size_t>(i)]] = std::fmax(1.0, ratio);
  }
  if (blocks_.size() > kMaxBlocks) {
    mergeLeast(shares);
  }
}

void RobustCovariance::mergeLeast(const std::vector<double>& shares) {
  std::size_t least = 0;
  for (std::size_t k = 1; k + 1 < shares.size(); ++k) {
    if (shares[k] + shares[k + 1] < shares[least] + shares[least + 1]) {
      least = k;
    }
  }
  blocks_[least].information += blocks_[least + 1].information;
  blocks_[least].weighted += blocks_[least + 1].weighted;
  blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(least) + 1);
}

}  // namespace whirl_twin
