// Batched isotropic rotors against the same rotors one by one, and against closed forms.
#include "integration/isotropic_rotors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "allocation_guard.h"
#include "integration/stepper.h"
#include "models/model_registry.h"

namespace whirl_twin {
namespace isotropic_rotors_test {

using Complex = std::complex<double>;
constexpr std::int64_t kMillisecond = 1'000'000;

// A run-up with breakpoints inside steps: at 0.0333 s and so on, and with an acceleration that
// jumps.
Drive runUp() {
  return Drive(0.0, 0.3,
               {SpeedMove{90.0, 300.0, 9000.3, 0.0505}, SpeedMove{40.0, 200.0, 0.0, 0.2}});
}

std::vector<IsotropicRotor> someRotors(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<IsotropicRotor> rotors;
  for (std::size_t i = 0; i < count; ++i) {
    IsotropicRotor r;
    r.stiffness = 1.0e3 + 1.0e4 * share(random);
    r.damping = i % 5 == 0 ? 0.0 : 300.0 * share(random);  // undamped, damped, overdamped
    r.eccentricity = std::polar(1.0e-4 * share(random), 6.0 * share(random));
    r.bow_force = i % 3 == 0 ? Complex() : r.stiffness * std::polar(1.0e-5, 6.0 * share(random));
    r.load = i % 2 == 0 ? Complex() : Complex(0.0, -9.8);
    r.start = {1.0e-4 * share(random), -1.0e-4 * share(random)};
    r.start_rate = {1.0e-2 * share(random), 1.0e-2 * share(random)};
    rotors.push_back(r);
  }
  return rotors;
}

/// The same rotor as a separate system, of mass 1, without substeps.
std::unique_ptr<Stepper> single(const IsotropicRotor& r, const Drive& drive, double step) {
  const ModelInfo& model = *findModel("jeffcott_rotor");
  ParameterValues values;
  for (const ParameterInfo& p : model.parameters) {
    values[p.name] = 0.0;
  }
  values["mass"] = 1.0;
  values["stiffness"] = values["stiffness_y"] = r.stiffness;
  values["damping"] = values["damping_y"] = r.damping;
  values["eccentricity"] = std::abs(r.eccentricity);
  values["eccentricity_angle"] = std::arg(r.eccentricity);
  values["bow"] = std::abs(r.bow_force) / r.stiffness;
  values["bow_angle"] = std::arg(r.bow_force);
  Settings settings;
  settings.choices["gravity_on_shaft"] = "true";
  auto system = model.setUp(values, settings, ModelContext(-r.load.imag()))
                    .system("exponential", drive, step, 1);
  const double q[] = {r.start.real(), r.start.imag()};
  const double v[] = {r.start_rate.real(), r.start_rate.imag()};
  system->set(q, v);
  return system;
}

/// Steps rotors of 1 ms on a drive batched and one by one; the largest difference of a position,
/// relative to the largest so far of that rotor. The peaks are equal.
double worstDifference(const std::vector<IsotropicRotor>& rotors, Drive& drive,
                       IsotropicRotors& together, int steps) {
  std::vector<std::unique_ptr<Stepper>> apart;
  for (const IsotropicRotor& rotor : rotors) {
    apart.push_back(single(rotor, drive, 1.0e-3));
  }
  std::vector<double> largest(rotors.size(), 0.0);
  double worst = 0.0;
  for (int i = 0; i < steps; ++i) {
    drive.begin(i * kMillisecond);
    together.step(drive);
    for (std::size_t k = 0; k < rotors.size(); ++k) {
      EXPECT_EQ(apart[k]->step(1.0e-3 * i), StepStatus::kOk);
      double state[5];
      apart[k]->write(state);
      const Complex z(state[0], state[1]);
      largest[k] = std::max({largest[k], std::abs(z), std::abs(rotors[k].start)});
      worst = std::max(worst, std::abs(together.position(k) - z) / largest[k]);
    }
  }
  for (std::size_t k = 0; k < rotors.size(); ++k) {
    EXPECT_NEAR(together.peak(k), largest[k], 1.0e-10 * largest[k]) << k;
  }
  return worst;
}

// 1e-11 of the motion: the single step has an error of about 1e-13 of the force at 1 ms, and here
// sums are not compensated. A step across a breakpoint would show as 1e-6.
TEST(IsotropicRotors, AreWhatTheyAreOneByOne) {
  const std::vector<IsotropicRotor> rotors = someRotors(21);  // not whole blocks
  Drive drive = runUp();
  IsotropicRotors together(rotors, 1.0e-3, 90.0);
  EXPECT_LT(worstDifference(rotors, drive, together, 1500), 1.0e-11);
}

// At constant speed one by one is exact. One rotor decays in a twentieth of a step, which parts the
// steps of all.
TEST(IsotropicRotors, FollowAMotionMuchFasterThanTheStep) {
  std::vector<IsotropicRotor> rotors = someRotors(9);
  rotors[7].damping = 2.0e4;
  Drive drive(120.0, 0.3);
  IsotropicRotors together(rotors, 1.0e-3, 120.0);
  EXPECT_GT(together.parts(), 5);
  EXPECT_LT(worstDifference(rotors, drive, together, 1000), 1.0e-10);
}

// From the start of the closed form at constant speed: steady whirl E w^2 / (p^2 - w^2 + 2 i n w),
// which no step may leave; also with a step of 50 ms, which turns the shaft by four radians.
TEST(IsotropicRotors, StayOnTheirSteadyWhirl) {
  const double speed = 80.0;
  for (const double step : {1.0e-3, 50.0e-3}) {
    IsotropicRotor rotor;
    rotor.stiffness = 1.0e4;
    rotor.damping = 10.0;
    rotor.eccentricity = {1.0e-4, 0.0};
    const Complex steady = rotor.eccentricity * speed * speed /
                           Complex(rotor.stiffness - speed * speed, rotor.damping * speed);
    rotor.start = steady;
    rotor.start_rate = Complex(0.0, speed) * steady;
    IsotropicRotors one({rotor}, step, speed);
    Drive drive(speed, 0.0);
    const auto period = static_cast<std::int64_t>(std::llround(step * 1.0e9));
    double worst = 0.0;
    const int steps = static_cast<int>(20.0 / step);
    for (int i = 0; i < steps; ++i) {
      drive.begin(i * period);
      one.step(drive);
      const double angle = speed * static_cast<double>((i + 1) * period) * 1.0e-9;
      worst = std::max(worst, std::abs(one.position(0) - steady * std::polar(1.0, angle)));
    }
    // A residue of 2e-12 of the force at twice a radian; amplified by resonance by 5.
    EXPECT_LT(worst / std::abs(steady), 1.0e-10) << step;
  }
}

TEST(IsotropicRotors, GoBackToTheirStart) {
  const std::vector<IsotropicRotor> rotors = someRotors(9);
  Drive drive = runUp();
  IsotropicRotors many(rotors, 1.0e-3, 90.0);
  std::vector<Complex> first;
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 100; ++i) {
      drive.begin(i * kMillisecond);
      many.step(drive);
    }
    for (std::size_t k = 0; k < rotors.size(); ++k) {
      if (round == 0) {
        first.push_back(many.position(k));
      } else {
        EXPECT_EQ(many.position(k), first[k]);
      }
    }
    many.reset();
  }
  EXPECT_LT(std::abs(many.position(3) - rotors[3].start), 1.0e-18);
  EXPECT_DOUBLE_EQ(many.peak(3), std::abs(rotors[3].start));
}

