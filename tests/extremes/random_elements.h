// Random rotors with nonlinear elements at stations of their shaft, and on motors.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "dice.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Oil films that carry the shaft, at its ends or at one of them; springs elsewhere.
inline std::string randomBearings(Dice& dice, std::size_t last) {
  std::string springs;
  std::string films;
  for (const std::size_t node : {std::size_t{0}, last}) {
    if (dice.below(3) == 0) {
      const double length = dice.uniform(0.008, 0.015);
      films += fmt::format(
          "{{node: {}, length: {:.17g}, diameter: 0.025, clearance: 1.0e-4, viscosity: {:.17g}}}, ",
          node, length, dice.anySize(0.01, 0.1));
    } else {
      const double kxx = dice.anySize(1.0e5, 1.0e7);
      const double kyy = kxx * dice.uniform(0.7, 1.4);
      springs += fmt::format("{{node: {}, kxx: {:.17g}, kyy: {:.17g}, cxx: {:.17g}}}, ", node, kxx,
                             kyy, dice.anySize(10.0, 1000.0));
    }
  }
  return (springs.empty() ? "" : "bearings: [" + springs + "], ") +
         (films.empty() ? "" : "journal_bearings: [" + films + "], ");
}

/// At least one of them.
inline std::string randomElements(Dice& dice, std::size_t last) {
  std::string all;
  const std::size_t node = 1 + dice.below(last - 1);
  const std::size_t kinds = 1 + dice.below(7);
  if ((kinds & 1) != 0) {
    all += fmt::format("cubic_springs: [{{node: {}, stiffness: {:.17g}}}], ", node,
                       dice.anySize(1.0e9, 1.0e13));
  }
  if ((kinds & 2) != 0) {
    const double clearance = dice.anySize(3.0e-5, 1.0e-3);
    const double stiffness = dice.anySize(1.0e5, 3.0e6);
    const double damping = dice.uniform(0.0, 200.0);
    all += fmt::format(
        "rubs: [{{node: {}, clearance: {:.17g}, stiffness: {:.17g}, damping: {:.17g}, friction: "
        "{:.17g}, radius: 0.05}}], ",
        node, clearance, stiffness, damping, dice.uniform(0.0, 0.2));
  }
  if ((kinds & 4) != 0) {
    const double clearance = dice.uniform(2.0e-4, 5.0e-4);
    all += fmt::format(
        "squeeze_films: [{{node: {}, length: 0.02, diameter: 0.05, clearance: {:.17g}, viscosity: "
        "{:.17g}}}], ",
        node, clearance, dice.anySize(0.003, 0.03));
  }
  return all;
}

inline std::string randomMotor(Dice& dice) {
  const double speed = dice.uniform(0.0, 200.0);
  if (dice.below(2) == 0) {
    return fmt::format("speed: {:.17g}, motor: {{torque: {:.17g}, drag: 1.0e-4}}", speed,
                       dice.anySize(0.01, 1.0));
  }
  const double stall_torque = dice.anySize(0.03, 3.0);
  return fmt::format("speed: {:.17g}, motor: {{stall_torque: {:.17g}, no_load_speed: {:.17g}}}",
                     speed, stall_torque, dice.uniform(200.0, 500.0));
}

inline std::string randomProfile(Dice& dice) {
  const std::string start = fmt::format("speed: {:.17g}", dice.uniform(20.0, 300.0));
  if (dice.below(2) != 0) {
    return start;
  }
  const double speed = dice.uniform(50.0, 400.0);
  return start +
         fmt::format(", profile: [{{speed: {:.17g}, max_acceleration: {:.17g}, dwell: 1.0}}]",
                     speed, dice.anySize(20.0, 500.0));
}

/// A shaft of two to four elements with a disc or two, at a speed, in a run-up or on a motor.
inline Scene shaftWithElements(Dice& dice) {
  const std::size_t elements = 2 + dice.below(3);
  const std::string drive = dice.below(2) == 0 ? randomMotor(dice) : randomProfile(dice);
  std::string discs;
  for (std::size_t k = 0; k < 1 + dice.below(2); ++k) {
    const double mass = dice.anySize(0.5, 5.0);
    discs += fmt::format(
        "{{node: {}, mass: {:.17g}, polar_inertia: {:.17g}, transverse_inertia: {:.17g}}}, ",
        1 + k % (elements - 1), mass, 2.0e-3 * mass, 1.1e-3 * mass);
  }
  const std::string more = dice.below(2) == 0 ? "gravity_on_shaft: true, " : "";
  const std::string damping =
      dice.below(2) == 0 ? fmt::format("internal_damping: {:.17g}, ", dice.anySize(1.0e-7, 1.0e-5))
                         : "";
  const std::string bearings = randomBearings(dice, elements);
  const std::string local = randomElements(dice, elements);
  const std::string modes = dice.below(2) == 0 ? "auto" : fmt::format("{}", 4 + 2 * dice.below(3));
  const double step = 1.0e-9 * static_cast<double>(std::llround(dice.anySize(3.0e4, 1.0e6)));
  const double length = dice.uniform(0.1, 0.25);
  const double diameter = dice.uniform(0.015, 0.03);
  Scene one = sceneOf(fmt::format(
      "{{step: {:.9f}, drives: {{shaft: {{{}}}}}, systems: {{one: {{model: flexible_rotor, drive: "
      "shaft, parameters: {{youngs_modulus: 2.0e+11, shear_modulus: 8.0e+10, density: 7800.0, "
      "{}{}elements: [{{length: {:.17g}, outer_diameter: {:.17g}, count: {}}}], discs: [{}], {}{}"
      "unbalances: [{{node: 1, magnitude: {:.17g}}}], highest_speed: 500.0, modes: {}}}}}}}}}",
      step, drive, more, damping, length, diameter, elements, discs, bearings, local,
      dice.anySize(1.0e-5, 5.0e-4), modes));
  SystemSpec& spec = one.systems.front();
  spec.horizon = dice.anySize(0.03, 0.5);
  return one;
}

}  // namespace whirl_twin
