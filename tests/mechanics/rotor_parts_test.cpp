// Rotor elements other than shaft, discs and bearings, against closed forms: torque, couplings,
// modal damping, speed-dependent pedestals.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "algebra/dense.h"
#include "mechanics/rotors/bearing_laws.h"
#include "mechanics/rotors/modal_damping.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "reference_rotors.h"

namespace whirl_twin {
namespace rotor_parts_test {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr Complex kTurn{0.0, 1.0};

/// Without shear.
FlexibleShaft evenShaft(int elements, double length, double torque) {
  FlexibleShaft shaft;
  shaft.material = {2.0e11, 8.0e10, 7800.0, false};
  ShaftSection section{length / elements, 0.04, 0.0};
  section.torque = torque;
  shaft.elements.assign(static_cast<std::size_t>(elements), section);
  return shaft;
}

double bendingStiffness(const FlexibleShaft& shaft) {
  return shaft.material.youngs_modulus * shaft.elements[0].secondMoment();
}

/// K + N at rest without the first `fixed` coordinates.
MatrixXd heldAtTheStart(const FlexibleShaft& shaft, Index fixed) {
  const Linearization l = RotorAssembly(shaft).matrices(0.0);
  const Index n = l.mass.rows() - fixed;
  return (l.stiffness + l.circulatory).bottomRightCorner(n, n);
}

// Between pins it buckles at T = 2 pi EI / l (Greenhill, Proc. Institution of Mechanical Engineers,
// 1883): a whole turn of a screw line.
TEST(RotorParts, aTorqueBucklesAShaftBetweenPins) {
  const double length = 1.2;
  const auto lowest = [&](double share, int elements) {
    FlexibleShaft shaft = evenShaft(elements, length, 0.0);
    const double torque = share * 2.0 * kPi * bendingStiffness(shaft) / length;
    const RotorAssembly rotor(evenShaft(elements, length, torque));
    const Index n = rotor.dof();
    MatrixXd kept(n, n - 4);
    kept << MatrixXd::Identity(n, n).middleCols(2, n - 6), MatrixXd::Identity(n, n).rightCols(2);
    const Linearization l = rotor.in(kept).matrices(0.0);
    return eigenvalues(Lu(l.mass).solve(l.stiffness + l.circulatory)).values.real().minCoeff();
  };
  const double without = lowest(0.0, 12);
  for (const double sense : {1.0, -1.0}) {
    EXPECT_GT(lowest(0.99 * sense, 12), 1e-3 * without);
    EXPECT_LT(std::fabs(lowest(sense, 12)), 3e-4 * without);
    EXPECT_LT(lowest(1.01 * sense, 12), -1e-3 * without);
  }
}

// Clamped, with a torque T and a force F along x at the free end: EI w'' = F (l - z) + i T w'. The
// torque, x towards y, carries the end towards +y.
TEST(RotorParts, aTorqueCarriesAForcedEndAside) {
  const double length = 0.9;
  const double force = 50.0;
  const double bending = bendingStiffness(evenShaft(1, length, 0.0));
  const double torque = 1.1 * bending / length;
  const FlexibleShaft shaft = evenShaft(16, length, torque);
  const MatrixXd k = heldAtTheStart(shaft, 4);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(k.rows());
  load[k.rows() - 4] = force;
  const Eigen::VectorXd q = k.lu().solve(load);

  const Complex by = kTurn * torque / bending;
  const Complex slope = 1.0 / by;
  const Complex constant = (slope - length) / by;
  const Complex wanted = force / bending *
                         (constant * length + 0.5 * slope * length * length -
                          constant * (std::exp(by * length) - 1.0) / by);
  const Complex found(q[k.rows() - 4], q[k.rows() - 3]);
  EXPECT_GT(wanted.imag(), 0.1 * wanted.real());
  EXPECT_LT(std::abs(found - wanted), 1e-5 * std::abs(wanted));
}

// The asymmetric part of a torque acts where it enters and leaves, T/2 between the two rotations.
TEST(RotorParts, aTorqueThatGoesOnTakesNothingFromTheNodesBetween) {
  FlexibleShaft shaft = evenShaft(6, 1.0, 300.0);
  shaft.elements[2].outer_growth = 0.01;  // a cone among them
  shaft.material.shear_deformation = true;
  const MatrixXd n = RotorAssembly(shaft).matrices(0.0).circulatory;
  MatrixXd wanted = MatrixXd::Zero(n.rows(), n.cols());
  const Index last = n.rows() - 2;
  // of (alpha, beta): the slopes are beta along x, -alpha along y
  wanted(2, 3) = -150.0;
  wanted(last, last + 1) = 150.0;
  wanted -= wanted.transpose().eval();
  EXPECT_LT((n - wanted).norm(), 1e-9 * wanted.norm());
}

// Nicolai (1928): a torque that enters at a free end feeds an undamped whirl. With M = 1 of its
// mode the growth rate is (T/2) |difference of the squares of its slopes where T enters and leaves|
// / 2 w.
TEST(RotorParts, aTorqueFeedsAWhirlWhereItEntersAtAFreeEnd) {
  const double torque = 20.0;
  const auto rotor = [](double twist) {
    FlexibleShaft shaft = evenShaft(6, 1.2, twist);
    shaft.elements[5].torque = 0.0;
    for (const int node : {2, 6}) {
      shaft.bearings.push_back({node, {1.0e8, 0, 0, 1.0e8, 0, 0, 0, 0}});
    }
    shaft.discs = {{0, 8.0, 0.0, 0.02}};
    return RotorAssembly(shaft);
  };
  const Linearization plain = rotor(0.0).matrices(0.0);
  const SymmetricModes<double> modes = generalizedModes(plain.stiffness, plain.mass);
  // Both modes of the pair together span a plane: the squares of their slopes add up.
  const auto slopes = [&](Index node) {
    return modes.vectors.block(4 * node + 2, 0, 2, 2).squaredNorm() / 2.0;
  };
  const double frequency = std::sqrt(modes.values[0]);
  const double wanted = 0.5 * torque * std::fabs(slopes(5) - slopes(0)) / (2.0 * frequency);
  const auto found = whirlEigenvalues(rotor(torque).matrices(0.0));
  EXPECT_NEAR(std::max(found[0].real(), found[1].real()), wanted, 1e-3 * wanted);
  EXPECT_NEAR(std::min(found[0].real(), found[1].real()), -wanted, 1e-3 * wanted);
}

/// Clamped: a shaft, a coupling, a shaft.
FlexibleShaft coupled() {
  FlexibleShaft shaft = evenShaft(3, 1.2, 0.0);
  shaft.elements[1].length = 0.1;
  shaft.elements[1].coupling = ShaftCoupling{2.0e6, 3.0e4};
  shaft.elements[2].length = 0.3;
  return shaft;
}

// l1 = 0.4, lc = 0.1, l2 = 0.3: the joint lies 0.35 from the end.
TEST(RotorParts, aCouplingGivesAcrossAndInBending) {
  const FlexibleShaft shaft = coupled();
  const MatrixXd k = heldAtTheStart(shaft, 4);
  const double bending = bendingStiffness(shaft);
  for (const Index along : {Index{4}, Index{3}}) {  // x and y of the last node, from behind
    const Eigen::VectorXd q = k.lu().solve(Eigen::VectorXd::Unit(k.rows(), k.rows() - along));
    const double wanted =
        (std::pow(0.8, 3) - std::pow(0.4, 3) + std::pow(0.3, 3)) / (3.0 * bending) +
        0.35 * 0.35 / 3.0e4 + 1.0 / 2.0e6;
    EXPECT_NEAR(q[k.rows() - along], wanted, 1e-9 * wanted);
  }
}

TEST(RotorParts, aCouplingResistsNoRigidMotionAndHasNoMass) {
  FlexibleShaft shaft = coupled();
  const ShaftElement with = couplingElement(*shaft.elements[1].coupling, 0.1);
  Eigen::VectorXd turned = Eigen::VectorXd::Zero(8);
  turned[2] = turned[6] = 1.0;
  turned[5] = -0.1;
  EXPECT_LT((with.stiffness * turned).norm(), 1e-12 * with.stiffness.norm());
  EXPECT_EQ(with.mass.norm() + with.gyroscopic.norm(), 0.0);
  // Euler's load of two rigid bars hinged together is 4 k / l: the joint under an axial force.
  ShaftCoupling hinge{1.0e12, 500.0};
  const double length = 0.2;
  const auto stable = [&](double pressed) {
    const ShaftElement e = couplingElement(hinge, length, -pressed);
    const Eigen::Matrix2d between_pins = (e.stiffness + e.of_loads)(
        std::vector<Index>{3, 7}, std::vector<Index>{3, 7});  // beta at both ends
    return between_pins.determinant() > 0.0;
  };
  EXPECT_TRUE(stable(0.999 * 4.0 * 500.0 / length));
  EXPECT_FALSE(stable(1.001 * 4.0 * 500.0 / length));
}

// A disc that a joint holds, k, c_i turning with it, and a damper c_e on the ground: stable up to
// p (1 + c_e / c_i).
TEST(RotorParts, theDampingOfACouplingTurnsWithIt) {
  FlexibleShaft shaft = evenShaft(2, 0.4, 0.0);
  const double inner = 300.0;
  const double outer = 150.0;
  shaft.material.youngs_modulus = 2.0e16;
  shaft.elements[1].coupling = ShaftCoupling{1.0e6, 1.0e12, inner, 0.0};
  shaft.discs = {{2, 100.0, 0.0, 1.0e-3}};
  for (const int node : {0, 1}) {
    shaft.bearings.push_back({node, {1.0e13, 0, 0, 1.0e13, 0, 0, 0, 0}});
  }
  shaft.bearings.push_back({2, {0, 0, 0, 0, outer, 0, 0, outer}});
  const double threshold = std::sqrt(1.0e6 / 100.0) * (1.0 + outer / inner);
  const RotorAssembly rotor(shaft);
  const auto grows = [&](double speed) {
    const auto found = whirlEigenvalues(rotor.matrices(speed));
    return found[0].real() > 0.0 || found[1].real() > 0.0;
  };
  EXPECT_FALSE(grows(0.999 * threshold));
  EXPECT_TRUE(grows(1.001 * threshold));
}

TEST(RotorParts, areDampedByTheirModesAsTold) {
  FlexibleShaft shaft = twoDiscRotor(rotorCase("D01")["parameters"]);
  for (RotorBearing& bearing : shaft.bearings) {
    bearing.coefficients.cxx = bearing.coefficients.cyy = 0.0;
  }
  shaft.modal_damping = {{100.0, 0.01}, {500.0, 0.05}};
  const auto found = whirlEigenvalues(RotorAssembly(shaft).matrices(0.0));
  ASSERT_GE(found.size(), 20u);
  for (const Complex& s : found) {
    const double frequency = std::abs(s);
    const double wanted = frequency < 100.0   ? 0.01
                          : frequency > 500.0 ? 0.05
                                              : 0.01 + 0.04 * (frequency - 100.0) / 400.0;
    EXPECT_NEAR(-s.real() / frequency, wanted, 1e-6) << frequency;
  }
  EXPECT_NEAR(ratioAt(shaft.modal_damping, 300.0), 0.03, 1e-15);
  // It does not turn: nothing is fed by it at any speed.
  EXPECT_EQ(RotorAssembly(shaft).matrices(5000.0).circulatory.norm(), 0.0);
}

// At a speed of the table the rotor is that on constant pedestals.
TEST(RotorParts, pedestalsFollowTheSpeedByTheirTable) {
  FlexibleShaft shaft = twoDiscRotor(rotorCase("D01")["parameters"]);
  const auto coefficientsAt = [](double speed) {
    BearingCoefficients b;
    b.kxx = 4.0e7 - 20.0 * speed * speed;
    b.kyy = 0.5 * b.kxx;
    b.cxx = b.cyy = 1.0e3 + speed;
    return b;
  };
  std::vector<BearingRow> rows;
  for (const double speed : {0.0, 200.0, 500.0, 900.0}) {
    rows.push_back({speed, coefficientsAt(speed)});
  }
  const auto on = [&](const BearingCoefficients& constant, bool over_speed) {
    FlexibleShaft with = shaft;
    RotorPedestal pedestal{with.bearings[0].node, 80.0, 80.0, constant};
    if (over_speed) {
      const SpeedBearing law = tabulatedBearing(pedestal.node, rows);
      pedestal.over_speed = law.coefficients;
      pedestal.knots = law.knots;
    }
    with.pedestals = {pedestal};
    return RotorAssembly(with);
  };
  for (const double speed : {200.0, 500.0}) {
    const auto found = whirlEigenvalues(on({}, true).matrices(speed));
    const auto wanted = whirlEigenvalues(on(coefficientsAt(speed), false).matrices(speed));
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_LT(std::abs(found[i] - wanted[i]), 1e-9 * std::abs(wanted[i]));
    }
  }
  EXPECT_EQ(on({}, true).linearRotor().knots.size(), 4u);
  EXPECT_TRUE(on({}, true).linearRotor().speed_dependent);
}

}  // namespace rotor_parts_test
}  // namespace whirl_twin
