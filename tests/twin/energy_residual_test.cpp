// Energy audit: over ten seconds the increase of the Jacobi integral equals the audited work, to
// 1e-10 of the largest energy in play, for any parameters.
#include <gtest/gtest.h>

#include <cmath>

#include "../scene/scenes.h"
#include "random_systems.h"
#include "twin/observer.h"

namespace whirl_twin {
namespace energy_residual_test {

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
  double between(double low, double high) { return random_.between(low, high); }

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
    return random_.fill(spec, GetParam().driven);
  }

  RandomSystems random_;
};

TEST_P(EnergyResidual, IsBelowTheBound) {
  for (int draw = 0; draw < kDraws; ++draw) {
    Scene scene = sceneOf(kThreeSystems);
    // Breakpoints of the drive fall inside steps.
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
        Audit{"RotatingPendulum", "rotating_pendulum", "gauss_legendre_6", 0.05, false},
        Audit{"CartPendulum", "cart_pendulum", "gauss_legendre_6", 0.05, false},
        Audit{"RodSlider", "rod_slider", "gauss_legendre_6", 0.05, false},
        Audit{"SprungInvertedPendulum", "sprung_inverted_pendulum", "gauss_legendre_6", 0.05,
              false},
        Audit{"RollingDisc", "rolling_disc", "gauss_legendre_6", 0.05, false},
        Audit{"TwoBarLinkage", "two_bar_linkage", "gauss_legendre_6", 0.05, false},
        Audit{"HingedBeam", "hinged_beam", "gauss_legendre_6", 0.05, false},
        Audit{"FrictionOscillator", "friction_oscillator", "gauss_legendre_6", 0.05, false},
        Audit{"SlidingMassFlywheel", "sliding_mass_flywheel", "gauss_legendre_6", 0.05, false},
        Audit{"FreeRotor", "free_rotor", "gauss_legendre_6", 0.05, false},
        Audit{"Governor", "governor", "gauss_legendre_6", 0.05, false},
        Audit{"RotorByGaussLegendre", "jeffcott_rotor", "gauss_legendre_6", 0.05, false},
        Audit{"LinearSystemByGaussLegendre", "linear_system", "gauss_legendre_6", 0.05, false},
        // Exact: at any step.
        Audit{"LinearSystem", "linear_system", "exponential", 0.05, false},
        Audit{"LinearSystemInLargeSteps", "linear_system", "exponential", 5.0, false},
        Audit{"CantileverBeam", "cantilever_beam", "exponential", 5.0, false},
        Audit{"Rotor", "jeffcott_rotor", "exponential", 0.05, false},
        Audit{"RotorInLargeSteps", "jeffcott_rotor", "exponential", 5.0, false},
        // Up to 70 rad/s.
        Audit{"RotorOnADrive", "jeffcott_rotor", "exponential", 0.02, true},
        Audit{"SpinningPendulumOnADrive", "spinning_pendulum", "gauss_legendre_6", 0.02, true}),
    [](const auto& test) { return test.param.name; });

}  // namespace energy_residual_test
}  // namespace whirl_twin
