// Modes of whirl, their directions and their branches over the speed: reference cases C01 and C04,
// closed forms, and rotors whose modes cross.
#include "analysis/whirl_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/campbell.h"
#include "models_under_test.h"
#include "rotors_under_test.h"

namespace whirl_twin {

namespace whirl_modes_test {

constexpr double kPi = 3.14159265358979323846;

std::vector<double> equallySpaced(double from, double to, int points) {
  std::vector<double> speeds;
  for (int i = 0; i < points; ++i) {
    speeds.push_back(from + (to - from) * i / (points - 1));
  }
  return speeds;
}

std::vector<double> frequencies(const WhirlModes& modes, Whirl whirl) {
  std::vector<double> found;
  for (const WhirlMode& mode : modes.modes) {
    if (mode.whirl == whirl) {
      found.push_back(mode.dampedFrequency());
    }
  }
  return found;
}

TEST(WhirlModes, OfAnOverhungDisc) {
  const auto reference = rotorCase("C01");
  const RotorUnderTest r = matrixRotor(reference);
  for (const auto& row : expectedOf(reference, "whirl_rad_s")) {
    const WhirlModes modes = whirlModes(r.rotor, r.stations, row["Om"]);
    for (const Whirl whirl : {Whirl::kForward, Whirl::kBackward}) {
      const auto found = frequencies(modes, whirl);
      const auto& expected = row[name(whirl)];
      ASSERT_EQ(found.size(), expected.size()) << row;
      for (std::size_t i = 0; i < found.size(); ++i) {
        // The eigenvalues of the 8 x 8 state matrix carry some roundings of the largest, 6000.
        EXPECT_NEAR(found[i], expected[i], 1.0e-9 * expected[i].get<double>()) << row;
      }
    }
  }
}

TEST(WhirlModes, OfARigidRotorInDampedAnisotropicBearings) {
  const auto reference = rotorCase("C04");
  const RotorUnderTest r = matrixRotor(reference);
  for (const auto& row : expectedOf(reference, "modes")) {
    const double speed = row["rpm"].get<double>() * kPi / 30.0;
    const WhirlModes modes = whirlModes(r.rotor, r.stations, speed);
    ASSERT_EQ(modes.modes.size(), 4u);
    EXPECT_TRUE(modes.real_roots.empty());
    for (std::size_t i = 0; i < 4; ++i) {
      const WhirlMode& mode = modes.modes[i];
      const double tolerance = 1.0e-8 * mode.naturalFrequency();
      EXPECT_NEAR(mode.eigenvalue.real(), row["eigenvalues"][i][0], tolerance);
      EXPECT_NEAR(mode.eigenvalue.imag(), row["eigenvalues"][i][1], tolerance);
      EXPECT_NEAR(mode.logDecrement(), row["log_dec"][i], 1.0e-8);
      // At rest each mode is in a plane and has no direction.
      const Whirl expected = speed == 0.0             ? Whirl::kStraight
                             : row["whirl"][i] == "F" ? Whirl::kForward
                                                      : Whirl::kBackward;
      EXPECT_EQ(mode.whirl, expected) << row["rpm"] << " rpm, mode " << i + 1;
      EXPECT_NEAR(mode.orbits[0].major(), 1.0, 1.0e-12);
    }
  }
}

// Forward and backward whirl of an isotropic rotor without gyroscopic moments share one eigenvalue,
// and the solver returns an arbitrary basis of its eigenspace: they must still be separated.
TEST(WhirlModes, OfOneEigenvalueAreToldApartByDirection) {
  const RotorUnderTest r = chainRotor(4, 5.0e5, 1.0, 0.0);
  const WhirlModes modes = whirlModes(r.rotor, r.stations, 100.0);
  ASSERT_EQ(modes.modes.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(modes.modes[i].whirl, i % 2 == 0 ? Whirl::kBackward : Whirl::kForward);
    EXPECT_LT(modes.modes[i].orbits[0].major() - modes.modes[i].orbits[0].minor(), 1.0e-7);
  }
}

TEST(WhirlModes, OverdampedMotionsStandApart) {
  const auto dynamics =
      dynamicsOf("jeffcott_rotor",
                 {{"mass", 1.0}, {"stiffness", 100.0}, {"damping", 25.0}, {"damping_y", 1.0}});
  const WhirlModes modes = whirlModes(dynamics->linearRotor(), dynamics->stations(), 0.0);
  ASSERT_EQ(modes.modes.size(), 1u);
  ASSERT_EQ(modes.real_roots.size(), 2u);
  EXPECT_NEAR(modes.real_roots[0], -20.0, 1.0e-12);
  EXPECT_NEAR(modes.real_roots[1], -5.0, 1.0e-12);
}

// A free rotor drifts: no mode, no failure.
TEST(WhirlModes, OfAFreeRotorLeaveOutItsDrift) {
  const RotorUnderTest r = chainRotor(3, 0.0, 1.0, 0.0);
  const WhirlModes modes = whirlModes(r.rotor, r.stations, 50.0);
  ASSERT_EQ(modes.modes.size(), 4u);
  EXPECT_NEAR(modes.modes[0].dampedFrequency(), std::sqrt(5.0e5), 1.0e-6);
  EXPECT_NEAR(modes.modes[2].dampedFrequency(), std::sqrt(1.5e6), 1.0e-6);
}

// Jeffcott rotor with internal damping: B01's eigenvalues, forward the less damped.
TEST(WhirlModes, OfInternalDamping) {
  for (const std::string id : {"B01", "B03"}) {
    const auto reference = rotorCase(id);
    const auto& p = reference["parameters"];
    const auto dynamics = dynamicsOf("jeffcott_rotor", {{"mass", p["m"]},
                                                        {"stiffness", p["k"]},
                                                        {"damping", p["c_ext"]},
                                                        {"internal_damping", p["c_int"]}});
    for (const auto& row : expectedOf(reference, "eigenvalues")) {
      const WhirlModes modes = whirlModes(dynamics->linearRotor(), dynamics->stations(), row["Om"]);
      for (const WhirlMode& mode : modes.modes) {
        const bool forward = mode.whirl == Whirl::kForward;
        EXPECT_NEAR(mode.eigenvalue.real(), row[name(mode.whirl)][0], 3.0e-10);
        EXPECT_NEAR(std::fabs(mode.eigenvalue.imag()),
                    std::fabs(row[name(mode.whirl)][1].get<double>()), 3.0e-10);
        if (forward) {
          EXPECT_NEAR(mode.logDecrement(), row["log_dec_forward"], 1.0e-11);
        }
      }
    }
  }
}

// The second backward branch of the overhung disc falls to p_22 = 372 rad/s while the first forward
// one rises: they stay apart, each of one direction all the way, and follow the closed form.
TEST(Campbell, BranchesKeepTheirDirectionAndFollowTheClosedForm) {
  const auto reference = rotorCase("C01");
  const RotorUnderTest r = matrixRotor(reference);
  const CampbellDiagram diagram =
      campbell(r.rotor, r.stations, {{0.0, 100.0, 300.0, 600.0, 1000.0, 3000.0}});
  ASSERT_EQ(diagram.branches.size(), 4u);
  const auto rows = expectedOf(reference, "whirl_rad_s");
  for (const auto& branch : diagram.branches) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      EXPECT_EQ(branch[k].whirl, branch[0].whirl);
      const auto& expected = rows[k][name(branch[k].whirl)];
      const std::size_t place = branch[0].frequency < 500.0 ? 0 : 1;
      EXPECT_NEAR(branch[k].frequency, expected[place], 1.0e-9 * expected[place].get<double>());
    }
  }
}

