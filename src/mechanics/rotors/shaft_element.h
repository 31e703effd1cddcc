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
//
// An element may have layers, a shaft with sleeves: their bending stiffnesses and masses add up,
// and their shear stiffnesses with the coefficient of the whole section. A layer may taper
// linearly; the shapes are then those of the beam as it tapers, bent by forces at its ends,
//
//   rotation' = (M + F (l-z)) / EI(z),   deflection' = rotation + F / kappa G A(z)
//
// by quadrature, and the stiffness is exact. Under an axial force N (tension > 0) each plane has
// besides N times the integral of deflection' squared.
//
// A torque T about z on its second end, -T on its first, keeps that direction where it enters and
// leaves (Greenhill 1883; Ziegler, Principles of Structural Stability, 1968): EI w''' - i T w'' is
// constant of w = x + i y, and of a virtual motion
//
//   T times the integral of (d rotation_x' rotation_y - d rotation_y' rotation_x)
//
// The skew part, T/2 at either end, cancels between elements with the same torque.
//
// A flexible coupling is an element, too: two rigid massless arms and, in its middle, a joint that
// is compliant in the transverse direction and in bending, and rotates together with the shaft.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace whirl_twin {

constexpr Eigen::Index kNodeCoordinates = 4;  ///< x, y, alpha, beta

struct ShaftMaterial {
  double youngs_modulus = 0.0;    ///< [Pa]
  double shear_modulus = 0.0;     ///< [Pa]
  double density = 0.0;           ///< [kg/m^3]
  bool shear_deformation = true;  ///< false: Rayleigh's beam
};

/// The joint of a flexible coupling, the same in both planes.
struct ShaftCoupling {
  double lateral_stiffness = 0.0;  ///< [N/m]
  double bending_stiffness = 0.0;  ///< [N m/rad]
  double lateral_damping = 0.0;    ///< [N s/m], turning with the shaft
  double bending_damping = 0.0;    ///< [N m s/rad], likewise
};

/// A hollow cylinder or cone.
struct ShaftSection {
  double length = 0.0;          ///< [m]
  double outer_diameter = 0.0;  ///< [m], at its first end
  double inner_diameter = 0.0;  ///< [m]
  double outer_growth = 0.0;    ///< [m], of the outer diameter to its second end
  double inner_growth = 0.0;    ///< [m]
  std::optional<ShaftMaterial> material = std::nullopt;  ///< none: that of the shaft
  double axial_force = 0.0;                              ///< [N], tension > 0
  double torque = 0.0;                                   ///< [N m], about +z on its second end
  std::optional<ShaftCoupling> coupling = std::nullopt;  ///< its joint, in place of a shaft

  bool tapers() const { return outer_growth != 0.0 || inner_growth != 0.0; }
  /// The cylinder of its diameters at `share` of its length.
  ShaftSection at(double share) const;
  double area() const;          ///< [m^2], at its first end
  double secondMoment() const;  ///< [m^4], about a diameter, at its first end
};

/// What an element is made of, from the shaft outwards.
struct ShaftLayer {
  ShaftMaterial material;
  ShaftSection section;
  double stiffness = 1.0;  ///< [-], share of its stiffness that bends with the shaft; 0: mass only
};

/// kappa of a round section, solid or hollow (Cowper, J. Applied Mechanics 33, 1966).
double shearCoefficient(const ShaftSection& section, double poissons_ratio);

/// In x, y, alpha, beta of the first node, then of the second.
struct ShaftElement {
  using Matrix = Eigen::Matrix<double, 2 * kNodeCoordinates, 2 * kNodeCoordinates>;
  Matrix mass;                          ///< [kg], [kg m], [kg m^2]
  Matrix stiffness;                     ///< [N/m], [N], [N m]
  Matrix gyroscopic;                    ///< per unit of spin, skew
  Matrix of_loads = Matrix::Zero();     ///< of axial force and torque: no stiffness of the material
  Matrix circulatory = Matrix::Zero();  ///< of the torque, skew
  Matrix damping = Matrix::Zero();      ///< of a coupling's joint, turning with it
};

ShaftElement shaftElement(const ShaftMaterial& material, const ShaftSection& section);
/// Layers of one length, the first of which is the shaft.
ShaftElement shaftElement(const std::vector<ShaftLayer>& layers, double axial_force = 0.0,
                          double torque = 0.0);
ShaftElement couplingElement(const ShaftCoupling& coupling, double length, double axial_force = 0.0,
                             double torque = 0.0);

/// An element as a rigid body.
struct ElementBody {
  double mass = 0.0;                ///< [kg]
  double centre = 0.0;              ///< [m], of gravity, from its first end
  double polar_inertia = 0.0;       ///< [kg m^2], about the shaft
  double transverse_inertia = 0.0;  ///< [kg m^2], about a diameter through the centre of gravity
};
ElementBody elementBody(const std::vector<ShaftLayer>& layers);

}  // namespace whirl_twin
