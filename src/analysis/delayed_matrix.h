// A transition matrix F most of whose states are delays: a row that copies a state is z^-1 of it,
// in closed form. Elimination of the copies leads to a small matrix R(z) with
//   det(z I - F) = z^(n - m) det R(z),   R(z) = z I - F_ww - sum_i F_wi z^-k_i e_root(i)^T
// for the m states w that are no copies and each copy i, k_i samples behind its root. (Transfer
// functions with a dead time: K. Astrom, B. Wittenmark, Computer-Controlled Systems, 3rd ed., 1997,
// ch. 2.6.) Its roots are counted by the argument principle.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace whirl_twin {

class DelayedMatrix {
 public:
  using Complex = std::complex<double>;

  explicit DelayedMatrix(const Eigen::MatrixXd& f);  ///< [n x n]

  Eigen::Index states() const { return states_; }                                    ///< n
  Eigen::Index remaining() const { return static_cast<Eigen::Index>(own_.size()); }  ///< m

  /// det(I - F / z), which has no pole outside the unit circle.
  Complex determinant(const Complex& z) const;
  /// (z I - F)^-1 b, b [n x columns].
  Eigen::MatrixXcd solve(const Complex& z, const Eigen::MatrixXd& b) const;

  /// Roots outside |z| = radius, by the argument principle; nothing where one lies on it to
  /// rounding. `roots`: those that are known, round which the circle is followed closely.
  std::optional<int> countOutside(double radius, const std::vector<Complex>& roots) const;
  /// The roots with a modulus above kInnermost, by the iteration of Ehrlich and Aberth (O. Aberth,
  /// Math. Comp. 27 (1973) 339), which moves all of them at once. Fewer where it did not converge.
  std::vector<Complex> roots() const;

  static constexpr double kInnermost = 0.5;
  /// As if nothing came back from its delays: the poles of a loop that is opened there.
  std::vector<Complex> rootsWithoutDelays() const;

 private:
  /// A state that copies another one, directly or by others that do.
  struct Copy {
    Eigen::Index state, copied, root;  ///< root: of own_
    int behind;                        ///< samples
  };
  std::vector<Complex> powers(const Complex& z) const;
  Eigen::MatrixXcd reduced(const Complex& z, const std::vector<Complex>& powers) const;
  /// R'(z).
  Eigen::MatrixXcd slope(const Complex& z, const std::vector<Complex>& powers) const;
  /// z over the derivative of ln det(z I - F) by ln z: a step of Newton's method.
  Complex newtonStep(const Complex& z) const;

  Eigen::Index states_;
  std::vector<Eigen::Index> own_;  ///< states that are no copies
  std::vector<Copy> copies_;       ///< in the order of `behind`
  Eigen::MatrixXd f_own_;          ///< [m x m]
  std::vector<Copy> used_;         ///< copies that enter other states
  Eigen::MatrixXd f_used_;         ///< [m x used]
};

/// The eigenvalues that decide on stability.
struct LeadingRoots {
  std::vector<std::complex<double>> roots;  ///< by falling modulus, those of largest modulus
  int outside = 0;                          ///< of the unit circle
  int near = 0;                             ///< on it, to rounding
};

/// Nothing where the count by the argument principle and the roots found do not agree (a multiple
/// root among them).
std::optional<LeadingRoots> leadingRoots(const DelayedMatrix& matrix);

/// Is a dense computation of the eigenvalues of F much more work than those by leadingRoots()?
bool isMostlyDelays(const DelayedMatrix& matrix);

}  // namespace whirl_twin
