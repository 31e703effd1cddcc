// A uniform cantilever in assumed modes: bounds of the exact frequencies, the notes' two-term
// example, static deflections, and the condition of the basis.
#include "analysis/cantilever_modes.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "algebra/dense.h"
#include "analysis/natural_modes.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace cantilever_modes_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// (beta L)^2, cosh(beta L) cos(beta L) = -1.
constexpr double kFirst = 3.5160152685001513;
constexpr double kSecond = 22.03449156466677;
constexpr double kThird = 61.69721441359553;

NaturalModes modesOf(const CantileverModes& beam) {
  return naturalModes(beam.mass, beam.stiffness);
}

TEST(CantileverModes, FrequenciesFallToThoseOfTheBeam) {
  double first = INFINITY;
  double second = INFINITY;
  for (int count = 1; count <= CantileverModes::kMost; ++count) {
    const VectorXd p = modesOf(cantileverModes(1.0, 1.0, 1.0, count)).frequencies;
    // The bounds hold, and fall, to the rounding of a frequency: the highest is 9e5.
    EXPECT_GE(p[0], kFirst * (1.0 - 1e-13)) << count;
    EXPECT_LE(p[0], first * (1.0 + 1e-13)) << count;
    first = p[0];
    if (count > 1) {
      EXPECT_GE(p[1], kSecond * (1.0 - 1e-13)) << count;
      EXPECT_LE(p[1], second * (1.0 + 1e-13)) << count;
      second = p[1];
    }
  }
  EXPECT_NEAR(first, kFirst, 1e-13 * kFirst);
  EXPECT_NEAR(second, kSecond, 1e-13 * kSecond);
  const VectorXd p = modesOf(cantileverModes(1.0, 1.0, 1.0, 12)).frequencies;
  EXPECT_NEAR(p[0], kFirst, 1e-12 * kFirst);
  EXPECT_NEAR(p[1], kSecond, 1e-11 * kSecond);
  EXPECT_NEAR(p[2], kThird, 1e-7 * kThird);
}

TEST(CantileverModes, FrequenciesScaleWithTheBeam) {
  const double m = 2.0;
  const double length = 1.5;
  const double bending = 50.0;
  const VectorXd p = modesOf(cantileverModes(m, length, bending, 10)).frequencies;
  const double unit = std::sqrt(bending / (m * std::pow(length, 4)));
  EXPECT_NEAR(p[0], kFirst * unit, 1e-9 * p[0]);
}

TEST(CantileverModes, SpanWhatTheNotesMonomialsSpan) {
  // m_ij = 1 / (i + j + 5), k_ij from the second derivatives of xi^(i + 2); well enough conditioned
  // up to five.
  for (int count = 1; count <= 5; ++count) {
    MatrixXd mass(count, count);
    MatrixXd stiffness(count, count);
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) {
        mass(i, j) = 1.0 / (i + j + 5);
        stiffness(i, j) = (i + 2.0) * (i + 1) * (j + 2) * (j + 1) / (i + j + 1.0);
      }
    }
    const VectorXd notes = naturalModes(mass, stiffness).frequencies;
    const CantileverModes beam = cantileverModes(1.0, 1.0, 1.0, count);
    const NaturalModes modes = modesOf(beam);
    EXPECT_LT((modes.frequencies - notes).norm(), 1e-9 * notes.norm());
    // The shape is the same in both.
    const VectorXd q = modes.shapes.col(0);
    const VectorXd c = beam.monomials(q);
    for (const double x : {0.0, 0.3, 0.77, 1.0}) {
      double sum = 0.0;
      for (int j = count - 1; j >= 0; --j) {
        sum = sum * x + c[j];
      }
      EXPECT_NEAR(sum * x * x, q.dot(beam.shapes(x)), 1e-12);
    }
  }
}

TEST(CantileverModes, MatricesAreTheIntegralsOfTheShapes) {
  // Simpson's rule on 2000 intervals: error of the order 1e-10 for these polynomials.
  const CantileverModes beam = cantileverModes(2.0, 1.5, 50.0, 6);
  MatrixXd mass = MatrixXd::Zero(6, 6);
  MatrixXd stiffness = MatrixXd::Zero(6, 6);
  VectorXd integral = VectorXd::Zero(6);
  const int intervals = 2000;
  for (int i = 0; i <= intervals; ++i) {
    const double x = 1.5 * i / intervals;
    const double weight = 1.5 / intervals / 3.0 *
                          (i == 0 || i == intervals ? 1.0
                           : i % 2 == 1             ? 4.0
                                                    : 2.0);
    mass += weight * 2.0 * beam.shapes(x) * beam.shapes(x).transpose();
    stiffness += weight * 50.0 * beam.curvatures(x) * beam.curvatures(x).transpose();
    integral += weight * beam.shapes(x);
  }
  EXPECT_LT((mass - beam.mass).norm(), 1e-7 * beam.mass.norm());
  EXPECT_LT((stiffness - beam.stiffness).norm(), 1e-7 * beam.stiffness.norm());
  EXPECT_LT((integral - beam.integral).norm(), 1e-7 * beam.integral.norm());
}

