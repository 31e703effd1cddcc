// Overhead of effects that a scene does not use: a bare rotor against the shortest loop that can be
// written for it, and the cost of each effect once a scene enables it.
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "control/drive.h"
#include "integration/isotropic_rotors.h"
#include "realtime/denormals.h"
#include "scene/scene_reader.h"
#include "step_costs.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

using Complex = std::complex<double>;

constexpr std::int64_t kStep = 1000000;  // ns
constexpr double kStepSeconds = 1.0e-3;
constexpr double kMass = 2.0;             // kg
constexpr double kStiffness = 20000.0;    // N/m: 100 rad/s
constexpr double kDamping = 8.0;          // N s/m
constexpr double kEccentricity = 2.0e-4;  // m
constexpr double kSpeed = 100.0;          // rad/s
constexpr std::size_t kRotors = 1000;
constexpr int kSettled = 5000;  // steps

/// The product alone: the operator of std::complex also handles infinities.
Complex product(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// A minimal hand-written rotor: at constant speed z = x + i y and its rate are advanced by their
/// exact propagator, and the unbalance by a phasor rotated in every step.
class HandWrittenRotor {
 public:
  HandWrittenRotor() {
    const double n = 0.5 * kDamping / kMass;
    const double p_squared = kStiffness / kMass;
    const double damped = std::sqrt(p_squared - n * n);
    const double decay = std::exp(-n * kStepSeconds);
    const double c = decay * std::cos(damped * kStepSeconds);
    const double s = decay * std::sin(damped * kStepSeconds) / damped;
    zz_ = c + n * s;
    zw_ = s;
    wz_ = -p_squared * s;
    ww_ = c - n * s;
    turn_ = std::polar(1.0, kSpeed * kStepSeconds);
    const Complex whirl =
        kEccentricity * kSpeed * kSpeed / Complex(p_squared - kSpeed * kSpeed, 2.0 * n * kSpeed);
    const Complex rate = Complex(0.0, kSpeed) * whirl;
    to_z_ = turn_ * whirl - zz_ * whirl - zw_ * rate;
    to_w_ = turn_ * rate - wz_ * whirl - ww_ * rate;
    prepareAudit(n, p_squared, damped, whirl, rate);
  }

  /// audited: with the work done on it summed up.
  template <bool audited>
  void advance(int steps) {
    Complex z = z_;
    Complex w = w_;
    Complex phasor = phasor_;
    double work = work_;
    for (int i = 0; i < steps; ++i) {
      if constexpr (audited) {
        const Complex by_z = audit_zz_ * z + (audit_zw_ * w + product(audit_z_, phasor));
        const Complex by_w = audit_ww_ * w + product(audit_w_, phasor);
        work += ((z.real() * by_z.real() + z.imag() * by_z.imag()) +
                 (w.real() * by_w.real() + w.imag() * by_w.imag())) +
                audit_;
      }
      const Complex next = zz_ * z + (zw_ * w + product(to_z_, phasor));
      w = wz_ * z + (ww_ * w + product(to_w_, phasor));
      z = next;
      phasor = product(turn_, phasor);
    }
    z_ = z;
    w_ = w;
    phasor_ = phasor;
    work_ = work;
  }
  Complex position() const { return z_; }
  double work() const { return work_; }

 private:
  /// Work over a step, m Re[w* g] - c |w|^2 with g = e W^2 e^(i W t), by Simpson's rule: its
  /// coefficients of the state and the phasor.
  void prepareAudit(double n, double p_squared, double damped, const Complex& whirl,
                    const Complex& rate) {
    constexpr int kParts = 400;
    for (int k = 0; k <= kParts; ++k) {
      const double t = kStepSeconds * k / kParts;
      const double weight = (k == 0 || k == kParts ? 1.0
                             : k % 2 == 1          ? 4.0
                                                   : 2.0) *
                            kStepSeconds / (3.0 * kParts);
      const double s = std::exp(-n * t) * std::sin(damped * t) / damped;
      const double by_z = -p_squared * s;
      const double by_w = std::exp(-n * t) * std::cos(damped * t) - n * s;
      const Complex turned = std::polar(1.0, kSpeed * t);
      const Complex by_phasor = turned * rate - by_z * whirl - by_w * rate;
      const Complex force = kMass * kEccentricity * kSpeed * kSpeed * turned;
      audit_zz_ -= weight * kDamping * by_z * by_z;
      audit_zw_ -= weight * kDamping * 2.0 * by_z * by_w;
      audit_ww_ -= weight * kDamping * by_w * by_w;
      audit_z_ += weight * by_z * (force - 2.0 * kDamping * by_phasor);
      audit_w_ += weight * by_w * (force - 2.0 * kDamping * by_phasor);
      audit_ += weight * (std::conj(by_phasor) * (force - kDamping * by_phasor)).real();
    }
  }

  double zz_, zw_, wz_, ww_;
  Complex to_z_, to_w_, turn_;
  Complex z_, w_, phasor_ = 1.0;
  double audit_zz_ = 0.0, audit_zw_ = 0.0, audit_ww_ = 0.0, audit_ = 0.0;
  Complex audit_z_, audit_w_;
  double work_ = 0.0;
};

/// A rotor of a scene: its effects, drive and integrator.
struct Rotor {
  std::string name;
  std::string integrator = "exponential";
  std::string parameters = "";
  std::string drive = fmt::format("speed: {}", kSpeed);
};

const char* const kRunUp =
    "speed: 0.0, profile: [{speed: 300.0, max_acceleration: 20.0, dwell: 0.0}]";
const char* const kMotor = "motor: {stall_torque: 0.45, no_load_speed: 400.0}";

std::shared_ptr<Twin> twinOf(const Rotor& rotor) {
  const std::string text = fmt::format(
      "step: 0.001\ndrives: {{shaft: {{{}}}}}\nsystems:\n  rotor:\n    model: jeffcott_rotor\n"
      "    drive: shaft\n    integrator: {}\n    parameters: {{mass: {}, stiffness: {}, "
      "damping: {}, eccentricity: {}{}}}\n",
      rotor.drive, rotor.integrator, kMass, kStiffness, kDamping, kEccentricity,
      rotor.parameters.empty() ? "" : ", " + rotor.parameters);
  return std::make_shared<Twin>(readScene(YAML::Load(text), rotor.name));
}

/// From where it has settled.
Stepped stepped(const Rotor& rotor) {
  const std::shared_ptr<Twin> twin = twinOf(rotor);
  advance(*twin, kSettled);
  return {rotor.name, [twin](int steps) { advance(*twin, steps); }};
}

/// The difference of the results of the two loops, which must agree.
double disagreement() {
  constexpr int kSteps = 1000;
  HandWrittenRotor by_hand;
  by_hand.advance<true>(kSteps);
  const std::shared_ptr<Twin> twin = twinOf({"bare"});
  advance(*twin, kSteps);
  std::vector<double> record(twin->layout().size);
  twin->write(record.data());
  const double* q = twin->layout().system(record.data(), 0).q();
  const double error =
      std::abs(Complex(q[0], q[1]) - by_hand.position()) / std::abs(by_hand.position());
  const double work = twin->layout().system(record.data(), 0).work();
  const double work_error = std::fabs(by_hand.work() - work) / std::fabs(work);
  if (!(error < 1.0e-9 && work_error < 1.0e-9)) {
    throw std::runtime_error(fmt::format(
        "the hand-written rotor is not the twin's: they differ by {:.2g}, their work by "
        "{:.2g}",
        error, work_error));
  }
  return error;
}

Stepped sideBySide() {
  std::vector<IsotropicRotor> rotors(kRotors);
  for (std::size_t i = 0; i < kRotors; ++i) {
    rotors[i].damping = kDamping / kMass;
    rotors[i].stiffness = kStiffness / kMass * (1.0 + 1.0e-4 * static_cast<double>(i));
    rotors[i].eccentricity = kEccentricity;
  }
  const auto all = std::make_shared<IsotropicRotors>(rotors, kStepSeconds, kSpeed);
  return {"", [all, drive = Drive(kSpeed, 0.0), step = std::int64_t{0}](int steps) mutable {
            for (int i = 0; i < steps; ++i) {
              all->step(drive);
              drive.begin(++step * kStep);
            }
          }};
}

Stepped driveAlone() {
  return {"", [drive = Drive(kSpeed, 0.0), step = std::int64_t{0}](int steps) mutable {
            for (int i = 0; i < steps; ++i) {
              drive.begin(++step * kStep);
            }
          }};
}

std::string middleHalf(const StepCost& cost) {
  return fmt::format("{:.1f} to {:.1f}", cost.lower_quartile, cost.upper_quartile);
}

void writeBare(const Effort& effort) {
  const auto by_hand = std::make_shared<HandWrittenRotor>();
  const auto audited = std::make_shared<HandWrittenRotor>();
  const std::vector<StepCost> costs =
      stepCosts({{"", [by_hand](int steps) { by_hand->advance<false>(steps); }},
                 {"", [audited](int steps) { audited->advance<true>(steps); }},
                 stepped({"bare"}),
                 driveAlone(),
                 sideBySide()},
                effort);
  const auto row = [&](const std::string& what, StepCost cost, double rotors) {
    cost.median /= rotors;
    cost.lower_quartile /= rotors;
    cost.upper_quartile /= rotors;
    std::cout << fmt::format("| {} | {:.1f} | {} | {:.2f} |\n", what, cost.median, middleHalf(cost),
                             cost.median / costs[0].median);
  };
  std::cout << fmt::format(
      "An isotropic rotor of one disc at constant speed, steps of 1 ms. The hand-written loop "
      "contains "
      "only the exact\npropagator of z = x + i y, the second one also the work done on the rotor; "
      "their "
      "whirl\nafter 1 s agrees with the twin's to {:.0e}. The twin's step also has compensated "
      "sums, a "
      "shaft angle that is as\naccurate after a year as after a second, and a test for finite "
      "values. An "
      "ensemble has no energy audit\nand integrates its rotors side by side in SIMD vectors.\n\n",
      disagreement());
  std::cout << "| one rotor, one step | ns | interquartile range | relative to hand-written |\n"
               "|---|---|---|---|\n";
  row("written by hand", costs[0], 1.0);
  row("written by hand, with audit", costs[1], 1.0);
  row("the twin", costs[2], 1.0);
  row("of which its drive", costs[3], 1.0);
  row(fmt::format("an ensemble of {}, each", kRotors), costs[4], static_cast<double>(kRotors));
}

/// The bare rotor, and the effects added to it.
struct Family {
  Rotor bare;
  std::vector<Rotor> effects;
};

std::vector<Family> families() {
  const std::string rk4 = "runge_kutta_4";
  const std::string gl6 = "gauss_legendre_6";
  const std::string rub =
      "rub_stiffness: 4.0e5, rub_friction: 0.02, rub_damping: 60.0, rotor_radius: 0.05, "
      "rub_clearance: ";
  const std::string journal =
      "gravity_on_shaft: true, bearing_length: 0.01, bearing_diameter: 0.025, "
      "bearing_clearance: 1.0e-4, bearing_viscosity: 0.1, journal_mass: 0.2";
  const std::string all =
      "internal_damping: 2.0, fluid_damping: 2.0, fluid_ratio: 0.5, cross_coupling: 100.0, "
      "stiffness_y: 22000.0, bow: 1.0e-4, gravity_on_shaft: true";
  const Rotor bare{"nothing"};
  const auto in_run_up = [](Rotor rotor) {
    rotor.name += ", in a run-up";
    rotor.drive = kRunUp;
    return rotor;
  };
  const Rotor internal{"`internal_damping`", "exponential", "internal_damping: 2.0"};
  const Rotor fluid{"`fluid_damping`, `fluid_ratio`", "exponential",
                    "fluid_damping: 2.0, fluid_ratio: 0.5"};
  const Rotor coupled{"`cross_coupling`", "exponential", "cross_coupling: 100.0"};
  const Rotor uneven{"`stiffness_y`", "exponential", "stiffness_y: 22000.0"};
  const Rotor bowed{"`bow`", "exponential", "bow: 1.0e-4"};
  const Rotor sagging{"`gravity_on_shaft`", "exponential", "gravity_on_shaft: true"};
  const Rotor six{"these six together", "exponential", all};
  return {{bare, {internal, fluid, coupled, uneven, bowed, sagging, six}},
          {in_run_up(bare), {in_run_up(bowed), in_run_up(internal), in_run_up(six)}},
          {{"nothing", rk4},
           {{"`loss_factor`", rk4, "loss_factor: 0.01"},
            {"rub, far from the stator", rk4, rub + "1.0"},
            {"rub, on the stator", rk4, rub + "1.0e-3"},
            {"a motor", rk4, "polar_inertia: 0.02", kMotor}}},
          {{"nothing", gl6}, {{"journal bearings", gl6, journal}}}};
}

void writeEffects(const Effort& effort) {
  std::vector<Stepped> all;
  const std::vector<Family> every = families();
  for (const Family& family : every) {
    all.push_back(stepped(family.bare));
    for (const Rotor& rotor : family.effects) {
      all.push_back(stepped(rotor));
    }
  }
  const std::vector<StepCost> costs = stepCosts(all, effort);
  std::cout << "\nThe same rotor, with options of a scene; each row is compared with the row "
               "\"nothing\" above it, which has the\nsame method and speed profile.\n\n"
               "| option | method | ns per step | interquartile range | additional time, ns "
               "|\n|---|---|---|---|---|\n";
  auto cost = costs.begin();
  for (const Family& family : every) {
    const double bare = cost->median;
    std::cout << fmt::format("| {} | {} | {:.1f} | {} | |\n", family.bare.name,
                             family.bare.integrator, bare, middleHalf(*cost++));
    for (const Rotor& rotor : family.effects) {
      std::cout << fmt::format("| {} | {} | {:.1f} | {} | {:+.1f} |\n", rotor.name,
                               rotor.integrator, cost->median, middleHalf(*cost),
                               cost->median - bare);
      ++cost;
    }
  }
}

int run(int argc, char** argv) {
  Effort effort{25, 4.0};
  if (argc == 2 && std::string(argv[1]) == "--quick") {
    effort = {3, 0.2};
  } else if (argc != 1) {
    std::cerr << "usage: required_effects_benchmark [--quick]\n";
    return 2;
  }
  const DenormalsToZero denormals_to_zero;
  writeBare(effort);
  writeEffects(effort);
  return 0;
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  try {
    return whirl_twin::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "required_effects_benchmark: " << error.what() << "\n";
    return 1;
  }
}
