// The energy audit holds: over ten seconds the Jacobi integral gains what the audited work says, to
// 1e-10 of the largest energy in play, for any parameters.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene/model_registry.h"
#include "scene/observer.h"
#include "scenes.h"

namespace whirl_twin {
namespace {

constexpr int kDraws = 200;

struct Audit {
  const char* name;
  const char* model;
  const char* integrator;
  double frequency_times_step;  // of the fastest motion
  bool driven;                  // on a shaft that changes its speed
};

void PrintTo(const Audit& a, std::ostream* out) {
  *out << a.name;
}

class EnergyResidual : public testing::TestWithParam<Audit> {
 protected:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// A random system; its fastest frequency [rad/s], with its speed.
  double randomSystem(SystemSpec& spec) {
    spec.name = "one";
    spec.model = GetParam().model;
    spec.integrator = GetParam().integrator;
    const double speed = between(-20.0, 20.0);
    if (findModel(spec.model)->has_shaft && !GetParam().driven) {
      spec.speed = speed;
    } else if (GetParam().driven) {
      spec.drive = "shaft";
    }
    if (spec.model == "jeffcott_rotor") {
      const double m = between(0.5, 5.0);
      const double p = between(5.0, 20.0);
      spec.parameters = {{"mass", m},
                         {"stiffness", m * p * p},
                         {"stiffness_y", m * p * p * between(0.5, 1.0)},
                         {"damping", m * p * between(0.0, 0.5)},
                         {"damping_y", m * p * between(0.0, 0.5)},
                         {"internal_damping", GetParam().driven ? 0.0 : m * between(0.0, 0.1)},
                         {"eccentricity", between(0.0, 1e-3)},
                         {"eccentricity_angle", between(-3.0, 3.0)}};
      spec.q = {between(-0.01, 0.01), between(-0.01, 0.01)};
      spec.v = {p * between(-0.01, 0.01), p * between(-0.01, 0.01)};
      return std::max(p, 20.0);
    }
    if (spec.model == "spinning_pendulum") {
      const double m = between(0.5, 2.0);
      const double l = between(0.2, 2.0);
      spec.parameters = {{"mass", m}, {"length", l}, {"damping", m * l * l * between(0.0, 1.0)}};
      spec.q = {between(-3.0, 3.0)};
      spec.v = {between(-3.0, 3.0)};
      return 20.0 + std::sqrt(10.0 / l);
    }
    spec.parameters = {{"mass1", between(0.5, 2.0)},    {"mass2", between(0.5, 2.0)},
                       {"length1", between(0.5, 2.0)},  {"length2", between(0.5, 2.0)},
                       {"damping1", between(0.0, 0.2)}, {"damping2", between(0.0, 0.2)}};
    spec.q = {between(-2.0, 2.0), between(-2.0, 2.0)};
    spec.v = {between(-2.0, 2.0), between(-2.0, 2.0)};
    return 25.0;  // the lower arm whips round, faster than it swings
  }

  std::mt19937_64 random_{20};
};

TEST_P(EnergyResidual, IsBelowTheBound) {
  for (int draw = 0; draw < kDraws; ++draw) {
    Scene scene = sceneOf(kThreeSystems);
    // Corners of the drive fall inside steps.
    scene.drives[0].speed = between(-20.0, 20.0);
    scene.drives[0].profile = {{between(-20.0, 20.0), between(2.0, 5.0), between(3.0, 9.0), 0.5},
                               {between(-20.0, 20.0), between(2.0, 5.0), 0.0, 0.0}};
    SystemSpec spec;
    const double frequency = randomSystem(spec);
    scene.step = std::llround(GetParam().frequency_times_step / frequency * 1e9);
    scene.systems = {spec};
    Twin twin(scene);
    Observer observer(twin);
    std::vector<double> record(twin.layout().size);
    const auto steps = 10'000'000'000 / scene.step;
    double largest = 0.0;
    for (std::int64_t i = 0; i < steps; ++i) {
      twin.step();
      if (i % 16 == 0 || i == steps - 1) {
        twin.write(record.data());
        observer.observe(record.data());
        largest = std::max(largest, std::abs(observer.energyResidual(0)));
      }
    }
    ASSERT_EQ(twin.status(0), StepStatus::kOk);
    ASSERT_LT(largest, 1e-10) << "draw " << draw;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Systems, EnergyResidual,
    testing::Values(
        // Order 6: (0.05)^6 / 1e4 or so.
        Audit{"SpinningPendulum", "spinning_pendulum", "gauss_legendre_6", 0.05, false},
        Audit{"DoublePendulum", "double_pendulum", "gauss_legendre_6", 0.05, false},
        Audit{"RotorByGaussLegendre", "jeffcott_rotor", "gauss_legendre_6", 0.05, false},
        // Exact: at any step.
        Audit{"Rotor", "jeffcott_rotor", "exponential", 0.05, false},
        Audit{"RotorInLargeSteps", "jeffcott_rotor", "exponential", 5.0, false},
        // Up to 70 rad/s.
        Audit{"RotorOnADrive", "jeffcott_rotor", "exponential", 0.02, true},
        Audit{"SpinningPendulumOnADrive", "spinning_pendulum", "gauss_legendre_6", 0.02, true}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace whirl_twin
