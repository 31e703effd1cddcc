#include "models/linear_rotor_setup.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "analysis/sommerfeld_speeds.h"
#include "integration/exponential.h"
#include "integration/lateral_rotor_stepper.h"
#include "integration/linear_methods.h"
#include "integration/linear_rotor_stepper.h"
#include "integration/linear_stepper.h"
#include "integration/spinning_rotor_stepper.h"
#include "mechanics/linear_rotor_dynamics.h"
#include "mechanics/locally_forced_rotor.h"
#include "mechanics/spinning_rotor.h"
#include "models/exact_stepper.h"

namespace whirl_twin {

ModelSetup linearSetup(LinearModel model) {
  const auto dynamics = std::make_shared<const LinearDynamics>(std::move(model));
  return {dynamics, linearMethodNames(),
          [dynamics](const std::string& integrator, const StepContext& excitation, double step,
                     int substeps) {
            return std::make_unique<LinearStepper>(dynamics->linearModel(), integrator, step,
                                                   substeps, excitation.inputs);
          }};
}

namespace {

constexpr double kBeyond = 1.05;      // of the motor's highest speed: a whirl swings the spin, too
constexpr double kBackwards = -0.02;  // of it: a heavy rotor at standstill may swing back
// Cost of a step besides its products, in accelerations of a pendulum of two coordinates.
constexpr double kForcedStep = 80.0;
constexpr double kSpinningStep = 150.0;
constexpr double kNoLimit = 9.0e5;  // [rad/s], highestSpeed() of a motor without one is beyond

/// Speeds [rad/s] that a rotor on its motor may come to.
std::pair<double, double> speedsOn(const Motor& motor, const StepContext& excitation,
                                   std::size_t torque, double highest) {
  const double start = excitation.drive.at(0.0).speed;
  const double of_motor = kBeyond * highestSpeed(motor);
  const bool driven = excitation.inputs != nullptr && excitation.inputs->acts(torque);
  const double fastest = driven ? std::max(of_motor < kNoLimit ? of_motor : 0.0, highest)
                         : of_motor < kNoLimit ? of_motor
                                               : highest;
  return {std::min(kBackwards * fastest, kBeyond * start), std::max(fastest, kBeyond * start)};
}

/// ModelSetup::evaluation_cost of steps that take so much besides.
double evaluationCost(const Dynamics& dynamics, double besides) {
  const double pairs = std::max(1.0, 0.5 * dynamics.dof());
  return 1.0 + besides / (pairs * pairs);
}

}  // namespace

std::unique_ptr<Stepper> exactStepper(std::shared_ptr<const Dynamics> dynamics,
                                      JacobiIntegral jacobi, const StepContext& excitation,
                                      double step, int substeps) {
  return std::make_unique<LinearRotorStepper>(std::move(dynamics), std::move(jacobi), excitation,
                                              step, substeps);
}

ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics,
                            std::vector<LocalForce> forces) {
  const bool locally_forced = !forces.empty();
  if (locally_forced) {
    dynamics = std::make_shared<LocallyForcedRotor>(std::move(dynamics), forces);
  }
  ModelSetup setup;
  setup.dynamics = dynamics;
  setup.integrators = {Exponential<1>::kName};
  setup.system = [dynamics, forces = std::move(forces)](
                     const std::string&, const StepContext& excitation, double step, int substeps) {
    return std::make_unique<LinearRotorStepper>(dynamics, JacobiIntegral(), excitation, step,
                                                substeps, forces);
  };
  setup.exact_run_ups = true;
  setup.evaluation_cost = locally_forced ? evaluationCost(*dynamics, kForcedStep) : 1.0;
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
  setup.system = [dynamics, highest_speed](const std::string&, const StepContext& excitation,
                                           double step, int substeps) {
    return std::make_unique<SpinningRotorStepper>(
        dynamics, excitation, step, substeps,
        speedsOn(dynamics->coupling().motor, excitation, dynamics->inputs().size() - 1,
                 highest_speed));
  };
  setup.exact_run_ups = true;
  setup.evaluation_cost = evaluationCost(*dynamics, kSpinningStep);
  return setup;
}

ModelSetup withExactRunUps(ModelSetup setup, JacobiIntegral jacobi) {
  setup.system = [dynamics = setup.dynamics, plain = setup.system, jacobi](
                     const std::string& integrator, const StepContext& excitation, double step,
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

ModelSetup withExactLinearPart(ModelSetup setup, std::shared_ptr<const Dynamics> linear,
                               double damping, JacobiIntegral jacobi,
                               std::vector<LocalForce> forces) {
  RotorDescription description;
  description.model = linear->model();
  description.coordinates = linear->coordinates();
  description.stations = linear->stations();
  description.casing = linear->casing();
  description.inputs = linear->inputs();
  LinearRotor rotor = linear->linearRotor();
  Eigen::MatrixXd damped = Eigen::MatrixXd::Zero(linear->dof(), linear->dof());
  for (const LocalForce& force : forces) {
    damped += damping * (force.along_x * force.along_x.transpose() +
                         force.along_y * force.along_y.transpose());
  }
  rotor.matrices = [linear = std::move(linear), plain = rotor.matrices, damped](double speed) {
    Linearization l = plain(speed);
    l.damping += damped;
    return l;
  };
  const auto stepped =
      std::make_shared<LinearRotorDynamics>(std::move(description), std::move(rotor));
  setup.integrators.emplace_back(Exponential<1>::kName);
  setup.system = [stepped, plain = setup.system, jacobi = std::move(jacobi),
                  forces = std::move(forces)](const std::string& integrator,
                                              const StepContext& excitation, double step,
                                              int substeps) -> std::unique_ptr<Stepper> {
    if (integrator != Exponential<1>::kName) {
      return plain(integrator, excitation, step, substeps);
    }
    return std::make_unique<LinearRotorStepper>(stepped, jacobi, excitation, step, substeps,
                                                forces);
  };
  setup.exact_run_ups = true;
  return setup;
}

}  // namespace whirl_twin
