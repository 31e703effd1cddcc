// The exact step of a linear rotor (rotor_step.h) with nonlinear nodal forces
// (mechanics/local_force.h).
//
// Over a step each force is the quadratic in time that interpolates its values at the three Radau
// nodes, the last of them the end of the step. The rotor's response to that is exact for any
// stiffness; the forces depend on the resulting motion, so the step is implicit in them: Radau IIA
// of the local forces alone, an exponential collocation (Hochbruck & Ostermann, Acta Numerica 19,
// 2010). Its error is of order h^6 a step, it is stable for any stiffness of the forces, and
// without nonlinear forces there is no error.
//
// The unknowns are three values of each force, for any number of coordinates: the response of the
// nodes to them is a small matrix, prepared for each constant speed, and Newton's method with the
// derivatives of the forces solves for them. In a run-up the prepared matrix is approximate: there
// the rotor step is repeated until forces and motion are consistent; where the rotor's matrices do
// not depend on the speed it is exact, and one pass is sufficient.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "control/drive.h"
#include "control/inputs.h"
#include "integration/applied_inputs.h"
#include "integration/linear_stepper.h"
#include "integration/motion_state.h"
#include "integration/packed_matrix.h"
#include "integration/rotor_step.h"
#include "integration/shaft_spin.h"
#include "mechanics/linear_rotor.h"
#include "mechanics/local_force.h"
#include "mechanics/spin_coupling.h"
#include "realtime/state_image.h"

namespace whirl_twin {

/// Forces on a rotor other than synchronous ones.
struct RotorForcing {
  const Inputs* inputs = nullptr;  ///< of the model, outlives the steps; nullptr: nothing acts
  Eigen::MatrixXd directions;      ///< a column an input
  std::vector<LocalForce> forces;
  const SpinCoupling* spin = nullptr;         ///< of a shaft with free spin; needed to prepare only
  std::size_t torque = LocalForce::kNoInput;  ///< the input on that shaft
};

class ForcedRotorStep {
 public:
  /// As RotorStep.
  ForcedRotorStep(const LinearRotor& rotor, double h, const std::pair<double, double>& speeds,
                  const std::vector<double>& constant_speeds, const RotorForcing& forcing);

  double lowestSpeed() const { return whole_.lowestSpeed(); }    ///< [rad/s]
  double highestSpeed() const { return whole_.highestSpeed(); }  ///< [rad/s]

  // Real-time safe.

  void restart() noexcept { whole_.restart(); }
  void exchange(StateImage& image) noexcept { image(whole_); }
  /// As RotorStep. kNoGap: the step would take the rotor to where a law has no place;
  /// kNotConverged: forces and places could not be made to agree.
  StepStatus advance(const Drive& drive, double offset, LinearMotion& motion) noexcept;
  /// The same for a rotor with a free spin, from offset [s] after begin() of the inputs.
  StepStatus advance(double offset, SpinMotion& spin, LinearMotion& motion) noexcept;
  /// As RotorStep; never with local forces.
  bool advanceInParts(const Drive& drive, std::int64_t from, std::int64_t to,
                      LinearMotion& motion) noexcept {
    return whole_.advanceInParts(drive, from, to, motion);
  }

 private:
  static constexpr std::size_t kNodes = kRadauNodes.size();

  /// How the places answer, at a constant speed.
  struct Response {
    double speed;
    PackedMatrix start;     ///< places and rates at the nodes, of RotorStep::constantStart()
    Eigen::MatrixXd force;  ///< the same, of the forces at the nodes
  };

  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(2 * kNodes * forces_.size()); }
  Response response(const LinearRotor& rotor, double speed) const;
  const Response& responseNear(double speed) const noexcept;
  void setInputs(double offset) noexcept;
  bool pushes(const Eigen::VectorXd& at, Eigen::VectorXd& out) noexcept;
  void linearize(const Eigen::MatrixXd& response) noexcept;
  double relativeResidual() const noexcept;
  bool look(const Eigen::MatrixXd& response) noexcept;
  StepStatus newton(const Eigen::MatrixXd& response) noexcept;
  StepStatus solve(const Eigen::MatrixXd& response) noexcept;
  void factor() noexcept;
  void substitute() noexcept;
  void pushCourses(RotorStep& step, double length) noexcept;
  template <class Shaft>
  StepStatus goTo(std::size_t node, const Shaft& shaft, double offset,
                  LinearMotion& motion) noexcept;
  StepStatus changingStep(const Drive& drive, double offset, LinearMotion& motion) noexcept;
  StepStatus findForces(const Response& response, int round, bool& agreed) noexcept;
  double torqueAt(std::size_t node, double offset) const noexcept;
  double inputAt(std::size_t input, double time, std::int64_t piece) const noexcept;
  void readPlaces(const LinearMotion& motion, std::size_t node) noexcept;
  bool begin(const LinearMotion& motion) noexcept;
  void predict(const Eigen::MatrixXd& response) noexcept;
  bool nearlyTouches() const noexcept;

  std::vector<LocalForce> forces_;
  const Inputs* inputs_;
  double h_;
  bool steady_;  ///< the matrices do not follow the speed: a response is that at any
  AppliedInputs acting_;
  std::size_t torque_;
  RotorStep whole_;
  std::optional<ShaftSpin> spin_;
  std::vector<RotorStep> to_nodes_;  ///< inside the step; where the speed changes
  std::vector<Response> responses_;
  // Work space of a step. Places: x, y, x', y' of each force at the first node, then at the next.
  // Values: x, y of each force likewise.
  std::vector<LocalState> states_;
  LinearMotion from_;
  Eigen::VectorXd places_;          ///< that go with given_
  Eigen::VectorXd given_;           ///< forces
  Eigen::VectorXd forced_;          ///< the forces sought
  Eigen::VectorXd moved_;           ///< places that go with forced_
  Eigen::VectorXd law_;             ///< the forces at moved_
  Eigen::VectorXd sizes_;           ///< [N], size of the terms of the forces
  Eigen::VectorXd rounding_;        ///< [N], by which their places round
  Eigen::VectorXd residual_;        ///< law_ - forced_
  Eigen::VectorXd start_, change_;  ///< of a step of Newton's method
  Eigen::MatrixXd slopes_;          ///< of law_, by its own places [unknowns x 4]
  Eigen::MatrixXd jacobian_;        ///< in its factors
  std::vector<Eigen::Index> pivots_;
  Eigen::VectorXd result_;
};

}  // namespace whirl_twin
