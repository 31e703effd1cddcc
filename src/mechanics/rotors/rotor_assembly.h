// A flexible rotor of shaft elements, rigid discs and bearings, assembled from node to node.
//
//   M q'' + (C + G0 + w G1) q' + (K + N0 + w N1) q + sum over speed-dependent bearings
//     = unbalance + weight
//
// q: x, y, alpha, beta of node 0, then of node 1 ... (shaft_element.h), after those of a node x and
// y of each pedestal below its bearings. A disc of polar moment I_p has I_d alpha'' + I_p w beta'
// and I_d beta'' - I_p w alpha'; askew by tau, the moment of unbalance (I_d - I_p) tau is
// synchronous (rigid_disc.h). A shaft's material with stress = E (strain + eta strain rate), in the
// rotating frame, resists the velocity relative to that frame: eta K_shaft (q' - w J q), J the
// quarter turn from x to y. Forward whirl faster than the shaft is damped, slower whirl is
// destabilized (Kimball 1924; Zorzi and Nelson, J. Engineering for Power 99, 1977); the joint of a
// coupling acts likewise. Damping proportional to the mass and the stiffness of the elements acts
// in the fixed frame, as does modal damping at rest (modal_damping.h).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "mechanics/linear_rotor.h"
#include "mechanics/linearization.h"
#include "mechanics/rotors/modal_damping.h"
#include "mechanics/rotors/moving_coordinates.h"
#include "mechanics/rotors/shaft_element.h"
#include "mechanics/rotors/short_journal_bearing.h"

namespace whirl_twin {

struct RotorDisc {
  int node = 0;
  double mass = 0.0;                ///< [kg]
  double polar_inertia = 0.0;       ///< [kg m^2], about the shaft
  double transverse_inertia = 0.0;  ///< [kg m^2], about a diameter
  double skew = 0.0;                ///< [rad], of its axis to the shaft's
  double skew_angle = 0.0;          ///< [rad], of the slope that is the skew, from the shaft's mark
  double diameter = 0.0;            ///< [m], to be drawn with; 0: as its inertias have it
  double width = 0.0;               ///< [m]
};

/// Around one element.
struct ShaftSleeve {
  int element = 0;
  ShaftLayer layer;  ///< of the element's length
};

struct RotorBearing {
  int node = 0;
  BearingCoefficients coefficients;
};

/// Between the shaft and the body that carries a bearing of its node.
struct RigidSupport {
  int node = 0;
  bool clamps = false;  ///< it holds the slope, too, as the ground does
};

/// [rad/s], that data of a rotor cover: beyond them its coefficients are a guess.
struct DataSpeeds {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();

  bool covers(double speed) const { return !(speed < from || speed > to); }
  bool everywhere() const { return !(from > -std::numeric_limits<double>::infinity()); }
};

/// A bearing whose coefficients follow the shaft's speed [rad/s].
struct SpeedBearing {
  int node = 0;
  std::function<BearingCoefficients(double speed)> coefficients;
  std::vector<double> knots;  ///< [rad/s], ascending: speeds between which they are smooth
  DataSpeeds data = {};       ///< of its table
};

/// A body that translates transversely to the shaft without rotating. It carries the bearings of
/// its node, or the pedestal given before; the next pedestal carries it, and the ground carries the
/// last of a node.
struct RotorPedestal {
  int node = 0;
  double mass_x = 0.0, mass_y = 0.0;  ///< [kg]
  BearingCoefficients coefficients;   ///< between it and the body that carries it
  /// Additional speed-dependent coefficients, speed in [rad/s]; none: constant.
  std::function<BearingCoefficients(double speed)> over_speed = {};
  std::vector<double> knots = {};  ///< [rad/s], of those, as a SpeedBearing's
  DataSpeeds data = {};            ///< of those
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
  std::vector<ShaftSleeve> sleeves = {};
  std::vector<RotorDisc> discs;
  std::vector<RotorBearing> bearings;
  std::vector<SpeedBearing> speed_bearings;
  std::vector<NodeUnbalance> unbalances;
  double gravity = 0.0;  ///< [m/s^2], along -y
  std::vector<RotorPedestal> pedestals = {};
  double mass_damping = 0.0;       ///< [1/s], of the elements: C = this * M
  double stiffness_damping = 0.0;  ///< [s], of the elements: C = this * K
  std::vector<DampingRatio> modal_damping = {};
  std::vector<RigidSupport> rigid_supports = {};
  std::vector<int> pushed = {};  ///< nodes that forces act on which are not among these

