// The shaft element: what a beam must do, and convergence to the exact whirl of a spinning shaft
// (reference case D09).
#include "mechanics/rotors/shaft_element.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference_rotors.h"

namespace whirl_twin {
namespace {

using Vector = Eigen::Matrix<double, 8, 1>;

const ShaftMaterial kSteel{211.0e9, 81.2e9, 7810.0, true};
const ShaftSection kTube{0.4, 0.08, 0.05};

TEST(ShaftElement, movesWithoutStrainAsARigidBody) {
  const ShaftElement e = shaftElement(kSteel, kTube);
  const double l = kTube.length;
  for (const Vector& motion :
       {Vector(Vector::Unit(0) + Vector::Unit(4)), Vector(Vector::Unit(1) + Vector::Unit(5)),
        // beta = dx/dz and alpha = -dy/dz
        Vector(Vector::Unit(3) + Vector::Unit(7) + l * Vector::Unit(4)),
        Vector(Vector::Unit(2) + Vector::Unit(6) - l * Vector::Unit(5))}) {
    EXPECT_LT((e.stiffness * motion).norm(), 1e-12 * e.stiffness.norm());
  }
}

TEST(ShaftElement, hasTheMassAndTheMomentsOfACylinder) {
  const ShaftElement e = shaftElement(kSteel, kTube);
  const double mass = kSteel.density * kTube.area() * kTube.length;
  const Vector along = Vector::Unit(0) + Vector::Unit(4);
  EXPECT_NEAR(along.dot(e.mass * along), mass, 1e-12 * mass);
  // Turning about x through the first node, beside y = -z alpha.
  const Vector turn = Vector::Unit(2) + Vector::Unit(6) - kTube.length * Vector::Unit(5);
  const double about = mass * kTube.length * kTube.length / 3.0 +
                       kSteel.density * kTube.secondMoment() * kTube.length;
  EXPECT_NEAR(turn.dot(e.mass * turn), about, 1e-12 * about);
  // I_p alpha' = the moment about -y that keeps alpha turning: G(beta, alpha) < 0.
  const Vector other = Vector::Unit(3) + Vector::Unit(7) + kTube.length * Vector::Unit(4);
  const double polar = 2.0 * kSteel.density * kTube.secondMoment() * kTube.length;
  EXPECT_NEAR(other.dot(e.gyroscopic * turn), -polar, 1e-12 * polar);
  EXPECT_EQ((e.gyroscopic + e.gyroscopic.transpose()).norm(), 0.0);
}

// F l^3 / 3 EI + F l / kappa G A at the free end, exact with one element.
TEST(ShaftElement, bendsAndShearsUnderAnEndForce) {
  for (const bool shear : {true, false}) {
    ShaftMaterial material = kSteel;
    material.shear_deformation = shear;
    const ShaftElement e = shaftElement(material, kTube);
    const Vector tip =
        (Vector() << Eigen::Vector4d::Zero(),
         e.stiffness.bottomRightCorner<4, 4>().ldlt().solve(Eigen::Vector4d(0.0, 1.0, 0.0, 0.0)))
            .finished();
    const double l = kTube.length;
    const double nu = material.youngs_modulus / (2.0 * material.shear_modulus) - 1.0;
    const double sag =
        l * l * l / (3.0 * material.youngs_modulus * kTube.secondMoment()) +
        (shear ? l / (shearCoefficient(kTube, nu) * material.shear_modulus * kTube.area()) : 0.0);
    EXPECT_NEAR(tip[5], sag, 1e-12 * sag);
    EXPECT_LT(tip[6], 0.0) << "alpha = -dy/dz";
  }
}

// Cowper (1966): solid 6 (1 + nu) / (7 + 6 nu), thin tube 2 (1 + nu) / (4 + 3 nu).
TEST(ShaftElement, shearCoefficientIsCowpers) {
  const double nu = 0.3;
  EXPECT_NEAR(shearCoefficient({1.0, 0.1, 0.0}, nu), 6.0 * 1.3 / 8.8, 1e-15);
  EXPECT_NEAR(shearCoefficient({1.0, 0.1, 0.1 * (1.0 - 1e-9)}, nu), 2.0 * 1.3 / 4.9, 1e-9);
  const auto p = rotorCase("D09")["parameters"];
  const double nu_d09 = p["E"].get<double>() / (2.0 * p["G"].get<double>()) - 1.0;
  EXPECT_NEAR(shearCoefficient({1.0, 0.1, 0.0}, nu_d09), p["kappa"], 1e-9)
      << "given for nu to five digits";
}

/// Whirl speeds of the pinned shaft of D09, forward and backward: with z = x + i y, s = i w, the
/// planes decouple into (M w^2 - Om G w - K) v = 0, here solved as the real problem of both.
std::vector<double> whirlSpeeds(const nlohmann::json& p, bool shear, double spin, int elements) {
  FlexibleShaft shaft;
  shaft.material = {p["E"], p["G"], p["rho"], shear};
  shaft.elements.assign(static_cast<std::size_t>(elements),
                        {p["L"].get<double>() / elements, p["d"], 0.0});
  const RotorAssembly rotor(shaft);
  const Eigen::Index n = rotor.dof();
  // Pinned ends: x = y = 0.
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i > 1 && i != n - 4 && i != n - 3) {
      kept.push_back(i);
    }
  }
  const Eigen::MatrixXd select = Eigen::MatrixXd::Identity(n, n)(Eigen::all, kept);
  const RotorAssembly pinned = rotor.in(select);
  std::vector<double> speeds;
  for (const auto& s : whirlEigenvalues(pinned.matrices(spin))) {
    speeds.push_back(s.imag());
  }
  return speeds;
}

// At rotation 0, 1000 and 3000 rad/s, modes 1 to 3, both ways.
TEST(ShaftElement, convergesToTheExactWhirlOfASpinningShaft) {
  const auto reference = rotorCase("D09");
  for (const auto& row : expected(reference, "modes_1_to_3")["value"]) {
    const bool shear = row["model"] == "Timoshenko";
    double errors[2] = {0.0, 0.0};
    for (int refinement = 0; refinement < 2; ++refinement) {
      const auto found =
          whirlSpeeds(reference["parameters"], shear, row["Om"], refinement == 0 ? 10 : 20);
      for (std::size_t mode = 0; mode < 3; ++mode) {
        const double backward = row["backward"][mode];
        const double forward = row["forward"][mode];
        errors[refinement] =
            std::max({errors[refinement], std::fabs(found[2 * mode] / backward - 1.0),
                      std::fabs(found[2 * mode + 1] / forward - 1.0)});
      }
    }
    // Order 4 without shear. With it, constant along an element, order 2. The reference has 2e-6
    // and 2e-4 on mode 3 with 40 elements: 16 and 4 times that with 20.
    const double order = std::log2(errors[0] / errors[1]);
    EXPECT_NEAR(order, shear ? 2.0 : 4.0, 0.1) << row;
    EXPECT_LT(errors[1], shear ? 1.5e-3 : 6e-5) << row;
  }
}

}  // namespace
}  // namespace whirl_twin
