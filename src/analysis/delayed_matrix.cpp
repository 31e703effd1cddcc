#include "analysis/delayed_matrix.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "algebra/dense.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr Index kFewStates = 80;        // dense matrices of them are quick
constexpr int kPointsOfRoot = 8;        // of the circle, for each state
constexpr double kMaxTurn = 1.0;        // rad, of the determinant from point to point
constexpr double kNarrowest = 1.0e-14;  // rad
constexpr int kIterations = 300;
constexpr double kConverged = 1.0e-14;
constexpr double kNearCircle = 1.0e-10;  // rounding of F may take a root across
constexpr double kJustOutside = 1.0e-6;  // of the spectral radius, where no root may be

/// The state that each row copies; -1: none.
std::vector<Index> copiedStates(const MatrixXd& f) {
  std::vector<Index> copied(static_cast<std::size_t>(f.rows()), -1);
  for (Index i = 0; i < f.rows(); ++i) {
    Index entries = 0;
    Index place = -1;
    for (Index j = 0; j < f.cols() && entries < 2; ++j) {
      if (f(i, j) != 0.0) {
        ++entries;
        place = j;
      }
    }
    if (entries == 1 && place != i && f(i, place) == 1.0) {
      copied[static_cast<std::size_t>(i)] = place;
    }
  }
  // A ring of copies has no root: one of it is its own.
  for (Index i = 0; i < f.rows(); ++i) {
    Index at = i;
    for (Index steps = 0; at >= 0 && steps <= f.rows(); ++steps) {
      at = copied[static_cast<std::size_t>(at)];
      if (at == i) {
        copied[static_cast<std::size_t>(i)] = -1;
        break;
      }
    }
  }
  return copied;
}

double spectralRadius(const std::vector<Complex>& roots) {
  double largest = 0.0;
  for (const Complex& z : roots) {
    largest = std::fmax(largest, std::abs(z));
  }
  return largest;
}

}  // namespace

DelayedMatrix::DelayedMatrix(const MatrixXd& f) : states_(f.rows()) {
  const std::vector<Index> copied = copiedStates(f);
  std::vector<Index> place(copied.size(), -1);
  for (Index i = 0; i < states_; ++i) {
    if (copied[static_cast<std::size_t>(i)] < 0) {
      place[static_cast<std::size_t>(i)] = static_cast<Index>(own_.size());
      own_.push_back(i);
    }
  }
  for (Index i = 0; i < states_; ++i) {
    Copy copy{i, copied[static_cast<std::size_t>(i)], i, 0};
    while (copied[static_cast<std::size_t>(copy.root)] >= 0) {
      copy.root = copied[static_cast<std::size_t>(copy.root)];
      ++copy.behind;
    }
    copy.root = place[static_cast<std::size_t>(copy.root)];
    if (copy.behind > 0) {
      copies_.push_back(copy);
    }
  }
  std::stable_sort(copies_.begin(), copies_.end(),
                   [](const Copy& a, const Copy& b) { return a.behind < b.behind; });
  const Index m = remaining();
  MatrixXd rows(m, states_);
  for (Index i = 0; i < m; ++i) {
    rows.row(i) = f.row(own_[static_cast<std::size_t>(i)]);
  }
  f_own_.resize(m, m);
  for (Index i = 0; i < m; ++i) {
    f_own_.col(i) = rows.col(own_[static_cast<std::size_t>(i)]);
  }
  for (const Copy& copy : copies_) {
    if ((rows.col(copy.state).array() != 0.0).any()) {
      used_.push_back(copy);
    }
  }
  f_used_.resize(m, static_cast<Index>(used_.size()));
  for (std::size_t i = 0; i < used_.size(); ++i) {
    f_used_.col(static_cast<Index>(i)) = rows.col(used_[i].state);
  }
}

/// z^0, z^-1, z^-2 ...
std::vector<Complex> DelayedMatrix::powers(const Complex& z) const {
  const int longest = copies_.empty() ? 0 : copies_.back().behind;
  std::vector<Complex> powers(static_cast<std::size_t>(longest) + 1, 1.0);
  const Complex inverse = 1.0 / z;
  for (std::size_t k = 1; k < powers.size(); ++k) {
    powers[k] = powers[k - 1] * inverse;
  }
  return powers;
}

