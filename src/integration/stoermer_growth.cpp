#include "integration/stoermer_growth.h"

#include "algebra/dense.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Rows of a linear map of what a step starts from: q, its last increment d, and the h^2 a of the
/// past, the latest first. [n x n (2 + terms)]
class FromState {
 public:
  FromState(Index n, Index terms) : n_(n), terms_(terms) {}
  MatrixXd block(Index i) const {
    MatrixXd rows = MatrixXd::Zero(n_, n_ * (2 + terms_));
    rows.middleCols(i * n_, n_).setIdentity();
    return rows;
  }
  MatrixXd position() const { return block(0); }
  MatrixXd increment() const { return block(1); }
  MatrixXd past(Index k) const { return block(2 + k); }
  /// Of the past, times the weights from `first` on.
  MatrixXd sum(const stoermer::Weights& weights, std::size_t first) const {
    MatrixXd rows = MatrixXd::Zero(n_, n_ * (2 + terms_));
    for (Index k = 0; k < terms_; ++k) {
      const std::size_t weight = first + static_cast<std::size_t>(k);
      rows += (weight < weights.size() ? weights[weight] : 0.0) * past(k);
    }
    return rows;
  }

 private:
  Index n_, terms_;
};

}  // namespace

double growthInAStep(const StoermerScheme& scheme, const MatrixXd& by_q, const MatrixXd& by_v,
                     double h) {
  const Index n = by_q.rows();
  const auto terms = static_cast<Index>(scheme.terms);
  const FromState from(n, terms);
  // Everything in lengths: increments d = h v, accelerations times h^2.
  const auto acceleration = [&](const MatrixXd& q, const MatrixXd& d) -> MatrixXd {
    return h * h * by_q * q + h * by_v * d;
  };
  MatrixXd d = from.increment() + from.sum(scheme.position, 0);
  MatrixXd q = from.position() + d;
  MatrixXd a = acceleration(q, d + from.sum(scheme.rate, 0));
  if (scheme.corrected) {
    d = from.increment() + scheme.corrected_position[0] * a +
        from.sum(scheme.corrected_position, 1);
    q = from.position() + d;
    a = acceleration(q, d + scheme.corrected_rate[0] * a + from.sum(scheme.corrected_rate, 1));
  }
  MatrixXd map(n * (2 + terms), n * (2 + terms));
  map.topRows(n) = q;
  map.middleRows(n, n) = d;
  map.middleRows(2 * n, n) = a;
  for (Index k = 1; k < terms; ++k) {
    map.middleRows((2 + k) * n, n) = from.past(k - 1);
  }
  return eigenvalues(map).values.cwiseAbs().maxCoeff();
}

}  // namespace whirl_twin