// Two independent discs, one with a large polar moment: its forward branch crosses those of the
// other. By index the branches would be exchanged there.
TEST(Campbell, BranchesCrossWhereTheyAreIndependent) {
  const auto c01 = matrixRotor(rotorCase("C01"));
  RotorUnderTest r;
  r.rotor.matrices = [base = c01.rotor.matrices](double speed) {
    const Linearization one = base(speed);
    Linearization both;
    for (auto m : {&Linearization::mass, &Linearization::damping, &Linearization::gyroscopic,
                   &Linearization::stiffness, &Linearization::circulatory}) {
      both.*m = Eigen::MatrixXd::Zero(6, 6);
      (both.*m).topLeftCorner(4, 4) = one.*m;
    }
    both.mass.bottomRightCorner(2, 2).setIdentity();
    both.stiffness.bottomRightCorner(2, 2).setIdentity();
    both.stiffness.bottomRightCorner(2, 2) *= 220.0 * 220.0;  // between 160 and 313 rad/s
    return both;
  };
  r.rotor.speed_dependent = true;
  r.rotor.load = Eigen::VectorXd::Zero(6);
  r.stations = {{"a", 0.0, Eigen::VectorXd::Unit(6, 0), Eigen::VectorXd::Unit(6, 1)},
                {"b", 1.0, Eigen::VectorXd::Unit(6, 4), Eigen::VectorXd::Unit(6, 5)}};
  const CampbellDiagram diagram = campbell(r.rotor, r.stations, {equallySpaced(0.0, 900.0, 10)});
  ASSERT_EQ(diagram.branches.size(), 6u);
  for (const auto& branch : diagram.branches) {
    const bool constant = std::fabs(branch.front().frequency - 220.0) < 1.0e-6;
    for (std::size_t k = 1; k < branch.size(); ++k) {
      ASSERT_FALSE(std::isnan(branch[k].frequency));
      if (constant) {
        EXPECT_NEAR(branch[k].frequency, 220.0, 1.0e-6);
      } else if (branch[k].whirl == Whirl::kForward) {
        EXPECT_GT(branch[k].frequency, branch[k - 1].frequency);
      } else {
        EXPECT_LT(branch[k].frequency, branch[k - 1].frequency);
      }
      EXPECT_EQ(branch[k].whirl, branch[0].whirl);
    }
  }
}

