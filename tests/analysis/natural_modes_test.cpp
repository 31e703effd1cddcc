// Natural frequencies, rigid-body modes, influence coefficients, and the bounds of the lowest
// frequency: Dunkerley's formula <= exact <= Rayleigh and Ritz.
#include "analysis/natural_modes.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "analysis/approximate_frequencies.h"
#include "analysis/frequency_response.h"
#include "messages/input_error.h"
#include "random_systems.h"

namespace whirl_twin {
namespace natural_modes_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Roundings of sums of ten terms with conditions to 1e4.
constexpr double kRounding = 1e-10;

template <class F>
std::string messageOf(const F& refused) {
  try {
    refused();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

bool mentions(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

TEST(NaturalModes, OfRandomSystemsSatisfyTheEquationsAndAreMassNormalised) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 1 + trial % 8;
    const RandomSystem s = randomSystem(n, random);
    const NaturalModes modes = naturalModes(s.mass, s.stiffness);
    EXPECT_EQ(modes.rigid_body_modes, 0);
    const MatrixXd& phi = modes.shapes;
    const VectorXd squares = modes.frequencies.cwiseAbs2();
    EXPECT_TRUE((phi.transpose() * s.mass * phi).isIdentity(kRounding));
    const MatrixXd left = s.stiffness * phi - s.mass * phi * squares.asDiagonal();
    EXPECT_LT(left.norm(), kRounding * (s.mass * phi * squares.asDiagonal()).norm());
    for (int i = 1; i < n; ++i) {
      EXPECT_LE(modes.frequencies[i - 1], modes.frequencies[i]);
    }
  }
}

TEST(NaturalModes, LowModesKeepTheirDigitsBesideHighOnes) {
  // Two uncoupled oscillators of 1 and 1e9 rad/s, seen in other coordinates.
  MatrixXd turn(2, 2);
  turn << 0.6, 0.8, -0.8, 0.6;
  const MatrixXd shapes = turn * Eigen::Vector2d(1.0, 1e-3).asDiagonal();
  const MatrixXd mass = shapes.transpose() * shapes;
  const MatrixXd stiffness = Eigen::Vector2d(1.0, 1e12).asDiagonal();
  const NaturalModes modes = naturalModes(mass, stiffness);
  // det K / det M and the trace of M^-1 K are p1^2 p2^2 and p1^2 + p2^2.
  const double product = 1e6 / 1e-3;
  EXPECT_NEAR(modes.frequencies[0] * modes.frequencies[1] / product, 1.0, 1e-13);
}

TEST(NaturalModes, OfABeamWithoutSupportsHaveTwoOfZeroFrequency) {
  for (const double stiffness : {1e-6, 100.0, 1e12}) {
    for (int n = 3; n <= 40; ++n) {
      const NaturalModes modes =
          naturalModes(MatrixXd::Identity(n, n), stiffness * freeBeamStiffness(n));
      ASSERT_EQ(modes.rigid_body_modes, 2) << n;
      EXPECT_EQ(modes.frequencies[0], 0.0);
      EXPECT_EQ(modes.frequencies[1], 0.0);
      EXPECT_GT(modes.frequencies[2], 0.0);
      EXPECT_TRUE((modes.shapes.transpose() * modes.shapes).isIdentity(kRounding));
    }
  }
}

TEST(NaturalModes, ThreeMassesInABeamVibrateAtTheClosedForm) {
  // p3^2 = k (1 / m1 + 4 / m2 + 1 / m3), whatever the masses: with clamps as heavy as they like.
  for (const double middle : {1e-6, 1.0, 1e3, 1e6}) {
    const Eigen::Vector3d m(1.0, middle, 3.0);
    const NaturalModes modes = naturalModes(m.asDiagonal(), 100.0 * freeBeamStiffness(3));
    EXPECT_EQ(modes.rigid_body_modes, 2);
    const double expected = std::sqrt(100.0 * (1.0 / m[0] + 4.0 / m[1] + 1.0 / m[2]));
    EXPECT_NEAR(modes.frequencies[2], expected, 1e-12 * expected);
  }
}

TEST(NaturalModes, TheLargeFreeBeamTendsToTheContinuousOne) {
  // (beta L)^2 = p L^2 sqrt(m / EI), first elastic root 4.730041; the error falls like 1 / n^2.
  const auto root = [](int n) {
    const NaturalModes modes = naturalModes(MatrixXd::Identity(n, n), freeBeamStiffness(n));
    return n * std::sqrt(modes.frequencies[2]);
  };
  const double exact = 4.730040744862704;
  const double coarse = std::abs(root(20) - exact);
  const double fine = std::abs(root(60) - exact);
  EXPECT_LT(fine, 0.02);
  EXPECT_LT(fine, coarse / 2.5);
}

TEST(NaturalModes, AFreeMassHasOnlyRigidBodyModes) {
  const NaturalModes modes = naturalModes(2.0 * MatrixXd::Identity(2, 2), MatrixXd::Zero(2, 2));
  EXPECT_EQ(modes.rigid_body_modes, 2);
  EXPECT_TRUE((2.0 * modes.shapes.transpose() * modes.shapes).isIdentity(kRounding));
}

TEST(NaturalModes, SayWhyTheyAreRefused) {
  const MatrixXd one = MatrixXd::Identity(2, 2);
  const MatrixXd tilted = Eigen::Vector2d(1.0, -1.0).asDiagonal();
  const MatrixXd massless = Eigen::Vector2d(1.0, 0.0).asDiagonal();
  MatrixXd skewed = one;
  skewed(0, 1) = 0.5;
  EXPECT_THROW(naturalModes(massless, one), InputError);
  EXPECT_THROW(naturalModes(tilted, one), InputError);
  EXPECT_THROW(naturalModes(one, skewed), InputError);
  EXPECT_THROW(naturalModes(one, MatrixXd::Identity(3, 3)), std::logic_error);
  EXPECT_THROW(naturalModes(one, NAN * one), InputError);
  EXPECT_THROW(naturalModes(one, tilted), RunFailure);
  EXPECT_PRED2(mentions, messageOf([&] { naturalModes(massless, one); }), "zero for some motion");
  EXPECT_PRED2(mentions, messageOf([&] { naturalModes(one, tilted); }), "statically unstable");
}

TEST(RigidBodyModes, AreTheMotionsThatTheStiffnessDoesNotResist) {
  const MatrixXd stiffness = freeBeamStiffness(7);
  const MatrixXd motions = rigidBodyModes(stiffness);
  ASSERT_EQ(motions.cols(), 2);
  EXPECT_LT((stiffness * motions).norm(), 1e-13);
  EXPECT_TRUE((motions.transpose() * motions).isIdentity(1e-13));
  // Heave and pitch are among them.
  for (const VectorXd& motion :
       {VectorXd(VectorXd::Ones(7)), VectorXd(VectorXd::LinSpaced(7, 0, 6))}) {
    EXPECT_LT((motion - motions * (motions.transpose() * motion)).norm(), 1e-12);
  }
}

TEST(RigidBodyModes, DoNotDependOnTheUnitsOfTheCoordinates) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const VectorXd units = Eigen::Vector4d(1.0, unit, unit * unit, 1.0);
    const MatrixXd stiffness = units.asDiagonal() * freeBeamStiffness(4) * units.asDiagonal();
    EXPECT_EQ(definiteness(stiffness, "stiffness"), Definiteness::kPositiveSemidefinite);
    EXPECT_EQ(rigidBodyModes(stiffness).cols(), 2);
  }
}

