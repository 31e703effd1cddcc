// The roots s of smallest modulus of
//
//   (A0 + s A1 + s^2 A2) phi = 0
//
// of matrices near their diagonals, without a dense solution: the eigenvalues 1/s of the inverse
// linearization (phi, s phi) -> (-A0^-1 (A1 phi + A2 s phi), phi) of largest modulus, by the block
// Arnoldi method (Y. Saad, Numerical Methods for Large Eigenvalue Problems, 2011, 6.5; D. Mackey et
// al., SIAM J. Matrix Anal. Appl. 28, 2006 for the linearization), each polished by Newton's
// method. Blocks of two, as a round rotor at rest has every root twice.
//
// That none is missing is checked by the argument principle: along the circle |s| = r the phase of
//
//   det(A0 + s A1 + s^2 A2) / prod (s - s_i)
//
// comes back to where it was only if as many s_i lie within as there are roots. Work in proportion
// to the length of a chain, and to the square of the number of roots.
//
// Own, because Spectra and ARPACK++ have neither the quadratic problem nor the check, and the
// bands' factorizations are here already.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "algebra/banded_matrix.h"

namespace whirl_twin {

template <class Scalar>
struct BandedPencil {
  BandedMatrix<Scalar> a0, a1, a2;

  /// A0 + s A1 + s^2 A2.
  BandedMatrix<std::complex<double>> at(std::complex<double> s) const;
  /// The same in s - centre.
  BandedPencil about(const Scalar& centre) const;
};

struct RefinedEigenpair {
  std::complex<double> value;
  Eigen::VectorXcd shape;  ///< of length 1
};

struct LowestRoots {
  std::vector<RefinedEigenpair> roots;  ///< by rising modulus, then imaginary part
  double radius = 0.0;                  ///< all roots within this are there, and no others
};

/// `count` or a few more: the circle lies in a gap that is wide relative to the spacing of the
/// roots. Nothing for a singular A0, for a bandwidth that is large for the size, where the method
/// would have to find most of the roots, and where the check fails.
template <class Scalar>
std::optional<LowestRoots> lowestRoots(const BandedPencil<Scalar>& pencil, std::size_t count);

/// Those within a circle of at least this radius.
template <class Scalar>
std::optional<LowestRoots> rootsWithin(const BandedPencil<Scalar>& pencil, double radius);

extern template struct BandedPencil<double>;
extern template struct BandedPencil<std::complex<double>>;
extern template std::optional<LowestRoots> lowestRoots(const BandedPencil<double>&, std::size_t);
extern template std::optional<LowestRoots> lowestRoots(const BandedPencil<std::complex<double>>&,
                                                       std::size_t);
extern template std::optional<LowestRoots> rootsWithin(const BandedPencil<double>&, double);
extern template std::optional<LowestRoots> rootsWithin(const BandedPencil<std::complex<double>>&,
                                                       double);

}  // namespace whirl_twin