// Where the branches of the overhung disc meet the speed: the roots of the quartic with w = +-W.
TEST(Campbell, CrossingsSolveTheFrequencyEquation) {
  const auto reference = rotorCase("C01");
  const RotorUnderTest r = matrixRotor(reference);
  const auto l = r.rotor.matrices(1.0);
  const CampbellDiagram diagram =
      campbell(r.rotor, r.stations, {equallySpaced(0.0, 1000.0, 11), {1.0, 2.0}});
  int once = 0;
  for (const CampbellCrossing& c : diagram.crossings) {
    const double w = (c.mode.whirl == Whirl::kForward ? 1.0 : -1.0) * c.harmonic * c.speed;
    const double polar = reference["parameters"]["Ip"];
    const double k11 = l.stiffness(0, 0), k12 = l.stiffness(0, 2), k22 = l.stiffness(2, 2);
    const double value =
        (k11 - l.mass(0, 0) * w * w) * (k22 - l.mass(2, 2) * w * w + polar * c.speed * w) -
        k12 * k12;
    EXPECT_NEAR(value / (k11 * k22), 0.0, 1.0e-9) << c.speed;
    once += c.harmonic == 1.0 ? 1 : 0;
  }
  EXPECT_EQ(once, 3);  // Ip > Id: the second forward branch is never met
}

/// Uncoupled discs, each at x_i, y_i on springs p_i^2 [1/s^2] and dampers 2 zeta p_i [1/s].
RotorUnderTest discsApart(int discs, double damping_ratio) {
  RotorUnderTest r;
  r.rotor.matrices = [=](double) {
    Linearization l;
    const Eigen::Index n = 2 * discs;
    l.mass = Eigen::MatrixXd::Identity(n, n);
    l.damping = l.gyroscopic = l.stiffness = l.circulatory = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < discs; ++i) {
      const double p = 10.0 * (static_cast<double>(i) + 1.0);
      l.stiffness.diagonal().segment(2 * i, 2) << p * p, 1.0001 * p * p;
      l.damping.diagonal().segment(2 * i, 2).setConstant(2.0 * damping_ratio * p);
    }
    return l;
  };
  r.rotor.load = Eigen::VectorXd::Zero(2 * discs);
  for (Eigen::Index i = 0; i < discs; ++i) {
    r.stations.push_back({"disc", static_cast<double>(i), Eigen::VectorXd::Unit(2 * discs, 2 * i),
                          Eigen::VectorXd::Unit(2 * discs, 2 * i + 1)});
  }
  return r;
}

// With any number of tracked modes, all critical speeds of the range are found: p sqrt(1 - zeta^2)
// each.
TEST(Campbell, FindsTheCriticalSpeedsOfModesThatAreNotFollowed) {
  const double zeta = 0.1;
  const RotorUnderTest r = discsApart(9, zeta);
  const CampbellDiagram diagram =
      campbell(r.rotor, r.stations, {equallySpaced(0.0, 95.0, 7), {1.0}, 3});
  ASSERT_EQ(diagram.crossings.size(), 18U);
  for (std::size_t i = 0; i < 18; i += 2) {
    const double p = 10.0 * (static_cast<double>(i / 2) + 1.0);
    EXPECT_NEAR(diagram.crossings[i].speed, p * std::sqrt(1.0 - zeta * zeta), 1.0e-9 * p);
  }
}

// Beyond a damping ratio of 0.7 a motion hardly goes round once: no whirl that meets the speed.
TEST(Campbell, HasCriticalSpeedsOfWhirlsOnly) {
  const auto crossings = [](double damping_ratio) {
    const RotorUnderTest r = discsApart(2, damping_ratio);
    return campbell(r.rotor, r.stations, {equallySpaced(0.0, 40.0, 7)}).crossings.size();
  };
  EXPECT_EQ(crossings(0.69), 4U);
  EXPECT_EQ(crossings(0.71), 0U);
}

}  // namespace whirl_modes_test

}  // namespace whirl_twin