TEST(RigidBodyModes, AWeakSupportIsASupport) {
  // The softest ground springs at both ends exclude free motion.
  MatrixXd stiffness = freeBeamStiffness(4);
  stiffness(0, 0) += 1e-8;
  stiffness(3, 3) += 1e-8;
  EXPECT_EQ(definiteness(stiffness, "stiffness"), Definiteness::kPositiveDefinite);
  EXPECT_EQ(rigidBodyModes(stiffness).cols(), 0);
}

TEST(InfluenceCoefficients, AreDeflectionsUnderUnitForces) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 1 + trial % 8;
    const MatrixXd stiffness = randomSystem(n, random).stiffness;
    const MatrixXd a = influenceCoefficients(stiffness);
    EXPECT_TRUE((stiffness * a).isIdentity(kRounding));
    EXPECT_EQ(a, a.transpose());  // Maxwell: i under a force on j as j under one on i
    const VectorXd load = randomVector(n, random);
    const VectorXd deflection = staticDeflection(stiffness, load);
    // Energy stored: half the work of the load, in either form.
    const double energy = 0.5 * deflection.dot(stiffness * deflection);
    EXPECT_NEAR(0.5 * load.dot(a * load), energy, kRounding * energy);
  }
}

TEST(InfluenceCoefficients, DoNotExistWithoutSupports) {
  const MatrixXd free = freeBeamStiffness(5);
  EXPECT_THROW(influenceCoefficients(free), RunFailure);
  EXPECT_THROW(staticDeflection(free, VectorXd::Ones(5)), RunFailure);
  EXPECT_THROW(dunkerleyBound(MatrixXd::Identity(5, 5), free), RunFailure);
  const std::string message = messageOf([&] { influenceCoefficients(free); });
  EXPECT_PRED2(mentions, message, "2 rigid-body modes");
  EXPECT_PRED2(mentions, message, "accelerates the system instead of deflecting it");
}

