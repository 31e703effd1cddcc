// The linearized matrices are those of the equations of motion: M, C, K symmetric, G, N skew, equal
// to differences of the acceleration, and to the notes' closed forms.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdlib>

#include "../analysis/models_under_test.h"
#include "algebra/dense.h"
#include "random_state.h"

namespace whirl_twin {
namespace linearization_test {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Richardson's combination of central differences, error of order h^4.
template <class F>
Vector slope(const F& f, double h) {
  const auto difference = [&](double d) { return Vector((f(d) - f(-d)) / (2.0 * d)); };
  return (4.0 * difference(0.5 * h) - difference(h)) / 3.0;
}

class LinearizationOf : public testing::TestWithParam<VariantUnderTest> {
 protected:
  LinearizationOf() { std::srand(1904); }  // of Vector::Random(), whatever ran before

  std::mt19937_64 random_{1904};
};

TEST_P(LinearizationOf, HasSymmetricAndSkewParts) {
  for (int i = 0; i < 100; ++i) {
    const RandomState s = randomState(GetParam(), random_);
    const Vector a = s.dynamics->acceleration(s.q, s.v, s.at);
    const Linearization l = s.dynamics->linearization(s.q, s.v, a, s.at);
    EXPECT_EQ(l.mass, l.mass.transpose());
    EXPECT_EQ(l.damping, l.damping.transpose());
    EXPECT_EQ(l.stiffness, l.stiffness.transpose());
    EXPECT_EQ(l.gyroscopic, -l.gyroscopic.transpose());
    EXPECT_EQ(l.circulatory, -l.circulatory.transpose());
    EXPECT_GT(l.mass.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
  }
}

TEST_P(LinearizationOf, IsTheDifferenceOfAccelerations) {
  // R(q, v) = M(q) (a - acceleration(q, v)) vanishes along the motion with q'' = a. Its slopes are
  // K + N and C + G, for any a: also about motions that are not free.
  const double h = 1e-3;  // truncation 1e-12 of the fifth derivative, rounding 1e-13: 2e-9 is ample
  for (int i = 0; i < 100; ++i) {
    const RandomState s = randomState(GetParam(), random_);
    const auto n = s.q.size();
    const Vector free = s.dynamics->acceleration(s.q, s.v, s.at);
    for (const Vector& a : {free, Vector(free + 3.0 * Vector::Random(n))}) {
      const Linearization l = s.dynamics->linearization(s.q, s.v, a, s.at);
      const auto residual = [&](const Vector& q, const Vector& v) {
        const Matrix mass = s.dynamics->linearization(q, v, a, s.at).mass;
        return Vector(mass * (a - s.dynamics->acceleration(q, v, s.at)));
      };
      for (Eigen::Index j = 0; j < n; ++j) {
        const Vector along = Vector::Unit(n, j);
        const Vector by_q = slope([&](double d) { return residual(s.q + d * along, s.v); }, h);
        const Vector by_v = slope([&](double d) { return residual(s.q, s.v + d * along); }, h);
        const Vector k = (l.stiffness + l.circulatory).col(j);
        const Vector c = (l.damping + l.gyroscopic).col(j);
        const double elsewhere = residual(Vector::Ones(n), s.v).norm();  // infinite if singular
        const double size = 1.0 + l.mass.norm() * (1.0 + a.norm() + s.v.squaredNorm()) + k.norm() +
                            c.norm() + (std::isfinite(elsewhere) ? elsewhere : 0.0);
        ASSERT_LT((by_q - k).norm(), 2e-9 * size) << "coordinate " << j;
        ASSERT_LT((by_v - c).norm(), 2e-9 * size) << "rate " << j;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, LinearizationOf, testing::ValuesIn(everyVariant()),
                         [](const auto& test) { return testName(test.param); });

Matrix rows(double a, double b, double c, double d) {
  Matrix m(2, 2);
  m << a, b, c, d;
  return m;
}

void expectNear(const Matrix& found, const Matrix& expected) {
  EXPECT_LT((found - expected).norm(), 1e-14 * (1.0 + expected.norm())) << "found\n"
                                                                        << found << "\nexpected\n"
                                                                        << expected;
}

TEST(LinearizationOfDoublePendulum, IsTheNotesAtAllFourPositionsOfRest) {
  const double m1 = 1.3, m2 = 0.7, l1 = 0.9, l2 = 1.6, c1 = 0.2, c2 = 0.1, g = 9.81;
  const auto pendulum = dynamicsOf("double_pendulum",
                                   {{"mass1", m1},
                                    {"mass2", m2},
                                    {"length1", l1},
                                    {"length2", l2},
                                    {"damping1", c1},
                                    {"damping2", c2}},
                                   g);
  for (const double up1 : {1.0, -1.0}) {
    for (const double up2 : {1.0, -1.0}) {
      const Eigen::Vector2d q(up1 > 0.0 ? 0.0 : M_PI, up2 > 0.0 ? 0.0 : M_PI);
      const Vector zero = Vector::Zero(2);
      const Linearization l = pendulum->linearization(q, zero, zero, {});
      const double coupling = up1 * up2 * l1 * l2 * m2;
      expectNear(l.mass, rows(l1 * l1 * (m1 + m2), coupling, coupling, l2 * l2 * m2));
      expectNear(l.stiffness, rows(up1 * g * l1 * (m1 + m2), 0.0, 0.0, up2 * g * l2 * m2));
      expectNear(l.damping, rows(c1 + c2, -c2, -c2, c2));
      expectNear(l.gyroscopic, Matrix::Zero(2, 2));
      expectNear(l.circulatory, Matrix::Zero(2, 2));
    }
  }
}

TEST(LinearizationOfSpinningPendulum, IsTheNotesHangingStandingAndOnItsCone) {
  const double m = 0.5, l = 0.2032, c = 0.01, g = 9.8044, w = 9.0;
  const auto pendulum =
      dynamicsOf("spinning_pendulum", {{"mass", m}, {"length", l}, {"damping", c}}, g);
  const auto at = [&](double theta) {
    return pendulum->linearization(Vector::Constant(1, theta), Vector::Zero(1), Vector::Zero(1),
                                   {0.0, 0.0, w, 0.0});
  };
  EXPECT_NEAR(at(0.3).mass(0, 0), m * l * l, 1e-16);
  EXPECT_NEAR(at(0.3).damping(0, 0), c, 1e-16);
  EXPECT_NEAR(at(0.0).stiffness(0, 0), l * m * (g - l * w * w), 1e-14);
  EXPECT_NEAR(at(M_PI).stiffness(0, 0), -l * m * (g + l * w * w), 1e-14);
  EXPECT_NEAR(at(std::acos(g / (l * w * w))).stiffness(0, 0),
              m * (l * l * std::pow(w, 4) - g * g) / (w * w), 1e-14);
}

TEST(LinearizationOfRotor, InternalDampingDampsAndCirculates) {
  const double m = 2.0, kx = 200.0, ky = 300.0, cx = 2.0, cy = 3.0, ci = 1.5, w = 17.0;
  const auto rotor = dynamicsOf("jeffcott_rotor",
                                {{"mass", m},
                                 {"stiffness", kx},
                                 {"stiffness_y", ky},
                                 {"damping", cx},
                                 {"damping_y", cy},
                                 {"internal_damping", ci},
                                 {"eccentricity", 0.01},
                                 {"eccentricity_angle", 0.4}},
                                9.81);
  const Vector zero = Vector::Zero(2);
  const Linearization l = rotor->linearization(zero, zero, zero, {0.3, 1.0, w, 4.0});
  expectNear(l.mass, rows(m, 0.0, 0.0, m));
  expectNear(l.damping, rows(cx + ci, 0.0, 0.0, cy + ci));
  expectNear(l.gyroscopic, Matrix::Zero(2, 2));
  expectNear(l.stiffness, rows(kx, 0.0, 0.0, ky));
  // m z'' + (c + ci) z' + (k - i ci w) z = ...: forward whirl is driven, backward whirl is held.
  expectNear(l.circulatory, rows(0.0, ci * w, -ci * w, 0.0));
}

}  // namespace linearization_test
}  // namespace whirl_twin
