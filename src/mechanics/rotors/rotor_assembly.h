// A flexible rotor of shaft elements, rigid discs and bearings, assembled from node to node.
//
//   M q'' + (C + G0 + w G1) q' + (K + N0 + w N1) q + sum over bearings that follow the speed
//     = unbalance + weight
//
// q: x, y, alpha, beta of node 0, then of node 1 ... (shaft_element.h). A disc of polar moment I_p
// has I_d alpha'' + I_p w beta' and I_d beta'' - I_p w alpha'. A shaft's material with stress =
// E (strain + eta strain rate), in the frame that turns with it, resists the velocity seen from
// there: eta K_shaft (q' - w J q), J the quarter turn from x to y. Forward whirl faster than the
// shaft is damped, slower than it is fed (Kimball 1924; Zorzi and Nelson, J. Engineering for Power
// 99, 1977).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "mechanics/banded_linearization.h"
#include "mechanics/linear_rotor.h"
#include "mechanics/rotors/shaft_element.h"
#include "mechanics/rotors/short_journal_bearing.h"

namespace whirl_twin {

struct RotorDisc {
  int node = 0;
  double mass = 0.0;                ///< [kg]
  double polar_inertia = 0.0;       ///< [kg m^2], about the shaft
  double transverse_inertia = 0.0;  ///< [kg m^2], about a diameter
};

struct RotorBearing {
  int node = 0;
  BearingCoefficients coefficients;
};

/// A bearing whose coefficients follow the shaft's speed [rad/s].
struct SpeedBearing {
  int node = 0;
  std::function<BearingCoefficients(double speed)> coefficients;
  std::vector<double> knots;  ///< [rad/s], ascending: speeds between which they are smooth
};

struct NodeUnbalance {
  int node = 0;
  double magnitude = 0.0;  ///< [kg m]
  double angle = 0.0;      ///< [rad], from the shaft's mark
};

struct FlexibleShaft {
  ShaftMaterial material;
  double internal_damping = 0.0;       ///< [s], eta
  std::vector<ShaftSection> elements;  ///< element i joins node i and node i + 1
  std::vector<RotorDisc> discs;
  std::vector<RotorBearing> bearings;
  std::vector<SpeedBearing> speed_bearings;
  std::vector<NodeUnbalance> unbalances;
  double gravity = 0.0;  ///< [m/s^2], along -y

  int nodes() const { return static_cast<int>(elements.size()) + 1; }
  std::vector<double> positions() const;  ///< [m], of the nodes
};

/// The parts of a rotor's equations, in all coordinates or in the amplitudes of shapes.
class RotorAssembly {
 public:
  /// Throws std::logic_error for a node that does not exist.
  explicit RotorAssembly(const FlexibleShaft& shaft);

  Eigen::Index dof() const { return constant_.mass.rows(); }
  /// At a constant speed [rad/s]: only adds the parts up.
  Linearization matrices(double speed) const;
  /// The same near the diagonals: in all coordinates work in proportion to the nodes.
  BandedLinearization bandedMatrices(double speed) const;
  /// x and y of a node, as x = along_x . q.
  Station station(int node) const;
  std::vector<Station> stations() const { return stations_; }
  const std::vector<ShaftForce>& forces() const { return forces_; }
  /// With q = shapes * amplitudes. [dof x n]
  RotorAssembly in(const Eigen::MatrixXd& shapes) const;
  LinearRotor linearRotor() const;

 private:
  struct PlacedBearing {
    SpeedBearing bearing;
    Eigen::MatrixXd place;  ///< [dof x 2], of x and y
  };

  void makeBands();

  Linearization constant_;
  Eigen::MatrixXd gyroscopic_per_speed_, circulatory_per_speed_;
  std::vector<PlacedBearing> speed_bearings_;
  std::vector<ShaftForce> forces_;
  Eigen::VectorXd load_;
  std::vector<Station> stations_;
  BandedLinearization banded_;  // constant_ and both per speed
  BandedMatrix<double> banded_gyroscopic_, banded_circulatory_;
};

/// What LinearRotor::matrices of a RotorAssembly is: whoever finds this in it
/// (std::function::target) can have its matrices near their diagonals.
struct AssembledMatrices {
  std::shared_ptr<const RotorAssembly> assembly;
  Linearization operator()(double speed) const { return assembly->matrices(speed); }
};

}  // namespace whirl_twin