TEST(Bounds, DunkerleyThenExactThenRitz) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 400; ++trial) {
    const int n = 2 + trial % 7;
    const RandomSystem s = randomSystem(n, random, trial % 2 == 0);
    const double exact = naturalModes(s.mass, s.stiffness).frequencies[0];
    EXPECT_LT(dunkerleyBound(s.mass, s.stiffness).frequency, exact);
    const VectorXd shape = randomVector(n, random);
    const double rayleigh = rayleighFrequency(s.mass, s.stiffness, shape);
    EXPECT_GE(rayleigh, exact * (1.0 - kRounding));
    // An additional shape never raises the estimate; n shapes give the exact modes.
    MatrixXd shapes = shape;
    VectorXd before = VectorXd::Constant(1, rayleigh);
    while (shapes.cols() < n) {
      shapes.conservativeResize(Eigen::NoChange, shapes.cols() + 1);
      shapes.rightCols(1) = randomVector(n, random);
      const VectorXd p = ritzModes(s.mass, s.stiffness, shapes).assumed.frequencies;
      for (Eigen::Index i = 0; i < before.size(); ++i) {
        EXPECT_LE(p[i], before[i] * (1.0 + 1e-8));
      }
      before = p;
    }
    // Random shapes may be nearly dependent (condition to 1e4): eight digits remain.
    EXPECT_LT((before - naturalModes(s.mass, s.stiffness).frequencies).norm(),
              1e-8 * before.norm());
  }
}

TEST(Bounds, WithOneCoordinateAllAreExact) {
  const MatrixXd mass = MatrixXd::Constant(1, 1, 2.0);
  const MatrixXd stiffness = MatrixXd::Constant(1, 1, 50.0);
  EXPECT_DOUBLE_EQ(dunkerleyBound(mass, stiffness).frequency, 5.0);
  EXPECT_DOUBLE_EQ(rayleighFrequency(mass, stiffness, VectorXd::Ones(1)), 5.0);
  EXPECT_DOUBLE_EQ(naturalModes(mass, stiffness).frequencies[0], 5.0);
}

