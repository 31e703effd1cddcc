// How far the free motion of a linear rotor can get, by its energy.
//
// e, with M e'' + (C + G) e' + (K + N) e = f, has in y = (L_K^T e, L_M^T e'), where K = L_K L_K^T
// and M = L_M L_M^T, the length |y|^2 = 2 (T + V). It obeys
//
//   d|y|/dt <= mu |y| + |L_M^-1 f|,  mu the largest eigenvalue of
//                                    [0, -B^T/2; -B/2, -L_M^-1 C L_M^-T],  B = L_M^-1 N L_K^-T
//
// (K and G do no work on it; mu is the logarithmic norm, Dahlquist, Trans. Royal Inst. Technology
// 130 (1959)). At a station z = a . q + i b . q no motion of length |y| is further out than r |y|,
// r^2 the largest eigenvalue of [a b]^T K^-1 [a b], and none is faster than s |y|, s^2 that of
// [a b]^T M^-1 [a b]. Its acceleration there is below s (k |y| + |L_M^-1 f|), k^2 the sum of the
// squares of the norms of L_M^-1 (K + N) L_K^-T and L_M^-1 (C + G) L_M^-T.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "mechanics/linear_rotor.h"

namespace whirl_twin {

class FreeMotion {
 public:
  /// nullopt: where M or K is not symmetric and positive, or G not skew.
  static std::optional<FreeMotion> of(const Linearization& matrices);

  /// mu [1/s], not below 0.
  double growth() const { return growth_; }
  /// k [1/s]
  double pull() const { return pull_; }
  /// |y| of e and e', given coordinate by coordinate.
  template <class Place, class Rate>
  double length(const Place& place, const Rate& rate) const {
    const Eigen::Index n = mass_root_.rows();
    double square = 0.0;
    // Row by row of the triangles.
    for (Eigen::Index i = 0; i < n; ++i) {
      double stretched = 0.0;
      double moving = 0.0;
      for (Eigen::Index j = i; j < n; ++j) {
        stretched += stiffness_root_(j, i) * place(j);
        moving += mass_root_(j, i) * rate(j);
      }
      square += stretched * stretched + moving * moving;
    }
    return std::sqrt(square);
  }
  double furthest(const Station& at) const;            ///< r
  double fastest(const Station& at) const;             ///< s
  double pushed(const Eigen::VectorXcd& force) const;  ///< |L_M^-1 f|, at least, of the real part

 private:
  double growth_ = 0.0;
  double pull_ = 0.0;
  Eigen::MatrixXd stiffness_root_, mass_root_;  ///< L_K, L_M
};

}  // namespace whirl_twin
