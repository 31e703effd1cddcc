// Forces at places along a rotor that are not linear (mechanics/local_force.h), while the exact
// step of the linear rotor takes it along (rotor_step.h).
//
// Over a step each force is the cubic of time that has its value and its rate at both ends. To that
// the rotor answers exactly, however stiff; and as the force at the end is that of where it then
// is, the step is repeated until both agree. The error of a step is of order h^5, and where nothing
// but the linear part acts there is none.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "control/drive.h"
#include "control/inputs.h"
#include "integration/linear_step.h"
#include "integration/motion_state.h"
#include "integration/rotor_step.h"
#include "mechanics/local_force.h"

namespace whirl_twin {

class LocalForces {
 public:
  /// `inputs`, those of the model, outlive it; nullptr: nothing acts.
  LocalForces(std::vector<LocalForce> forces, const Inputs* inputs, Eigen::Index dof);

  bool any() const noexcept { return !forces_.empty(); }
  const std::vector<LocalForce>& all() const { return forces_; }
  /// Along x and y of each in turn [n x 2 count].
  const Eigen::MatrixXd& directions() const { return directions_; }

  /// A step of h [s] from offset [s] after the drive's begin(), of a RotorStep that pushes along
  /// directions(). Real-time safe. kNoGap: it would take the rotor to where a law has no place.
  StepStatus advance(RotorStep& step, const Drive& drive, double offset, double h,
                     LinearMotion& motion) noexcept;

 private:
  bool pushes(const LinearMotion& motion, double start, double offset,
              std::vector<LocalPush>& out) const noexcept;

  bool nearlyTouches(const LinearMotion& motion) const noexcept;

  std::vector<LocalForce> forces_;
  const Inputs* inputs_;
  Eigen::MatrixXd directions_;
  // Room for a step.
  LinearMotion from_;
  std::vector<LocalPush> start_, end_, found_;
};

}  // namespace whirl_twin