TEST(Bounds, EachTermOfDunkerleyIsTheSystemWithOneMassAlone) {
  std::mt19937 random(4);
  const RandomSystem s = randomSystem(4, random, true);
  const DunkerleyBound bound = dunkerleyBound(s.mass, s.stiffness);
  for (int i = 0; i < 4; ++i) {
    // With the other masses a billion times lighter only one low mode remains.
    MatrixXd alone = 1e-9 * s.mass;
    alone(i, i) = s.mass(i, i);
    const double p = naturalModes(alone, s.stiffness).frequencies[0];
    EXPECT_NEAR(1.0 / (p * p), bound.terms[i], 1e-4 * bound.terms[i]);
  }
}

TEST(Rayleigh, TheModeItselfGivesItsFrequencyAndAnErrorEntersSquared) {
  std::mt19937 random(5);
  const RandomSystem s = randomSystem(5, random);
  const NaturalModes modes = naturalModes(s.mass, s.stiffness);
  const VectorXd first = modes.shapes.col(0);
  const VectorXd wrong = modes.shapes.col(3);
  const double exact = modes.frequencies[0];
  const auto excess = [&](double error) {
    return rayleighFrequency(s.mass, s.stiffness, first + error * wrong) - exact;
  };
  EXPECT_NEAR(excess(0.0), 0.0, kRounding * exact);
  EXPECT_NEAR(excess(1e-3) / excess(1e-4), 100.0, 0.1);
}

TEST(Rayleigh, ARigidBodyShapeHasNoFrequencyAndAnUnstableOneIsRefused) {
  const MatrixXd mass = MatrixXd::Identity(5, 5);
  EXPECT_NEAR(rayleighFrequency(mass, freeBeamStiffness(5), VectorXd::LinSpaced(5, 0.1, 0.7)), 0.0,
              1e-7);
  EXPECT_THROW(rayleighFrequency(mass, -mass, VectorXd::Ones(5)), RunFailure);
  EXPECT_THROW(rayleighFrequency(mass, mass, VectorXd::Zero(5)), InputError);
  EXPECT_THROW(rayleighFrequency(mass, mass, VectorXd::Ones(4)), std::logic_error);
}

TEST(AssumedModes, LinearlyDependentShapesAreRefused) {
  MatrixXd shapes(3, 2);
  shapes << 1.0, 2.0, 2.0, 4.0, 3.0, 6.0;
  const MatrixXd one = MatrixXd::Identity(3, 3);
  EXPECT_THROW(ritzModes(one, one, shapes), InputError);
  EXPECT_PRED2(mentions, messageOf([&] { ritzModes(one, one, shapes); }), "linearly independent");
  EXPECT_THROW(ritzModes(one, one, MatrixXd::Zero(3, 1)), InputError);
  EXPECT_THROW(ritzModes(one, one, MatrixXd::Ones(2, 1)), InputError);
}

TEST(AssumedModes, EveryMatrixIsReduced) {
  std::mt19937 random(6);
  Linearization system;
  for (MatrixXd* matrix : {&system.mass, &system.damping, &system.gyroscopic, &system.stiffness,
                           &system.circulatory}) {
    *matrix = MatrixXd(randomVector(9, random).reshaped(3, 3));
  }
  const MatrixXd shapes = randomVector(6, random).reshaped(3, 2);
  const Linearization small = reduced(system, shapes);
  const VectorXd eta = randomVector(2, random);
  const VectorXd q = shapes * eta;
  // The energy and work of a motion are the same in modal amplitudes.
  EXPECT_NEAR(eta.dot(small.mass * eta), q.dot(system.mass * q), 1e-12);
  EXPECT_NEAR(eta.dot(small.damping * eta), q.dot(system.damping * q), 1e-12);
  EXPECT_NEAR(eta.dot(small.gyroscopic * eta), q.dot(system.gyroscopic * q), 1e-12);
  EXPECT_NEAR(eta.dot(small.stiffness * eta), q.dot(system.stiffness * q), 1e-12);
  EXPECT_NEAR(eta.dot(small.circulatory * eta), q.dot(system.circulatory * q), 1e-12);
}

}  // namespace natural_modes_test
}  // namespace whirl_twin
