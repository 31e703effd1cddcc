#include "models/linear_rotor_setup.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/sommerfeld_speeds.h"
#include "integration/exponential.h"
#include "integration/lateral_rotor_stepper.h"
#include "integration/linear_rotor_stepper.h"
#include "integration/spinning_rotor_stepper.h"
#include "mechanics/locally_forced_rotor.h"
#include "mechanics/spinning_rotor.h"
#include "models/exact_stepper.h"

namespace whirl_twin {

namespace {

constexpr double kBeyond = 1.05;      // of the motor's highest speed: a whirl swings the spin, too
constexpr double kBackwards = -0.02;  // of it: a heavy rotor that stands may swing back
constexpr double kNoLimit = 9.0e5;    // [rad/s], highestSpeed() of a motor without one is beyond

/// Speeds [rad/s] that a rotor on its motor may come to.
std::pair<double, double> speedsOn(const Motor& motor, const Excitation& excitation,
                                   std::size_t torque, double highest) {
  const double start = excitation.drive.at(0.0).speed;
  const double of_motor = kBeyond * highestSpeed(motor);
  const bool driven = excitation.inputs != nullptr && excitation.inputs->acts(torque);
  const double fastest = driven ? std::max(of_motor < kNoLimit ? of_motor : 0.0, highest)
                         : of_motor < kNoLimit ? of_motor
                                               : highest;
  return {std::min(kBackwards * fastest, kBeyond * start), std::max(fastest, kBeyond * start)};
}

}  // namespace

std::unique_ptr<Stepper> exactStepper(std::shared_ptr<const Dynamics> dynamics,
                                      JacobiIntegral jacobi, const Excitation& excitation,
                                      double step, int substeps) {
  return std::make_unique<LinearRotorStepper>(std::move(dynamics), std::move(jacobi), excitation,
                                              step, substeps);
}

ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics,
                            std::vector<LocalForce> forces) {
  if (!forces.empty()) {
    dynamics = std::make_shared<LocallyForcedRotor>(std::move(dynamics), forces);
  }
  ModelSetup setup;
  setup.dynamics = dynamics;
  setup.integrators = {Exponential<1>::kName};
  setup.system = [dynamics, forces = std::move(forces)](
                     const std::string&, const Excitation& excitation, double step, int substeps) {
    return std::make_unique<LinearRotorStepper>(dynamics, JacobiIntegral(), excitation, step,
                                                substeps, forces);
  };
  setup.exact_run_ups = true;
  return setup;
}

ModelSetup spinningRotorSetup(std::shared_ptr<const Dynamics> held, std::vector<LocalForce> forces,
                              SpinCoupling coupling, double highest_speed) {
  if (!forces.empty()) {
    held = std::make_shared<LocallyForcedRotor>(std::move(held), forces);
  }
  const auto dynamics = std::make_shared<const SpinningRotor>(std::move(held), std::move(forces),
                                                              std::move(coupling));
  ModelSetup setup;
  setup.dynamics = dynamics;
  setup.integrators = {Exponential<1>::kName};
  setup.system = [dynamics, highest_speed](const std::string&, const Excitation& excitation,
                                           double step, int substeps) {
    return std::make_unique<SpinningRotorStepper>(
        dynamics, excitation, step, substeps,
        speedsOn(dynamics->coupling().motor, excitation, dynamics->inputs().size() - 1,
                 highest_speed));
  };
  setup.exact_run_ups = true;
  return setup;
}

ModelSetup withExactRunUps(ModelSetup setup, JacobiIntegral jacobi) {
  setup.system = [dynamics = setup.dynamics, plain = setup.system, jacobi](
                     const std::string& integrator, const Excitation& excitation, double step,
                     int substeps) {
    if (integrator != Exponential<1>::kName) {
      return plain(integrator, excitation, step, substeps);
    }
    if (excitation.inputs == nullptr) {
      if (auto lateral =
              LateralRotorStepper::of(dynamics->linearRotor(), excitation.drive, step, substeps)) {
        return lateral;
      }
    }
    return exactStepper(dynamics, jacobi, excitation, step, substeps);
  };
  setup.exact_run_ups = true;
  return setup;
}

}  // namespace whirl_twin
