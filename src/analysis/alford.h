// The cross-coupled stiffness that the working fluid of a stage is taken to have where nothing
// better is known (J. Alford, J. Engineering for Power 87, 1965; as API 617 has it for level I,
// modified by J. Wachel and W. von Nimitz, J. Petroleum Technology 33, 1981):
//
//   q = B (P / w) / (D H) * ratio
//
// P the power of the stage, w the speed, D the diameter of its impeller (an axial stage: at the
// blades' pitch), H the least width of its discharge, at the impeller or the diffuser (axial: the
// blades' height). A centrifugal stage has B = 3 and the ratio of the densities at discharge and
// suction; an axial one B = 1.5 and no ratio.
#pragma once

namespace whirl_twin {

struct Stage {
  double power = 0.0;          ///< P [W]
  double diameter = 0.0;       ///< D [m]
  double width = 0.0;          ///< H [m]
  double density_ratio = 1.0;  ///< [-]
  bool axial = false;
};

/// q [N/m] at a speed > 0 [rad/s].
inline double alfordCrossCoupling(const Stage& stage, double speed) {
  const double torque = stage.power / speed;
  return stage.axial ? 1.5 * torque / (stage.diameter * stage.width)
                     : 3.0 * torque / (stage.diameter * stage.width) * stage.density_ratio;
}

}  // namespace whirl_twin