// More steps than are deferred at once, of one sub-step and of several; sampling in between forces
// the deferred steps.
TEST(IsotropicRotors, StepsTakenLaterAreTheSameToTheBit) {
  const std::vector<IsotropicRotor> rotors = someRotors(21);
  for (const double highest_speed : {90.0, 9000.0}) {
    Drive drive = runUp();
    IsotropicRotors at_once(rotors, 1.0e-3, highest_speed);
    IsotropicRotors later(rotors, 1.0e-3, highest_speed);
    for (int i = 0; i < 500; ++i) {
      drive.begin(i * kMillisecond);
      at_once.step(drive);
      later.stepLater(drive);
    }
    later.catchUp();
    later.catchUp();  // nothing remains
    for (std::size_t k = 0; k < rotors.size(); ++k) {
      EXPECT_EQ(later.position(k), at_once.position(k));
      EXPECT_EQ(later.rate(k), at_once.rate(k));
      EXPECT_EQ(later.peak(k), at_once.peak(k));
    }
  }
}

TEST(IsotropicRotors, StepWithoutAllocating) {
  Drive drive = runUp();
  IsotropicRotors many(someRotors(100), 1.0e-3, 90.0);
  const AllocationGuard guard;
  for (int i = 0; i < 400; ++i) {
    drive.begin(i * kMillisecond);
    i % 2 == 0 ? many.step(drive) : many.stepLater(drive);
  }
  many.reset();
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace isotropic_rotors_test
}  // namespace whirl_twin
