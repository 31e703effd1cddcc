#include "signal/harmonic_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/dense.h"

namespace whirl_twin {

namespace {

/// Of the pivots of the normal equations, a measure of the squared condition number.
constexpr double kMinPivot = 1.0e-13;

/// Of the last terms of a polynomial, what those after them may add up to at the middle.
constexpr double kTruncation = 0.3;

/// L_p and its derivative at 0, for p = 0, 1, ...
class LegendreAtZero {
 public:
  double value() const { return value_; }
  double slope() const { return degree_ * before_; }
  void next() {
    // (p + 1) L_(p+1) = (2 p + 1) x L_p - p L_(p-1); at 0, L_p' = p L_(p-1).
    const double after = -degree_ / (degree_ + 1.0) * before_;
    before_ = value_;
    value_ = after;
    degree_ += 1.0;
  }

 private:
  double degree_ = 0.0;
  double value_ = 1.0;
  double before_ = 0.0;
};

}  // namespace

HarmonicFit::HarmonicFit(Eigen::ArrayXd tau, Eigen::Index most_columns)
    : tau_(std::move(tau)), columns_(tau_.size(), most_columns) {}

void HarmonicFit::addColumns(const Eigen::ArrayXd& factor, int degree) {
  Eigen::ArrayXd now = factor;
  Eigen::ArrayXd before = Eigen::ArrayXd::Zero(tau_.size());
  for (int p = 0; p <= degree; ++p) {
    columns_.col(used_++) = now.matrix();
    const Eigen::ArrayXd after = ((2 * p + 1) * tau_ * now - p * before) / (p + 1.0);
    before = std::exchange(now, after);
  }
}

void HarmonicFit::addMean(int degree) {
  harmonics_.push_back({used_, degree, false});
  addColumns(Eigen::ArrayXd::Ones(tau_.size()), degree);
}

void HarmonicFit::addHarmonic(const Eigen::ArrayXd& phase, int degree) {
  harmonics_.push_back({used_, degree, true});
  addColumns(phase.cos(), degree);
  addColumns(phase.sin(), degree);
}

void HarmonicFit::removeLast() {
  used_ = harmonics_.back().first;
  harmonics_.pop_back();
}

bool HarmonicFit::hasRoom(int degree) const {
  const Eigen::Index needed = used_ + 2 * (degree + 1);
  return needed <= columns_.cols() && 2 * needed <= tau_.size();
}

bool HarmonicFit::solve(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
  const auto a = columns_.leftCols(used_);
  Eigen::MatrixXd squared = Eigen::MatrixXd::Zero(used_, used_);
  squared.selfadjointView<Eigen::Lower>().rankUpdate(a.transpose());
  normal_ = Ldlt(squared);
  const Eigen::VectorXd pivots = normal_.pivots();
  if (!normal_.succeeded() || !(pivots.minCoeff() > kMinPivot * pivots.maxCoeff())) {
    return false;
  }
  Eigen::MatrixX2d measured(x.size(), 2);
  measured.col(0) = x.matrix();
  measured.col(1) = y.matrix();
  coefficients_ = normal_.solve(a.transpose() * measured);
  Eigen::MatrixX2d rest = measured - a * coefficients_;
  // Second pass on the residual (iterative refinement): the normal equations lose digits.
  coefficients_ += normal_.solve(a.transpose() * rest);
  rest = measured - a * coefficients_;
  rest_.resize(x.size());
  rest_.real() = rest.col(0).array();
  rest_.imag() = rest.col(1).array();
  const double free = 2.0 * static_cast<double>(x.size() - used_);
  noise_ = std::sqrt(rest.squaredNorm() / free);
  return true;
}

std::complex<double> HarmonicFit::mean() const {
  std::complex<double> z;
  LegendreAtZero legendre;
  for (Eigen::Index p = 0; p <= harmonics_.front().degree; ++p, legendre.next()) {
    z += legendre.value() * std::complex<double>(coefficients_(p, 0), coefficients_(p, 1));
  }
  return z;
}

std::complex<double> HarmonicFit::part(std::size_t harmonic, double direction, bool change) const {
  const Harmonic& h = harmonics_[harmonic];
  const std::complex<double> i(0.0, 1.0);
  std::complex<double> along_x, along_y;  // Re(along_x e^(i phase)) is seen along x
  LegendreAtZero legendre;
  for (Eigen::Index p = 0; p <= h.degree; ++p, legendre.next()) {
    const double at_zero = change ? legendre.slope() : legendre.value();
    const Eigen::Index c = h.first + p;
    const Eigen::Index s = c + h.degree + 1;
    along_x += at_zero * std::complex<double>(coefficients_(c, 0), -coefficients_(s, 0));
    along_y += at_zero * std::complex<double>(coefficients_(c, 1), -coefficients_(s, 1));
  }
  const std::complex<double> circle = 0.5 * (along_x + direction * i * along_y);
  return direction > 0.0 ? circle : std::conj(circle);
}

double HarmonicFit::deviation(std::size_t harmonic) const {
  const Harmonic& h = harmonics_[harmonic];
  Eigen::MatrixX2d at_zero = Eigen::MatrixX2d::Zero(used_, 2);  // of cosine and sine
  LegendreAtZero legendre;
  for (Eigen::Index p = 0; p <= h.degree; ++p, legendre.next()) {
    at_zero(h.first + p, 0) = at_zero(h.first + p + h.degree + 1, 1) = legendre.value();
  }
  const double both = (at_zero.transpose() * normal_.solve(at_zero)).trace();
  return 0.5 * noise_ * std::sqrt(both);
}

double HarmonicFit::doubt(std::size_t harmonic) const {
  const Harmonic& h = harmonics_[harmonic];
  double stays = 0.0;  // mean squares of the polynomials over the window
  double changes = 0.0;
  double last = 0.0;
  const double by_noise = deviation(harmonic);
  for (int p = 0; p <= h.degree; ++p) {
    const auto cosine = coefficients_.row(h.first + p);
    const auto sine = coefficients_.row(h.first + p + h.degree + 1);
    const double square = 0.5 * (cosine.squaredNorm() + sine.squaredNorm());
    (p == 0 ? stays : changes) += square / (2.0 * p + 1.0);
    if (p > 0 && p + 1 >= h.degree) {  // beyond what noise makes of it
      last = std::max(last, std::sqrt(square) - 3.0 * std::sqrt(2.0 * p + 1.0) * by_noise);
    }
  }
  const double likely = std::hypot(by_noise, kTruncation * last);
  return changes > stays ? std::max(likely, std::sqrt(changes)) : likely;
}

}  // namespace whirl_twin