TEST(CantileverModes, SlopesAndCurvaturesAreDerivativesOfTheShapes) {
  const CantileverModes beam = cantileverModes(1.0, 2.0, 1.0, 8);
  const double step = 1e-5;  // central differences: step^2 times the third derivative, near 1e4
  for (const double x : {0.1, 0.9, 1.7}) {
    const VectorXd slope = (beam.shapes(x + step) - beam.shapes(x - step)) / (2.0 * step);
    const VectorXd curvature = (beam.slopes(x + step) - beam.slopes(x - step)) / (2.0 * step);
    EXPECT_LT((slope - beam.slopes(x)).norm(), 1e-5);
    EXPECT_LT((curvature - beam.curvatures(x)).norm(), 1e-4);
  }
  EXPECT_TRUE(beam.shapes(0.0).isZero(0.0));  // clamped
  EXPECT_TRUE(beam.slopes(0.0).isZero(0.0));
  EXPECT_TRUE(beam.shapes(2.0).isApprox(beam.tip, 1e-14));
  EXPECT_DOUBLE_EQ(beam.shape(3, 0.9), beam.shapes(0.9)[3]);
}

TEST(CantileverModes, TwoShapesGiveTheExactDeflectionUnderATipLoad) {
  for (const int count : {2, 5, 20, 40}) {
    const CantileverModes beam = cantileverModes(2.0, 1.5, 50.0, count);
    const VectorXd q = Cholesky(beam.stiffness).solve(3.0 * beam.shapes(1.5));
    // F L^3 / 3 EI at the tip, F x^2 (3 L - x) / 6 EI along the beam, a slope of F L^2 / 2 EI.
    EXPECT_NEAR(q.dot(beam.tip), 3.0 * 1.5 * 1.5 * 1.5 / (3.0 * 50.0), 1e-12) << count;
    EXPECT_NEAR(q.dot(beam.shapes(0.6)), 3.0 * 0.36 * (4.5 - 0.6) / (6.0 * 50.0), 1e-12) << count;
    EXPECT_NEAR(q.dot(beam.slopes(1.5)), 3.0 * 2.25 / (2.0 * 50.0), 1e-11) << count;
  }
}

TEST(CantileverModes, ALoadAtXBendsTheBeamAsInHandbooks) {
  // The tip moves by F a^2 (3 L - a) / 6 EI under a force at a. Its shear jumps there: slow to
  // come.
  const double a = 0.7;
  const double exact = 3.0 * a * a * (4.5 - a) / (6.0 * 50.0);
  double before = INFINITY;
  for (const int count : {3, 10, 40}) {
    const CantileverModes beam = cantileverModes(2.0, 1.5, 50.0, count);
    const double tip = beam.tip.dot(Cholesky(beam.stiffness).solve(3.0 * beam.shapes(a)));
    EXPECT_LE(std::abs(tip - exact), before);
    before = std::abs(tip - exact) + 1e-12;
  }
  EXPECT_LT(before, 1e-6 * exact);
}

TEST(CantileverModes, TheSelfWeightDeflectsAsInHandbooks) {
  // m g L^4 / 8 EI, exact with three shapes: x^2, x^3, x^4.
  const CantileverModes beam = cantileverModes(2.0, 1.5, 50.0, 3);
  const VectorXd q = Cholesky(beam.stiffness).solve(2.0 * 9.81 * beam.integral);
  EXPECT_NEAR(q.dot(beam.tip), 2.0 * 9.81 * std::pow(1.5, 4) / (8.0 * 50.0), 1e-12);
}

TEST(CantileverModes, TheBasisIsWellConditioned) {
  const auto condition = [](const MatrixXd& matrix) {
    const VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
    const VectorXd e =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(scale.asDiagonal() * matrix * scale.asDiagonal())
            .eigenvalues();
    return e.maxCoeff() / e.minCoeff();
  };
  const CantileverModes beam = cantileverModes(2.0, 1.5, 50.0, 20);
  EXPECT_TRUE(beam.mass.isDiagonal(0.0));
  EXPECT_LT(beam.mass.diagonal().maxCoeff() / beam.mass.diagonal().minCoeff(), 10.0);
  EXPECT_LT(condition(beam.stiffness), 1e4);  // each shape scaled to unit stiffness
}

TEST(CantileverModes, RefuseWhatIsNoBeam) {
  EXPECT_THROW(cantileverModes(0.0, 1.0, 1.0, 2), InputError);
  EXPECT_THROW(cantileverModes(1.0, -1.0, 1.0, 2), InputError);
  EXPECT_THROW(cantileverModes(1.0, 1.0, NAN, 2), InputError);
  EXPECT_THROW(cantileverModes(1.0, 1.0, 1.0, 0), InputError);
  EXPECT_THROW(cantileverModes(1.0, 1.0, 1.0, 41), InputError);
  const CantileverModes beam = cantileverModes(1.0, 1.0, 1.0, 2);
  EXPECT_THROW(beam.shapes(1.0001), InputError);
  EXPECT_THROW(beam.shapes(NAN), InputError);
  EXPECT_THROW(beam.monomials(VectorXd::Ones(3)), InputError);
}

}  // namespace cantilever_modes_test
}  // namespace whirl_twin
