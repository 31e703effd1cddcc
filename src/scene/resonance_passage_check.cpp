#include "scene/resonance_passage_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <optional>

#include "algebra/constants.h"
#include "analysis/sommerfeld_speeds.h"
#include "analysis/synchronous_poles.h"
#include "analysis/synchronous_response.h"
#include "control/drive.h"
#include "controllers/controller_registry.h"
#include "controllers/speed_trajectory.h"
#include "scene/controller_reader.h"
#include "scene/held_rotor.h"
#include "scene/model_context.h"

namespace whirl_twin {

namespace {

constexpr int kCoarse = 200;          // speeds in a band, besides those near its resonances
constexpr double kStepsPerTurn = 40;  // of the shaft, at the upper edge
constexpr int kMaxSteps = 2000000;    // of a simulation

struct Rotor {
  SharedSystem system;
  RotorOnMotor taken_apart;
};

/// The rotor of a controller; nothing if the whirl is not linear, or the controller does not both
/// measure and drive this rotor.
std::optional<Rotor> rotorOf(const Scene& scene, const ControllerSpec& controller) {
  const SignalSpec& measured = controller.measures.front();
  const SystemSpec& spec = scene.systems[measured.system];
  if (controller.acts_on.front().system != measured.system || spec.ensemble.count > 0) {
    return std::nullopt;
  }
  const SharedSystem system = build(spec, surroundingsOf(scene, spec), scene.driveOf(spec));
  const std::optional<RotorOnMotor> driven = rotorOnMotor(*system);
  if (!driven || !driven->held->linear() || !driven->held->hasShaft()) {
    return std::nullopt;
  }
  return Rotor{system, *driven};
}

/// The speed in a band at which whirl and drag exceed the available torque most; nothing if the
/// torque is sufficient everywhere.
std::optional<ResonancePassageCheck> weakest(const RotorOnMotor& rotor, const SpeedTrajectory& way,
                                             const SpeedBand& band) {
  const LinearRotor whirling = rotor.held->linearRotor();
  std::optional<ResonancePassageCheck> found;
  double most = 0.0;
  for (const double speed : speedsToLookAt(synchronousPoles(whirling, band.from, band.to),
                                           band.from, band.to, kCoarse)) {
    const double whirl = whirlTorque(whirling, speed);
    const double needed = (std::isfinite(whirl) ? whirl : std::numeric_limits<double>::infinity()) +
                          rotor.motor.drag * speed - rotor.motor.torque(speed);
    const double given = way.torque(speed);
    if (needed - given > most) {
      most = needed - given;
      found = ResonancePassageCheck{band, speed, needed, given, false};
    }
  }
  return found;
}

/// Simulates the passage of a band. `up`: the sign of the speeds. True also if the simulation stops
/// without a result: the passage is then not excluded.
bool passes(const Scene& scene, const ControllerSpec& controller, const Rotor& rotor,
            const SpeedTrajectory& way, const SpeedBand& band, double up) {
  const BuiltSystem& system = *rotor.system;
  const auto step = static_cast<std::int64_t>(1.0e9 * kTwoPi / (kStepsPerTurn * band.to));
  const double length = static_cast<double>(step) / 1.0e9;
  const double start = up * std::max(0.0, band.from - way.run_up);
  const Drive drive(start, 0.0);
  std::vector<InputSignal> signals(system.dynamics->inputs().size());
  const std::size_t torque = controller.acts_on.front().input;
  signals[torque] = InputSignal::controlled();
  Inputs inputs(signals);
  const std::unique_ptr<Stepper> stepper =
      system.setup().system("runge_kutta_4", {drive, &inputs}, length, 1);
  std::vector<double> q(system.spec.q.size()), v(system.spec.v.size());
  const Eigen::VectorXcd whirl =
      synchronousResponse(rotor.taken_apart.held->linearRotor(), {}, start).q;
  for (Eigen::Index i = 0; i < whirl.size() && start != 0.0; ++i) {
    q[static_cast<std::size_t>(i)] = whirl[i].real();
    v[static_cast<std::size_t>(i)] = (std::complex<double>(0.0, start) * whirl[i]).real();
  }
  v.back() = start;
  stepper->set(q.data(), v.data());

  ControllerPlan plan = planOf(scene, controller);
  plan.rate = 1.0 / length;
  plan.limits = {way.torque_limit};
  const std::unique_ptr<Controller> law =
      findController(controller.type)->make(controller.parameters, controller.settings, plan);
  ShaftState shaft;
  for (int k = 0; k < kMaxSteps; ++k) {
    if (!stepper->shaft(shaft) || up * shaft.speed >= band.to) {
      return true;
    }
    double u = 0.0;
    law->update({&shaft.speed, k, k * step, shaft.angle, shaft.speed}, &u);
    if (law->supervision() == state::Supervision::kGivenUp) {
      return false;
    }
    inputs.begin(k * step);
    inputs.control(torque, u, k * step);
    if (stepper->step(static_cast<double>(k) * length) != StepStatus::kOk) {
      return true;
    }
  }
  return true;
}

}  // namespace

std::vector<ResonancePassageCheck> resonancePassageChecks(const Scene& scene,
                                                          const ControllerSpec& controller) {
  const SpeedTrajectory way =
      speedWayOf(controller.parameters, controller.settings, planOf(scene, controller));
  const std::optional<Rotor> rotor = way.bands.empty() ? std::nullopt : rotorOf(scene, controller);
  std::vector<ResonancePassageCheck> found;
  if (!rotor) {
    return found;
  }
  const double up = std::copysign(1.0, way.target);
  const double start = up * scene.systems[controller.measures.front().system].v.back();
  const bool tries = controller.settings.choices.at("weak_motor") == "try";
  for (const SpeedBand& band : way.bands) {
    if (band.to <= start || band.to > up * way.target) {
      continue;
    }
    std::optional<ResonancePassageCheck> weak = weakest(rotor->taken_apart, way, band);
    if (weak) {
      weak->tried = tries || passes(scene, controller, *rotor, way, band, up);
      found.push_back(*weak);
      if (!weak->tried) {
        break;
      }
    }
  }
  return found;
}

std::vector<SpeedBand> avoidedBands(const Scene& scene, const ControllerSpec& controller) {
  return controller.type != "speed"
             ? std::vector<SpeedBand>{}
             : speedWayOf(controller.parameters, controller.settings, planOf(scene, controller))
                   .bands;
}

std::string describe(const ResonancePassageCheck& passage) {
  return fmt::format(
      "from {:.4g} to {:.4g} rad/s: at {:.4g} rad/s ({:.0f} rpm) a steady whirl needs {}, but the "
      "motor has "
      "{:.4g} N m",
      passage.band.from, passage.band.to, passage.speed, passage.speed * 30.0 / kPi,
      std::isfinite(passage.needed) ? fmt::format("{:.4g} N m", passage.needed)
                                    : "an unlimited torque",
      passage.given);
}

}  // namespace whirl_twin