  int nodes() const { return static_cast<int>(elements.size()) + 1; }
  /// Of an element, the shaft first.
  std::vector<ShaftLayer> layers(int element) const;
  /// The place in q of a node's x; its pedestals' follow its four.
  Eigen::Index firstOf(int node) const;
  Eigen::Index coordinates() const { return firstOf(nodes()); }
  int pedestalsOf(int node) const;
  std::vector<double> positions() const;  ///< [m], of the nodes
};

struct FullOrderRotor;

/// Adds a bearing at `place` [dof x 2], x and y as place^T q: the bandwidth of the matrices grows
/// as needed.
void addBearing(const BearingCoefficients& bearing, const Eigen::MatrixXd& place,
                BandedLinearization& matrices);

/// The parts of a rotor's equations, in all coordinates or in the amplitudes of shapes.
class RotorAssembly {
 public:
  /// In the coordinates that move (moving_coordinates.h). Throws std::logic_error for a node that
  /// does not exist, InputError for a part without mass that is not held.
  explicit RotorAssembly(const FlexibleShaft& shaft);
  /// In all, as if its rigid supports were not there; those without mass have none.
  static RotorAssembly unsupported(const FlexibleShaft& shaft);

  Eigen::Index dof() const { return constant_.mass.rows(); }
  /// At a constant speed [rad/s]: only adds the parts up.
  Linearization matrices(double speed) const;
  /// The same near the diagonals: in all coordinates work in proportion to the nodes.
  BandedLinearization bandedMatrices(double speed) const;
  /// x and y of a node, as x = along_x . q.
  Station station(int node) const;
  std::vector<Station> stations() const { return stations_; }
  /// Of the shaft's pedestals, in their order.
  std::vector<Station> pedestals() const { return pedestals_; }
  const std::vector<ShaftForce>& forces() const { return forces_; }
  /// Of all coordinates of the shaft, those that are left.
  const std::vector<Eigen::Index>& moving() const { return moving_; }
  /// Of those, the ones that have a mass of kNegligible instead of none.
  const std::vector<Eigen::Index>& massive() const { return massive_; }
  /// That the tables of all bearings and pedestals have.
  DataSpeeds dataSpeeds() const;
  /// f_0 [N] or [N m].
  const Eigen::VectorXd& load() const { return load_; }
  /// Of rotating damping (spin_coupling.h): N_1, and the damping in the rotating frame.
  const Eigen::MatrixXd& circulatoryPerSpeed() const { return circulatory_per_speed_; }
  const Eigen::MatrixXd& turningDamping() const { return turning_damping_; }
  /// With q = shapes * amplitudes. [dof x n]
  RotorAssembly in(const Eigen::MatrixXd& shapes) const;
  /// `unreduced`: what in() has made it of, with what else acts there.
  LinearRotor linearRotor(std::shared_ptr<const FullOrderRotor> unreduced = nullptr) const;

 private:
  RotorAssembly() = default;

  struct PlacedBearing {
    SpeedBearing bearing;
    Eigen::MatrixXd place;  ///< [dof x 2], of x and y
  };

  /// Returns the rotating damping of the elements.
  Eigen::MatrixXd addElements(const FlexibleShaft& shaft);
  void addSupports(const FlexibleShaft& shaft);
  void assemble(const FlexibleShaft& shaft);
  /// Leaves the coordinates that move.
  void reduce(const FlexibleShaft& shaft);
  void makeBands();

  Linearization constant_;
  Eigen::MatrixXd gyroscopic_per_speed_, circulatory_per_speed_, turning_damping_;
  std::vector<PlacedBearing> speed_bearings_;
  std::vector<ShaftForce> forces_;
  Eigen::VectorXd load_;
  std::vector<Eigen::Index> moving_, massive_;
  std::vector<Station> stations_, pedestals_;
  BandedLinearization banded_;  // constant_ and both per speed
  BandedMatrix<double> banded_gyroscopic_, banded_circulatory_;
};

/// What LinearRotor::matrices of a RotorAssembly is: whoever finds this in it
/// (std::function::target) can have its matrices near their diagonals, and the rotor that it was
/// before it was reduced.
struct AssembledMatrices {
  std::shared_ptr<const RotorAssembly> assembly;
  std::shared_ptr<const FullOrderRotor> unreduced = nullptr;  ///< none: it has all coordinates
  Linearization operator()(double speed) const { return assembly->matrices(speed); }
};

/// Of the rotor that a scene's drawing was made into; of any other everywhere.
DataSpeeds dataSpeeds(const LinearRotor& rotor);

/// The rigid supports as coordinates of the shaft.
std::vector<HeldCoordinate> heldCoordinates(const FlexibleShaft& shaft);

}  // namespace whirl_twin