MatrixXcd DelayedMatrix::reduced(const Complex& z, const std::vector<Complex>& powers) const {
  MatrixXcd r = -f_own_.cast<Complex>();
  r.diagonal().array() += z;
  for (std::size_t i = 0; i < used_.size(); ++i) {
    r.col(used_[i].root) -=
        powers[static_cast<std::size_t>(used_[i].behind)] * f_used_.col(static_cast<Index>(i));
  }
  return r;
}

MatrixXcd DelayedMatrix::slope(const Complex& z, const std::vector<Complex>& powers) const {
  MatrixXcd r = MatrixXcd::Identity(remaining(), remaining());
  for (std::size_t i = 0; i < used_.size(); ++i) {
    const Complex factor = static_cast<double>(used_[i].behind) / z *
                           powers[static_cast<std::size_t>(used_[i].behind)];
    r.col(used_[i].root) += factor * f_used_.col(static_cast<Index>(i));
  }
  return r;
}

Complex DelayedMatrix::determinant(const Complex& z) const {
  if (own_.empty()) {
    return 1.0;
  }
  // Row exchanges change the sign, which pivots do not show: so of R / z, by elimination here.
  MatrixXcd r = reduced(z, powers(z)) / z;
  Complex product = 1.0;
  for (Index k = 0; k < r.rows(); ++k) {
    Index best = k;
    for (Index i = k + 1; i < r.rows(); ++i) {
      best = std::norm(r(i, k)) > std::norm(r(best, k)) ? i : best;
    }
    if (best != k) {
      r.row(k).swap(r.row(best));
      product = -product;
    }
    product *= r(k, k);
    if (r(k, k) == 0.0) {
      return 0.0;
    }
    for (Index i = k + 1; i < r.rows(); ++i) {
      const Complex factor = r(i, k) / r(k, k);
      if (factor != 0.0) {
        r.row(i).tail(r.cols() - k) -= factor * r.row(k).tail(r.cols() - k);
      }
    }
  }
  return product;
}

MatrixXcd DelayedMatrix::solve(const Complex& z, const MatrixXd& b) const {
  const std::vector<Complex> to = powers(z);
  MatrixXcd v = MatrixXcd::Zero(states_, b.cols());
  // What is added to copies themselves, as far as their successors see it.
  const bool added = std::any_of(copies_.begin(), copies_.end(), [&](const Copy& copy) {
    return (b.row(copy.state).array() != 0.0).any();
  });
  for (const Copy& copy : copies_) {
    if (added) {
      v.row(copy.state) = (v.row(copy.copied) + b.row(copy.state)) / z;
    }
  }
  MatrixXcd right(remaining(), b.cols());
  for (Index i = 0; i < remaining(); ++i) {
    right.row(i) = b.row(own_[static_cast<std::size_t>(i)]);
  }
  for (std::size_t i = 0; added && i < used_.size(); ++i) {
    right += f_used_.col(static_cast<Index>(i)) * v.row(used_[i].state);
  }
  const MatrixXcd own = ComplexLu(reduced(z, to)).solve(right);
  for (Index i = 0; i < remaining(); ++i) {
    v.row(own_[static_cast<std::size_t>(i)]) = own.row(i);
  }
  for (const Copy& copy : copies_) {
    v.row(copy.state) += to[static_cast<std::size_t>(copy.behind)] * own.row(copy.root);
  }
  return v;
}

std::optional<int> DelayedMatrix::countOutside(double radius,
                                               const std::vector<Complex>& roots) const {
  // Half a circle: the other half turns as much.
  std::vector<double> angles;
  const Index points = kPointsOfRoot * states_ + 64;
  for (Index i = 0; i <= points; ++i) {
    angles.push_back(kPi * static_cast<double>(i) / static_cast<double>(points));
  }
  for (const Complex& root : roots) {
    const double place = std::fabs(std::arg(root));
    const double width = std::fmax(std::fabs(std::abs(root) / radius - 1.0), kNarrowest);
    for (double away = 0.25 * width; away < kPi / static_cast<double>(points); away *= 2.0) {
      for (const double angle : {place - away, place + away}) {
        if (angle > 0.0 && angle < kPi) {
          angles.push_back(angle);
        }
      }
    }
  }
  std::sort(angles.begin(), angles.end());
  const auto at = [&](double angle) { return determinant(std::polar(radius, angle)); };
  double turned = 0.0;
  double angle = angles.front();
  Complex value = at(angle);
  std::vector<double> ahead(angles.rbegin(), angles.rend() - 1);  // the next one last
  while (!ahead.empty()) {
    const double next = ahead.back();
    const Complex then = at(next);
    const double turn = std::arg(then * std::conj(value));
    if (value == 0.0 || then == 0.0) {
      return std::nullopt;
    }
    if (std::fabs(turn) > kMaxTurn) {
      if (next - angle < kNarrowest) {
        return std::nullopt;
      }
      ahead.push_back(0.5 * (angle + next));
      continue;
    }
    turned += turn;
    angle = next;
    value = then;
    ahead.pop_back();
  }
  return static_cast<int>(std::lround(-turned / kPi));
}

