// The shaft element: beam properties, and convergence to the exact whirl of a spinning shaft
// (reference case D09).
#include "mechanics/rotors/shaft_element.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "reference_rotors.h"

namespace whirl_twin {
namespace shaft_element_test {

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

// Round the shaft or in its bore: of the shaft's material it is a thicker shaft.
TEST(ShaftElement, aSleeveOfItsMaterialMakesItThicker) {
  const ShaftSection shaft{0.4, 0.08, 0.05};
  const ShaftElement whole = shaftElement(kSteel, {0.4, 0.12, 0.03});
  const ShaftElement layered =
      shaftElement({{kSteel, shaft}, {kSteel, {0.4, 0.12, 0.08}}, {kSteel, {0.4, 0.05, 0.03}}});
  EXPECT_LT((layered.mass - whole.mass).norm(), 1e-12 * whole.mass.norm());
  EXPECT_LT((layered.stiffness - whole.stiffness).norm(), 1e-12 * whole.stiffness.norm());
  EXPECT_LT((layered.gyroscopic - whole.gyroscopic).norm(), 1e-12 * whole.gyroscopic.norm());
}

TEST(ShaftElement, aSleeveAddsWhatBendsOfItAndAllItsMass) {
  ShaftMaterial steel = kSteel;
  steel.shear_deformation = false;
  const ShaftMaterial bronze{1.1e11, 4.1e10, 8800.0, false};
  const ShaftSection sleeve{0.4, 0.14, 0.08};
  const ShaftElement bare = shaftElement(steel, kTube);
  for (const double share : {0.0, 0.4, 1.0}) {
    const ShaftElement e = shaftElement({{steel, kTube}, {bronze, sleeve, share}});
    const double stiffer = 1.0 + share * bronze.youngs_modulus * sleeve.secondMoment() /
                                     (steel.youngs_modulus * kTube.secondMoment());
    EXPECT_LT((e.stiffness - stiffer * bare.stiffness).norm(), 1e-12 * e.stiffness.norm());
    const Vector along = Vector::Unit(0) + Vector::Unit(4);
    const double mass = 0.4 * (steel.density * kTube.area() + bronze.density * sleeve.area());
    EXPECT_NEAR(along.dot(e.mass * along), mass, 1e-12 * mass) << share;
  }
}

// A cone of diameters d, D fixed at D: F l^3 / 3 EI(D) * D / d + 4 F l / pi kappa G d D.
TEST(ShaftElement, aConeBendsAndShearsExactlyUnderAnEndForce) {
  ShaftSection cone{0.4, 0.09, 0.0};
  cone.outer_growth = -0.06;
  for (const bool shear : {true, false}) {
    ShaftMaterial material = kSteel;
    material.shear_deformation = shear;
    const ShaftElement e = shaftElement(material, cone);
    const Eigen::Vector4d tip =
        e.stiffness.bottomRightCorner<4, 4>().ldlt().solve(Eigen::Vector4d(0.0, 1.0, 0.0, 0.0));
    const double nu = material.youngs_modulus / (2.0 * material.shear_modulus) - 1.0;
    const double kappa = shearCoefficient(cone, nu);
    const double sag =
        std::pow(0.4, 3) / (3.0 * material.youngs_modulus * cone.secondMoment()) * 3.0 +
        (shear ? 0.4 * 4.0 / (3.14159265358979323846 * kappa * material.shear_modulus * 0.03 * 0.09)
               : 0.0);
    EXPECT_NEAR(tip[1], sag, 1e-9 * sag);
  }
}

TEST(ShaftElement, aConeHasItsMassAndMovesWithoutStrain) {
  ShaftSection cone{0.4, 0.09, 0.0};
  cone.outer_growth = -0.06;
  const ShaftElement e = shaftElement(kSteel, cone);
  const double mass =
      kSteel.density * 3.14159265358979323846 / 12.0 * 0.4 * (0.0081 + 0.0027 + 0.0009);
  const Vector along = Vector::Unit(1) + Vector::Unit(5);
  EXPECT_NEAR(along.dot(e.mass * along), mass, 1e-12 * mass);
  const Vector turn = Vector::Unit(2) + Vector::Unit(6) - 0.4 * Vector::Unit(5);
  EXPECT_LT((e.stiffness * turn).norm(), 1e-10 * e.stiffness.norm());
  const ElementBody body = elementBody({{kSteel, cone}});
  EXPECT_NEAR(body.mass, mass, 1e-12 * mass);
  // h / 4 (D^2 + 2 D d + 3 d^2) / (D^2 + D d + d^2)
  EXPECT_NEAR(body.centre, 0.1 * (0.0081 + 0.0054 + 0.0027) / (0.0081 + 0.0027 + 0.0009), 1e-12);
  // About the shaft 3/10 m (R^5 - r^5) / (R^3 - r^3).
  EXPECT_NEAR(body.polar_inertia,
              0.3 * mass * (std::pow(0.045, 5) - std::pow(0.015, 5)) /
                  (std::pow(0.045, 3) - std::pow(0.015, 3)),
              1e-12 * mass);
  const double about_end = body.transverse_inertia + mass * body.centre * body.centre;
  EXPECT_NEAR(turn.dot(e.mass * turn), about_end, 1e-10 * about_end);
}

// A cone clamped at its thick end, thin beside its length, half as thick at its free one: w l^2
// sqrt(rho A / EI) of the root by Bessel functions, w = J_2, Y_2, I_2, K_2 (2 b sqrt(z)) / z
// (Kirchhoff 1879), here to 12 digits with the libraries of C++.
TEST(ShaftElement, aConeVibratesAsKirchhoffFound) {
  const double wanted[] = {4.62515025243, 19.5476131805, 48.5788993339};
  for (const int elements : {4, 8}) {
    FlexibleShaft shaft;
    shaft.material = {2.0e11, 8.0e10, 7800.0, false};
    const double root = 1.0e-3;
    for (int i = 0; i < elements; ++i) {
      ShaftSection part{1.0 / elements, root * (1.0 - 0.5 * i / elements), 0.0};
      part.outer_growth = -0.5 * root / elements;
      shaft.elements.push_back(part);
    }
    const RotorAssembly rotor(shaft);
    const Eigen::Index n = rotor.dof();
    const RotorAssembly clamped = rotor.in(Eigen::MatrixXd::Identity(n, n).rightCols(n - 4));
    const auto found = whirlEigenvalues(clamped.matrices(0.0));
    const double unit = std::sqrt(2.0e11 / 7800.0) * 0.25 * root;
    // Order 4.
    const double tolerances[] = {elements == 4 ? 2.0e-4 : 1.25e-5, elements == 4 ? 2.0e-3 : 2.0e-4,
                                 elements == 4 ? 1.0e-2 : 1.0e-3};
    for (std::size_t mode = 0; mode < 3; ++mode) {
      EXPECT_NEAR(found[2 * mode].imag() / unit, wanted[mode], tolerances[mode] * wanted[mode]);
    }
  }
}

// Pinned: w^2 = w0^2 (1 + N / N_Euler), in tension and short of buckling (Timoshenko, Vibration
// Problems in Engineering).
TEST(ShaftElement, anAxialForceRaisesAndLowersItsFrequency) {
  const double euler = 9.86960440108936 * 2.0e11 * 3.14159265358979 * std::pow(0.04, 4) / 64.0;
  const auto first = [&](double share, bool shear) {
    FlexibleShaft shaft;
    shaft.material = {2.0e11, 8.0e10, 7800.0, shear};
    ShaftSection section{0.1, 0.04, 0.0};
    section.axial_force = share * euler;
    shaft.elements.assign(10, section);
    const RotorAssembly rotor(shaft);
    const Eigen::Index n = rotor.dof();
    Eigen::MatrixXd pinned = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd kept(n, n - 4);
    kept << pinned.middleCols(2, n - 6), pinned.rightCols(2);
    return whirlEigenvalues(rotor.in(kept).matrices(0.0))[0].imag();
  };
  for (const double share : {-0.9, -0.5, 0.5, 2.0}) {
    EXPECT_NEAR(first(share, false) / first(0.0, false), std::sqrt(1.0 + share), 3e-5) << share;
  }
  EXPECT_LT(first(-0.5, true), first(0.0, true));
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
  const auto modes = expected(reference, "modes_1_to_3");
  ASSERT_EQ(modes["value"].size(), 6u);
  for (const auto& row : modes["value"]) {
    const bool shear = row["model"] == "Timoshenko";
    double errors[2] = {0.0, 0.0};
    for (int refinement = 0; refinement < 2; ++refinement) {
      const auto found =
          whirlSpeeds(reference["parameters"], shear, row["Om"], refinement == 0 ? 20 : 40);
      for (std::size_t mode = 0; mode < 3; ++mode) {
        const double backward = row["backward"][mode];
        const double forward = row["forward"][mode];
        errors[refinement] =
            std::max({errors[refinement], std::fabs(found[2 * mode] / backward - 1.0),
                      std::fabs(found[2 * mode + 1] / forward - 1.0)});
      }
    }
    // Order 4 without shear. With it, constant along an element, order 2. The reference has 2e-6
    // and 2e-4 on mode 3 with 40 elements.
    const double order = std::log2(errors[0] / errors[1]);
    EXPECT_NEAR(order, shear ? 2.0 : 4.0, 0.1) << row;
    EXPECT_LT(errors[1], shear ? 2.5e-4 : 2.5e-6) << row;
  }
}

}  // namespace shaft_element_test
}  // namespace whirl_twin
