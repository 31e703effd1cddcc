#include "twin/observed_states.h"

#include <cmath>

#include "algebra/constants.h"
#include "scene/system_setup.h"

namespace whirl_twin {

state::WhirlState whirlState(const WhirlMotion& at, const WhirlPhase& phase, const ShaftView& shaft,
                             double slowest_orbit) {
  state::WhirlState s;
  s.x = at.x;
  s.y = at.y;
  s.x_rate = at.x_rate;
  s.y_rate = at.y_rate;
  s.radius = at.radius();
  s.phase_valid = phase.valid();
  s.phase = phase.lag();
  s.whirl_angle = s.phase_valid ? std::atan2(at.y, at.x) : kNaN;
  s.whirl_rate =
      s.phase_valid ? (at.x * at.y_rate - at.y * at.x_rate) / (s.radius * s.radius) : kNaN;
  s.speed = shaft.speed();
  s.shaft_angle = shaft.angle().total();
  s.orbit_major = s.orbit_minor = kNaN;
  if (std::fabs(s.speed) > slowest_orbit) {
    // z = f e^(iwt) + b e^(-iwt), with z' known: forward and backward components of the 1X orbit.
    const double vx = at.x_rate / s.speed;
    const double vy = at.y_rate / s.speed;
    const double forward = 0.5 * std::hypot(at.x + vy, at.y - vx);
    const double backward = 0.5 * std::hypot(at.x - vy, at.y + vx);
    s.orbit_major = forward + backward;
    s.orbit_minor = std::fabs(forward - backward);
    s.forward = forward >= backward;
  }
  return s;
}

state::PendulumState pendulumState(const std::vector<CoordinateInfo>& coordinates,
                                   const SystemView& system, const Energies& energies) {
  state::PendulumState s;
  for (const CoordinateInfo& c : coordinates) {
    s.name.emplace_back(c.name);
  }
  s.angle.assign(system.q(), system.q() + system.dof());
  s.rate.assign(system.v(), system.v() + system.dof());
  s.kinetic = energies.kinetic;
  s.potential = energies.potential;
  return s;
}

state::DriveState driveState(const ShaftView& shaft) {
  state::DriveState s;
  s.turns = shaft.turns();
  s.remainder = shaft.remainder();
  s.speed = shaft.speed();
  s.acceleration = shaft.acceleration();
  s.jerk = shaft.jerk();
  s.target_speed = shaft.targetSpeed();
  s.shaft_angle = shaft.angle().total();
  return s;
}

state::MotorState motorState(const Motor& motor, const MotorTrack& track, const ShaftView& shaft,
                             const Energies& energies) {
  state::MotorState s;
  s.speed = shaft.speed();
  s.acceleration = shaft.acceleration();
  s.torque = motor.torque(s.speed);
  s.motor_power = track.power();
  s.drag_power = motor.drag * s.speed * s.speed;
  s.dissipated_power = energies.dissipated_power - s.drag_power;
  s.energy = energies.kinetic + energies.potential;
  s.motor_work = track.work();
  s.dissipated_work = track.dissipated();
  return s;
}

state::ControllerState controllerState(const ControllerSpec& spec, const Scene& scene,
                                       const ControllerPlace<const double>& controller) {
  state::ControllerState state;
  state.controller = spec.name;
  state.signal = spec.measured;
  for (const SignalSpec& signal : spec.measures) {
    state.signal_unit.push_back(signal.unit);
  }
  state.value.assign(controller.values(), controller.values() + spec.measures.size());
  state.input = spec.acted_on;
  for (const ActedInput& acted : spec.acts_on) {
    state.input_unit.push_back(
        scene.systems[acted.system].setup->made.dynamics->inputs()[acted.input].unit);
  }
  state.output.assign(controller.outputs(), controller.outputs() + spec.acts_on.size());
  state.samples = controller.samples();
  state.saturated = controller.saturated();
  state.missed = controller.missed();
  state.age = controller.age();
  state.lost = controller.lost();
  state.supervision = static_cast<state::Supervision>(controller.supervision());
  return state;
}

}  // namespace whirl_twin
