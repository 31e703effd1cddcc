// Assembled rotors against the reference cases D01-D13 and E04, and the laws of internal damping.
#include "mechanics/rotors/rotor_assembly.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algebra/dense.h"
#include "reference_rotors.h"

namespace whirl_twin {
namespace rotor_assembly_test {

using Complex = std::complex<double>;
using nlohmann::json;

FlexibleShaft nelsonMcVaugh(const json& p) {
  FlexibleShaft shaft;
  const double youngs_modulus = p["E"];
  shaft.material = {youngs_modulus, youngs_modulus / 2.6, p["rho"], p["shear"]};
  const auto& z = p["node_z_m"];
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    shaft.elements.push_back({z[i + 1].get<double>() - z[i].get<double>(),
                              2.0 * p["outer_radius_m"][i].get<double>(),
                              2.0 * p["inner_radius_m"][i].get<double>()});
  }
  const auto& disc = p["disc"];
  shaft.discs = {{disc["node"], disc["m"], disc["Ip"], disc["Id"]}};
  const json undamped = {{0.0, 0.0}, {0.0, 0.0}};
  for (const auto& node : p["bearing_nodes"]) {
    shaft.bearings.push_back({node, coefficients(p["K"], undamped)});
  }
  return shaft;
}

/// D10: D01's rotor in other bearings, with an unbalance.
FlexibleShaft unbalancedRotor() {
  FlexibleShaft shaft = twoDiscRotor(rotorCase("D01")["parameters"]);
  const json p = rotorCase("D10")["parameters"];
  for (RotorBearing& bearing : shaft.bearings) {
    bearing.coefficients = {p["bearings"]["K"][0], 0.0, 0.0, p["bearings"]["K"][1],
                            p["bearings"]["C"][0], 0.0, 0.0, p["bearings"]["C"][1]};
  }
  shaft.unbalances = {{p["node"], p["unbalance_kgm"], 0.0}};
  return shaft;
}

class EigenvaluesOfTheTwoDiscRotor : public testing::TestWithParam<const char*> {};

TEST_P(EigenvaluesOfTheTwoDiscRotor, areThoseOfTheReference) {
  const json reference = rotorCase(GetParam());
  const RotorAssembly rotor(twoDiscRotor(reference["parameters"]));
  const json modes = expected(reference, "modes_lateral");
  for (const auto& row : modes["value"]) {
    const auto found = whirlEigenvalues(rotor.matrices(row["rpm"].get<double>() * kRpm));
    const auto& wanted = row["eigenvalues"];
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const Complex s(wanted[i][0], wanted[i][1]);
      EXPECT_LT(std::abs(found[i] - s), modes["rtol"].get<double>() * std::abs(s))
          << row["rpm"] << " rpm, mode " << i << ": " << found[i] << " for " << s;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Friswell, EigenvaluesOfTheTwoDiscRotor,
                         testing::Values("D01", "D03", "D04", "D05"),
                         [](const auto& test) { return std::string(test.param); });

TEST(RotorAssembly, hasTheWhirlSpeedsOfNelsonAndMcVaugh) {
  const json reference = rotorCase("D07");
  const RotorAssembly rotor(nelsonMcVaugh(reference["parameters"]));
  const json speeds = expected(reference, "whirl_speeds");
  for (const auto& row : speeds["value"]) {
    const auto found = whirlEigenvalues(rotor.matrices(row["rpm_spin"].get<double>() * kRpm));
    for (std::size_t i = 0; i < row["whirl_rpm"].size(); ++i) {
      const double rpm = row["whirl_rpm"][i];
      EXPECT_NEAR(found[i].imag() / kRpm, rpm, speeds["rtol"].get<double>() * rpm);
    }
  }
}

/// Forward or backward undamped critical speeds, K v = w^2 (M -+ Gp) v with z = x + i y.
std::vector<double> criticalSpeeds(const FlexibleShaft& shaft, bool forward) {
  const RotorAssembly rotor(shaft);
  const Linearization rest = rotor.matrices(0.0);
  const Eigen::MatrixXd gyroscopic = rotor.matrices(1.0).gyroscopic - rest.gyroscopic;
  const Eigen::Index n = rotor.dof();
  // A circular whirl is
  // q(t) = Re[(1, -+i) v e^(i w t)] in the pairs (x, y), (alpha, beta).
  Eigen::MatrixXcd whirl = Eigen::MatrixXcd::Zero(n, n / 2);
  for (Eigen::Index i = 0; i < n / 2; ++i) {
    whirl(2 * i, i) = 1.0;
    whirl(2 * i + 1, i) = Complex(0.0, forward ? -1.0 : 1.0);
  }
  const Eigen::MatrixXcd stiffness = whirl.adjoint() * rest.stiffness * whirl;
  const Eigen::MatrixXcd inertia =
      whirl.adjoint() * (rest.mass.cast<Complex>() - Complex(0.0, 1.0) * gyroscopic) * whirl;
  // 1 / w^2 are the eigenvalues of K^-1 M; the largest are the most precise.
  const Eigen::VectorXcd all = eigenvalues(ComplexLu(stiffness).solve(inertia)).values;
  std::vector<double> speeds;
  for (const Complex& s : all) {
    if (s.real() > 0.0) {
      speeds.push_back(1.0 / std::sqrt(s.real()));
    }
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

void expectCriticalSpeeds(const FlexibleShaft& shaft, const json& wanted, bool forward, double unit,
                          double rtol) {
  const auto found = criticalSpeeds(shaft, forward);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const double speed = wanted[i].get<double>() * unit;
    EXPECT_NEAR(found[i], speed, rtol * speed) << (forward ? "forward " : "backward ") << i;
  }
}

TEST(RotorAssembly, hasTheCriticalSpeedsOfNelsonAndMcVaugh) {
  const json reference = rotorCase("D07");
  const FlexibleShaft shaft = nelsonMcVaugh(reference["parameters"]);
  const json forward = expected(reference, "critical_forward_rpm");
  const json backward = expected(reference, "critical_backward_rpm");
  expectCriticalSpeeds(shaft, forward["value"], true, kRpm, forward["rtol"]);
  expectCriticalSpeeds(shaft, backward["value"], false, kRpm, backward["rtol"]);
}

TEST(RotorAssembly, hasTheCriticalSpeedMapOfTheReference) {
  const json map = expected(rotorCase("D13"), "ucs");
  FlexibleShaft shaft = twoDiscRotor(rotorCase("D01")["parameters"]);
  for (const auto& row : map["value"]) {
    for (RotorBearing& bearing : shaft.bearings) {
      bearing.coefficients.kxx = bearing.coefficients.kyy = row["k_bearing"];
    }
    expectCriticalSpeeds(shaft, row["forward"], true, 1.0, map["rtol"]);
    expectCriticalSpeeds(shaft, row["backward"], false, 1.0, map["rtol"]);
  }
}

TEST(RotorAssembly, respondsToUnbalanceAsTheReference) {
  const json response = expected(rotorCase("D10"), "response");
  const LinearRotor rotor = RotorAssembly(unbalancedRotor()).linearRotor();
  for (const auto& row : response["value"]) {
    const double w = row["rpm"].get<double>() * kRpm;
    const Linearization l = rotor.matrices(w);
    const Eigen::MatrixXcd dynamic =
        (l.stiffness + l.circulatory - w * w * l.mass).cast<Complex>() +
        Complex(0.0, w) * (l.damping + l.gyroscopic);
    const Eigen::VectorXcd q = ComplexLu(dynamic).solve(rotor.synchronousForce(w));
    for (const auto& [disc, node] : {std::pair{"disc1", 2}, std::pair{"disc2", 4}}) {
      const Complex x(row[disc]["X"][0], row[disc]["X"][1]);
      const Complex y(row[disc]["Y"][0], row[disc]["Y"][1]);
      const double tolerance =
          response["rtol"].get<double>() * std::hypot(std::abs(x), std::abs(y));
      EXPECT_LT(std::abs(q[4 * node] - x), tolerance) << row["rpm"] << " rpm " << disc;
      EXPECT_LT(std::abs(q[4 * node + 1] - y), tolerance) << row["rpm"] << " rpm " << disc;
    }
  }
}

TEST(RotorAssembly, sagsUnderItsWeight) {
  const json reference = rotorCase("D11");
  FlexibleShaft shaft = unbalancedRotor();
  shaft.gravity = reference["parameters"]["g"];
  const LinearRotor rotor = RotorAssembly(shaft).linearRotor();
  const Eigen::VectorXd q = Ldlt(rotor.matrices(0.0).stiffness).solve(rotor.load);
  const json sag = expected(reference, "node_sag_y");
  for (Eigen::Index node = 0; node < 7; ++node) {
    const double wanted = sag["value"][static_cast<std::size_t>(node)];
    EXPECT_NEAR(q[4 * node + 1], wanted, sag["rtol"].get<double>() * std::fabs(wanted));
    EXPECT_NEAR(q[4 * node], 0.0, 1e-15);
  }
  const json loads = expected(reference, "bearing_loads");
  const double stiffness = shaft.bearings[0].coefficients.kyy;
  EXPECT_NEAR(-stiffness * q[1], loads["value"][0],
              loads["rtol"].get<double>() * loads["value"][0].get<double>());
  EXPECT_NEAR(-stiffness * q[25], loads["value"][1],
              loads["rtol"].get<double>() * loads["value"][1].get<double>());
  const json mass = expected(reference, "total_mass");
  double weight = 0.0;
  for (Eigen::Index node = 0; node < 7; ++node) {
    weight -= rotor.load[4 * node + 1];
  }
  EXPECT_NEAR(weight / shaft.gravity, mass["value"],
              mass["rtol"].get<double>() * mass["value"].get<double>());
}

TEST(RotorAssembly, isDestabilizedByCrossCoupledStiffness) {
  const json reference = rotorCase("E04");
  const double speed = reference["parameters"]["rpm"].get<double>() * kRpm;
  const json table = expected(reference, "logdec_vs_Q");
  const double rtol = table["rtol"];
  for (const auto& row : table["value"]) {
    FlexibleShaft shaft = twoDiscRotor(rotorCase("D05")["parameters"]);
    const double q = row["Q"];
    shaft.bearings.push_back({reference["parameters"]["node"], {0.0, q, -q, 0.0, 0, 0, 0, 0}});
    const Complex wanted(row["first_forward"][0], row["first_forward"][1]);
    Complex nearest;
    for (const Complex& s : whirlEigenvalues(RotorAssembly(shaft).matrices(speed))) {
      nearest = std::abs(s - wanted) < std::abs(nearest - wanted) ? s : nearest;
    }
    EXPECT_LT(std::abs(nearest - wanted), rtol * std::abs(wanted)) << q;
  }
}

/// A disc of 10 kg on a thin shaft in stiff bearings, which is Jeffcott's rotor.
FlexibleShaft jeffcott(double internal_damping) {
  FlexibleShaft shaft;
  shaft.material = {210.0e9, 80.0e9, 1.0, true};
  shaft.internal_damping = internal_damping;
  shaft.elements.assign(4, {0.25, 0.02, 0.0});
  shaft.discs = {{2, 10.0, 1e-6, 1e-6}};
  for (const int node : {0, 4}) {
    shaft.bearings.push_back({node, {1e11, 0, 0, 1e11, 0, 0, 0, 0}});
  }
  return shaft;
}

// m z'' + c_i (z' - i w z) + k z = 0 with c_i = eta k: unstable above w = p, whirling forward.
TEST(RotorAssembly, isDestabilizedByInternalDampingAboveItsCriticalSpeed) {
  const double eta = 1.0e-5;
  const RotorAssembly rotor(jeffcott(eta));
  const double p = whirlEigenvalues(RotorAssembly(jeffcott(0.0)).matrices(0.0))[0].imag();
  for (const double ratio : {0.0, 0.5, 0.98, 1.02, 2.0, -2.0}) {
    const double w = ratio * p;
    const auto found = whirlEigenvalues(rotor.matrices(w));
    double worst = -1e9;
    for (const Complex& s : {found[0], found[1]}) {
      worst = std::max(worst, s.real());
    }
    // Roots of s^2 + eta p^2 (s - i w) + p^2 = 0; forward has Im s of the sign of w.
    const double c = 0.5 * eta * p * p;
    const Complex inside = c * c - p * p + Complex(0.0, 2.0 * c * w);
    const double wanted = -c + std::fabs(std::sqrt(inside).real());
    // The massless shaft's other motions are far above: 1e-4 of the rate c p.
    EXPECT_NEAR(worst, wanted, 1e-3 * c) << ratio;
    EXPECT_EQ(worst > 0.0, std::fabs(ratio) > 1.0) << ratio;
  }
}

TEST(RotorAssembly, holdsItsBearingsAsGiven) {
  FlexibleShaft shaft = jeffcott(0.0);
  shaft.bearings = {{1, {2.0, 5.0, 1.0, 3.0, 20.0, 50.0, 10.0, 30.0}}};
  const Linearization with = RotorAssembly(shaft).matrices(7.0);
  shaft.bearings.clear();
  const Linearization without = RotorAssembly(shaft).matrices(7.0);
  const Eigen::Matrix2d k =
      (with.stiffness + with.circulatory - without.stiffness - without.circulatory)
          .block<2, 2>(4, 4);
  const Eigen::Matrix2d c =
      (with.damping + with.gyroscopic - without.damping - without.gyroscopic).block<2, 2>(4, 4);
  // Rounding of a shaft of 1e6 N/m.
  EXPECT_NEAR((k - (Eigen::Matrix2d() << 2.0, 5.0, 1.0, 3.0).finished()).norm(), 0.0, 1e-8);
  EXPECT_NEAR((c - (Eigen::Matrix2d() << 20.0, 50.0, 10.0, 30.0).finished()).norm(), 0.0, 1e-8);
  EXPECT_EQ((with.circulatory + with.circulatory.transpose()).norm(), 0.0);
  EXPECT_EQ((with.damping - with.damping.transpose()).norm(), 0.0);
}

/// A disc of 10 kg on a short, all but rigid shaft, in bearings of 2 k = 2.0e6 N/m.
FlexibleShaft rigidRotor() {
  FlexibleShaft shaft;
  shaft.material = {2.0e15, 8.0e14, 7800.0, true};
  shaft.elements.assign(2, {0.1, 0.05, 0.0});
  shaft.discs = {{1, 10.0, 0.1, 0.1}};
  for (const int node : {0, 2}) {
    shaft.bearings.push_back({node, {1.0e6, 0, 0, 1.0e6, 0, 0, 0, 0}});
  }
  return shaft;
}

constexpr double kRigidMass = 10.0 + 7800.0 * 0.2 * 3.14159265358979323846 * 0.05 * 0.05 / 4.0;

/// Undamped natural frequencies of a chain of masses, the last of them on the ground.
Eigen::VectorXd chainFrequencies(const Eigen::VectorXd& masses, const Eigen::VectorXd& springs) {
  const Eigen::Index n = masses.size();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    k(i, i) += springs[i];
    if (i + 1 < n) {
      k(i + 1, i + 1) += springs[i];
      k(i, i + 1) -= springs[i];
      k(i + 1, i) -= springs[i];
    }
  }
  const Eigen::MatrixXd m = masses.asDiagonal();
  return generalizedModes(k, m).values.cwiseSqrt();
}

TEST(RotorAssembly, onPedestalsIsAChainOfMasses) {
  FlexibleShaft shaft = rigidRotor();
  for (const int node : {0, 2}) {
    BearingCoefficients below;
    below.kxx = 4.0e6;
    below.kyy = 3.0e6;
    shaft.pedestals.push_back({node, 20.0, 15.0, below});
    BearingCoefficients foundation;
    foundation.kxx = foundation.kyy = 5.0e6;
    shaft.pedestals.push_back({node, 50.0, 50.0, foundation});
  }
  const RotorAssembly rotor(shaft);
  ASSERT_EQ(rotor.dof(), 3 * 4 + 4 * 2);
  const auto found = whirlEigenvalues(rotor.matrices(0.0));
  const auto expectOne = [&](double wanted) {
    double nearest = 1e300;
    for (const Complex& s : found) {
      nearest = std::min(nearest, std::fabs(s.imag() - wanted));
    }
    EXPECT_LT(nearest, 3e-6 * wanted) << wanted;
  };
  for (const double wanted : chainFrequencies(Eigen::Vector3d(kRigidMass, 40.0, 100.0),
                                              Eigen::Vector3d(2.0e6, 8.0e6, 1.0e7))) {
    expectOne(wanted);
  }
  for (const double wanted : chainFrequencies(Eigen::Vector3d(kRigidMass, 30.0, 100.0),
                                              Eigen::Vector3d(2.0e6, 6.0e6, 1.0e7))) {
    expectOne(wanted);
  }
}

// Springs in a row: 1 / k = 1 / k1 + 1 / k2. A pedestal at one end only: the other end is as it
// was.
TEST(RotorAssembly, sagsOnItsPedestalsAsOnSpringsInARow) {
  FlexibleShaft shaft = rigidRotor();
  shaft.gravity = 10.0;
  BearingCoefficients below;
  below.kxx = below.kyy = 0.5e6;
  shaft.pedestals = {{0, 20.0, 20.0, below}};
  const LinearRotor rotor = RotorAssembly(shaft).linearRotor();
  const Eigen::VectorXd q = Ldlt(rotor.matrices(0.0).stiffness).solve(rotor.load);
  const double half = 5.0 * kRigidMass;
  EXPECT_NEAR(q[1], -half * (1.0e-6 + 2.0e-6), 1e-9);
  EXPECT_NEAR(q[5], -half * 2.0e-6, 1e-9) << "its own weight was there before";
  EXPECT_NEAR(q[shaft.firstOf(2) + 1], -half * 1.0e-6, 1e-9);
  EXPECT_NEAR(q[0], 0.0, 1e-12);
}

// The same in matrices near their diagonals, in which bearings that follow the speed are too.
TEST(RotorAssembly, hasItsPedestalsBesideTheirNodes) {
  FlexibleShaft shaft = rigidRotor();
  shaft.speed_bearings.push_back(
      {2, [](double w) { return BearingCoefficients{w, 2 * w, 3 * w, w, 1, 2, 3, 4}; }, {}});
  BearingCoefficients below;
  below.kxx = below.kyy = 0.5e6;
  below.kxy = 1.0e5;
  below.cxx = 30.0;
  shaft.pedestals = {{2, 20.0, 20.0, below}, {0, 10.0, 10.0, below}, {2, 5.0, 5.0, below}};
  const RotorAssembly rotor(shaft);
  const Linearization l = rotor.matrices(7.0);
  const BandedLinearization b = rotor.bandedMatrices(7.0);
  EXPECT_LE(b.byPlace().width(), 11);
  EXPECT_EQ((b.mass.dense() - l.mass).norm(), 0.0);
  EXPECT_LT((b.byPlace().dense() - l.stiffness - l.circulatory).norm(), 1e-12 * l.stiffness.norm());
  EXPECT_LT((b.byRate().dense() - l.damping - l.gyroscopic).norm(), 1e-12 * l.damping.norm());
}

// The added mass of a film has inertia and no weight.
TEST(RotorAssembly, carriesTheMassesOfItsBearings) {
  FlexibleShaft shaft = rigidRotor();
  shaft.gravity = 10.0;
  const RotorAssembly bare(shaft);
  for (RotorBearing& bearing : shaft.bearings) {
    bearing.coefficients.mxx = bearing.coefficients.myy = 3.0;
  }
  const RotorAssembly with(shaft);
  EXPECT_EQ((with.linearRotor().load - bare.linearRotor().load).norm(), 0.0);
  // x and y move as one mass, 6 kg more.
  const auto found = whirlEigenvalues(with.matrices(0.0));
  double nearest = 1e300;
  for (const Complex& s : found) {
    nearest = std::min(nearest, std::fabs(s.imag() - std::sqrt(2.0e6 / (kRigidMass + 6.0))));
  }
  EXPECT_LT(nearest, 1e-3);
}

// s = -(alpha + beta w^2) / 2 +- i ..., of every mode of a shaft without discs.
TEST(RotorAssembly, isDampedInProportion) {
  FlexibleShaft shaft;
  shaft.material = {2.0e11, 8.0e10, 7800.0, true};
  shaft.elements.assign(6, {0.2, 0.05, 0.0});
  const auto pinned = [](const FlexibleShaft& s) {
    const RotorAssembly rotor(s);
    const Eigen::Index n = rotor.dof();
    const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd kept(n, n - 4);
    kept << all.middleCols(2, n - 6), all.rightCols(2);
    return whirlEigenvalues(rotor.in(kept).matrices(0.0));
  };
  const auto undamped = pinned(shaft);
  shaft.mass_damping = 8.0;
  shaft.stiffness_damping = 1.0e-5;
  const auto damped = pinned(shaft);
  for (std::size_t mode = 0; mode < 8; ++mode) {
    const double w2 = std::norm(undamped[mode]);
    EXPECT_NEAR(damped[mode].real(), -0.5 * (8.0 + 1.0e-5 * w2), 1e-6 * (8.0 + 1.0e-5 * w2));
  }
}

// At the angle 0 the slope of the disc's axis is in x, and (I_d - I_p) tau w^2 turns it about y; a
// quarter turn on it is in y, about -x.
TEST(RotorAssembly, isForcedByADiscThatIsAskew) {
  FlexibleShaft shaft = rigidRotor();
  shaft.discs[0].polar_inertia = 0.18;
  shaft.discs[0].skew = 0.01;
  const LinearRotor rotor = RotorAssembly(shaft).linearRotor();
  const double couple = (0.1 - 0.18) * 0.01 * 900.0;
  const Eigen::VectorXd first = rotor.shaftForce(0.0, 30.0, 0.0);
  EXPECT_NEAR(first[4 + 3], couple, 1e-15);
  EXPECT_NEAR(first[4 + 2], 0.0, 1e-15);
  const Eigen::VectorXd second = rotor.shaftForce(0.5 * 3.14159265358979323846, 30.0, 0.0);
  EXPECT_NEAR(second[4 + 2], -couple, 1e-15);
  EXPECT_NEAR(second[4 + 3], 0.0, 1e-15);
  EXPECT_EQ(first.head(4).norm() + first.tail(4).norm(), 0.0);
}

TEST(RotorAssembly, refusesANodeThatDoesNotExist) {
  FlexibleShaft shaft = jeffcott(0.0);
  shaft.discs[0].node = 5;
  try {
    const RotorAssembly rotor(shaft);
    FAIL() << "was accepted";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "disc: node must be 0 to 4, found 5");
  }
}

}  // namespace rotor_assembly_test
}  // namespace whirl_twin
