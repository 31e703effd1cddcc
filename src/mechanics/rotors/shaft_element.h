// A length of round shaft as a beam element of two nodes: Timoshenko with rotary inertia,
// gyroscopic moments and a consistent mass (Nelson, J. Mechanical Design 102, 1980; Przemieniecki,
// Theory of Matrix Structural Analysis, 1968), or Rayleigh, its limit without shear.
//
// A node has the displacements x, y and the rotations alpha about x, beta about y of its section, z
// along the shaft, right-handed: without shear beta = dx/dz and alpha = -dy/dz. The bending planes
// are thus (x, beta) and (y, -alpha). In each the element is bent as by forces at its ends; with
// P = 12 EI / (kappa G A l^2) and s = z / l
//
//   deflection   [1 + P (1-s) - 3 s^2 + 2 s^3,  l (s (1+P/2) - (2+P/2) s^2 + s^3),
//                 P s + 3 s^2 - 2 s^3,          l (-P/2 s + (P/2-1) s^2 + s^3)] / (1+P)
//   rotation     [6 (s^2-s) / l,  1+P - (4+P) s + 3 s^2,  6 (s-s^2) / l,  (P-2) s + 3 s^2] / (1+P)
//
// The shear strain is constant along an element: frequencies converge with n^-2 where shear counts
// and with n^-4 without.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

constexpr Eigen::Index kNodeCoordinates = 4;  ///< x, y, alpha, beta

struct ShaftMaterial {
  double youngs_modulus = 0.0;    ///< [Pa]
  double shear_modulus = 0.0;     ///< [Pa]
  double density = 0.0;           ///< [kg/m^3]
  bool shear_deformation = true;  ///< false: Rayleigh's beam
};

struct ShaftSection {
  double length = 0.0;          ///< [m]
  double outer_diameter = 0.0;  ///< [m]
  double inner_diameter = 0.0;  ///< [m]

  double area() const;          ///< [m^2]
  double secondMoment() const;  ///< [m^4], about a diameter
};

/// kappa of a round section, solid or hollow (Cowper, J. Applied Mechanics 33, 1966).
double shearCoefficient(const ShaftSection& section, double poissons_ratio);

/// In x, y, alpha, beta of the first node, then of the second.
struct ShaftElement {
  using Matrix = Eigen::Matrix<double, 2 * kNodeCoordinates, 2 * kNodeCoordinates>;
  Matrix mass;        ///< [kg], [kg m], [kg m^2]
  Matrix stiffness;   ///< [N/m], [N], [N m]
  Matrix gyroscopic;  ///< per unit of spin, skew
};

ShaftElement shaftElement(const ShaftMaterial& material, const ShaftSection& section);

}  // namespace whirl_twin
