#include "algebra/banded_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "algebra/dense.h"
#include "analysis/banded_rotor.h"
#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {
namespace banded_matrix_test {

using Complex = std::complex<double>;

/// Entries without a pattern; the small diagonal requires pivoting.
template <class Scalar>
Eigen::Matrix<Scalar, -1, -1> chain(Eigen::Index size, Eigen::Index width, Scalar turn) {
  Eigen::Matrix<Scalar, -1, -1> a = Eigen::Matrix<Scalar, -1, -1>::Zero(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      if (std::abs(i - j) <= width) {
        a(i, j) = std::sin(1.7 * static_cast<double>(i * i) + 2.3 * static_cast<double>(j)) +
                  turn * std::cos(0.9 * static_cast<double>(i) - 1.1 * static_cast<double>(j * j));
      }
    }
    a(i, i) *= 1.0e-3;
  }
  return a;
}

template <class Scalar>
void solvesAsDenseDoes(Eigen::Index size, Eigen::Index width, Scalar turn) {
  const auto a = chain<Scalar>(size, width, turn);
  const auto banded = BandedMatrix<Scalar>::of(a);
  EXPECT_EQ(banded.width(), width);
  EXPECT_EQ(banded.dense(), a);
  const Eigen::Matrix<Scalar, -1, -1> x = chain<Scalar>(size, size, turn).leftCols(3);
  const Eigen::Matrix<Scalar, -1, -1> b = a * x;
  EXPECT_LE((banded.times(x) - b).norm(), 1.0e-14 * b.norm());
  const BandedLU<Scalar> lu(banded);
  const double condition = 1.0 / Eigen::PartialPivLU<Eigen::Matrix<Scalar, -1, -1>>(a).rcond();
  EXPECT_LE((lu.solve(b) - x).norm(), 1.0e-14 * condition * x.norm());
}

TEST(BandedMatrix, SolvesAsADenseOneDoes) {
  for (const Eigen::Index width : {1, 7, 19}) {
    solvesAsDenseDoes<double>(20, width, 0.4);
    solvesAsDenseDoes<Complex>(20, width, Complex(0.2, 0.8));
  }
  solvesAsDenseDoes<double>(101, 7, 0.4);
  solvesAsDenseDoes<Complex>(101, 7, Complex(0.2, 0.8));
}

TEST(BandedMatrix, ASingularOneIsToldAndSolvesNothing) {
  Eigen::MatrixXd a = chain<double>(9, 2, 0.4);
  a.col(4).setZero();
  const BandedLU<double> lu(BandedMatrix<double>::of(a));
  EXPECT_TRUE(lu.singular());
  EXPECT_FALSE(lu.solve(Eigen::VectorXd::Ones(9)).allFinite());
}

TEST(BandedMatrix, HasACholeskyFactorizationWhereItIsPositiveDefinite) {
  const Eigen::MatrixXcd a = chain<Complex>(30, 3, Complex(0.2, 0.8));
  const Eigen::MatrixXcd positive = a * a.adjoint();
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(positive).eigenvalues().minCoeff();
  for (const double part : {0.99, 1.01}) {
    Eigen::MatrixXcd shifted = positive;
    shifted.diagonal().array() -= part * least;
    EXPECT_EQ(hasCholesky(BandedMatrix<Complex>::of(shifted)), part < 1.0);
  }
}

TEST(BandedRotor, HasTheMatricesOfItsRotorAtAnySpeed) {
  FlexibleShaft shaft;
  shaft.material = {2.11e11, 8.1e10, 7810.0};
  shaft.internal_damping = 1.0e-5;
  shaft.elements.assign(9, {0.1, 0.05, 0.0});
  shaft.discs = {{4, 10.0, 0.2, 0.12}};
  RotorBearing bearing;
  bearing.coefficients = {1.0e6, 2.0e5, -3.0e5, 2.0e6, 100.0, 10.0, -5.0, 200.0};
  shaft.bearings = {bearing};
  shaft.speed_bearings = {{9,
                           [&](double speed) {
                             BearingCoefficients b = bearing.coefficients;
                             b.kxy = 1.0e3 * speed;
                             return b;
                           },
                           {}}};
  const LinearRotor rotor = RotorAssembly(shaft).linearRotor();
  const BandedRotor found(rotor);
  for (const double speed : {0.0, 350.0}) {
    const Linearization l = rotor.matrices(speed);
    const BandedLinearization b = found.matrices(speed);
    EXPECT_EQ(b.mass.dense(), l.mass);
    EXPECT_EQ(b.damping.dense(), l.damping);
    EXPECT_EQ(b.gyroscopic.dense(), l.gyroscopic);
    EXPECT_EQ(b.stiffness.dense(), l.stiffness);
    EXPECT_EQ(b.circulatory.dense(), l.circulatory);
    EXPECT_LE(b.stiffness.width(), 7);
  }
}

}  // namespace banded_matrix_test
}  // namespace whirl_twin