Complex DelayedMatrix::newtonStep(const Complex& z) const {
  const std::vector<Complex> to = powers(z);
  const Complex trace = own_.empty() ? 0.0 : ComplexLu(reduced(z, to)).solve(slope(z, to)).trace();
  return 1.0 / (static_cast<double>(states_ - remaining()) / z + trace);
}

std::vector<Complex> DelayedMatrix::roots() const {
  // Those of delays lie about evenly near the unit circle, and are never quite symmetric here.
  const auto n = static_cast<std::size_t>(states_);
  std::vector<Complex> z;
  for (std::size_t i = 0; i < n; ++i) {
    z.push_back(std::polar(1.0, kTwoPi * (static_cast<double>(i) + 0.3) / static_cast<double>(n)));
  }
  std::vector<bool> done(n, false);  // converged, or further inside
  bool all = false;
  for (int k = 0; k < kIterations && !all; ++k) {
    all = true;
    for (std::size_t i = 0; i < n; ++i) {
      if (done[i]) {
        continue;
      }
      const Complex newton = newtonStep(z[i]);
      if (!std::isfinite(newton.real()) || !std::isfinite(newton.imag())) {
        done[i] = true;  // R is singular: on the root
        continue;
      }
      Complex others = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        const Complex away = z[i] - z[j];
        if (j != i && away != 0.0) {
          others += std::conj(away) / std::norm(away);
        }
      }
      const Complex by = newton / (1.0 - newton * others);
      z[i] -= by;
      const double size = std::abs(z[i]);
      done[i] = size < kInnermost || !std::isfinite(size) || std::abs(by) <= kConverged * size;
      all = all && done[i];
    }
  }
  std::vector<Complex> found;
  for (std::size_t i = 0; i < n; ++i) {
    if (done[i] && std::abs(z[i]) >= kInnermost) {
      found.push_back(z[i]);
    }
  }
  return found;
}

std::vector<Complex> DelayedMatrix::rootsWithoutDelays() const {
  const Eigen::VectorXcd values = eigenvalues(f_own_).values;
  return {values.data(), values.data() + values.size()};
}

std::optional<LeadingRoots> leadingRoots(const DelayedMatrix& matrix) {
  LeadingRoots leading;
  std::vector<Complex>& roots = leading.roots;
  roots = matrix.roots();
  const std::optional<int> further = matrix.countOutside(
      std::fmax(spectralRadius(roots), DelayedMatrix::kInnermost) * (1.0 + kJustOutside), roots);
  if (!further || *further != 0) {
    return std::nullopt;
  }
  for (const Complex& root : roots) {
    const double away = std::abs(root) - 1.0;
    leading.near += std::fabs(away) <= kNearCircle ? 1 : 0;
    leading.outside += away > kNearCircle ? 1 : 0;
  }
  const std::optional<int> outside = matrix.countOutside(1.0 + 2.0 * kNearCircle, roots);
  if (!outside || *outside != leading.outside) {
    return std::nullopt;
  }
  std::sort(roots.begin(), roots.end(), [](const Complex& x, const Complex& y) {
    const double ax = std::abs(x);
    const double ay = std::abs(y);
    return ax != ay ? ax > ay : x.imag() < y.imag();
  });
  return leading;
}

bool isMostlyDelays(const DelayedMatrix& matrix) {
  return matrix.states() > kFewStates && 2 * matrix.remaining() <= matrix.states();
}

}  // namespace whirl_twin
