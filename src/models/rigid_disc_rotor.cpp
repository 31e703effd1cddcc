#include "mechanics/rotors/rigid_disc_rotor.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "mechanics/lagrangian_dynamics.h"
#include "models/levitated_rotor.h"
#include "models/linear_rotor_setup.h"
#include "models/model_entry.h"
#include "models/models.h"
#include "models/spinning_setup.h"

namespace whirl_twin {

namespace {

std::string choice(const Settings& settings, const std::string& name, const std::string& plain) {
  const auto found = settings.choices.find(name);
  return found == settings.choices.end() ? plain : found->second;
}

/// An overhung shaft as the three stiffnesses of a cantilever.
ParameterValues withShaft(ParameterValues values, const Settings& settings) {
  const auto overhung = settings.tables.find("overhung");
  double& k11 = values.at("stiffness_displacement");
  double& k12 = values.at("stiffness_coupling");
  double& k22 = values.at("stiffness_rotation");
  if (overhung != settings.tables.end()) {
    if (overhung->second.size() != 1) {
      throw SetupError("overhung", "must be one map of length and bending_stiffness");
    }
    if (k11 != 0.0 || k12 != 0.0 || k22 != 0.0) {
      throw SetupError("overhung",
                       "must not be given with stiffness_displacement, stiffness_coupling and "
                       "stiffness_rotation");
    }
    const double l = overhung->second.front().numbers.at("length");
    const double ei = overhung->second.front().numbers.at("bending_stiffness");
    k11 = 12.0 * ei / (l * l * l);
    k12 = -6.0 * ei / (l * l);
    k22 = 4.0 * ei / l;
  }
  if (!magnetRows(settings).empty() && k11 == 0.0 && k12 == 0.0 && k22 == 0.0) {
    return values;  // a free rotor, that the magnets hold
  }
  if (!(k11 > 0.0)) {
    throw SetupError("stiffness_displacement",
                     "must be > 0 N/m, unless the shaft is overhung or supported by magnets");
  }
  if (!(k22 > 0.0)) {
    throw SetupError("stiffness_rotation", "must be > 0 N m, unless the shaft is overhung");
  }
  if (!(k12 * k12 < k11 * k22)) {
    throw SetupError("stiffness_coupling",
                     "its square must be less than stiffness_displacement x stiffness_rotation, as "
                     "that of every shaft is");
  }
  return values;
}

/// Numbered from 1 on, along the shaft: place = displacement + position times slope.
std::vector<PlacedMagnet> placed(const Settings& settings) {
  std::vector<PlacedMagnet> magnets;
  for (const TableRow& row : magnetRows(settings)) {
    const std::string key = fmt::format("magnets[{}]", magnets.size());
    const double position = row.numbers.at("position");
    PlacedMagnet at{rotorMagnet(row, key), std::to_string(magnets.size() + 1), {}, {}};
    at.along_x = Eigen::Vector4d(1.0, 0.0, 0.0, position);
    at.along_y = Eigen::Vector4d(0.0, 1.0, -position, 0.0);
    magnets.push_back(at);
  }
  return magnets;
}

SettingInfo choiceOf(const char* name, const char* meaning, std::vector<std::string> words) {
  return {name, SettingKind::kChoice, "", meaning, std::move(words), false, {}, {}};
}

}  // namespace

ModelInfo rigidDiscRotorInfo() {
  ModelInfo info = modelDescription<RigidDiscRotor>();
  info.takes_motor = true;
  info.variants.push_back(variant<TurningRigidDiscRotor>("frame: rotating"));
  info.variants.push_back(spinningVariant<RigidDiscRotor>("a motor"));
  info.settings.push_back(choiceOf("frame", "of the coordinates: fixed, or rotating with the shaft",
                                   {"fixed", "rotating"}));
  info.settings.push_back(choiceOf(
      "gravity_on_shaft", "the scene's gravity acts on the rotor, along -y", {"false", "true"}));
  const double needed = std::nan("");
  info.settings.push_back(
      {"overhung",
       SettingKind::kTable,
       "",
       "a shaft clamped at one end with the disc at the other, replaces the three stiffnesses",
       {},
       false,
       {{"length", "m", Range::kPositive, needed},
        {"bending_stiffness", "N m^2", Range::kPositive, needed}},
       {}});
  info.settings.push_back(magnetsSetting({{"position", "m", Range::kAny, 0.0}},
                                         "current_x_1, current_y_1, current_x_2 ... in order"));
  info.setUp = [](const ParameterValues& values, const Settings& settings,
                  const ModelContext& around) {
    const bool turning = choice(settings, "frame", "fixed") == "rotating";
    const double asymmetry = values.at("stiffness_asymmetry");
    if (asymmetry > 0.0 && !turning) {
      throw SetupError("stiffness_asymmetry",
                       "needs frame: rotating, where the matrices of an asymmetric shaft are "
                       "constant");
    }
    if (!(asymmetry < 1.0)) {
      throw SetupError("stiffness_asymmetry", "must be < 1 for a positive stiffness");
    }
    const bool heavy = choice(settings, "gravity_on_shaft", "false") == "true";
    const ParameterValues complete = withShaft(values, settings);
    const double gravity = heavy ? around.gravity : 0.0;
    if (turning) {
      if (around.motor) {
        throw SetupError("frame", "must be `fixed` for a rotor turned by a motor, found rotating");
      }
      if (!magnetRows(settings).empty()) {
        throw SetupError("magnets", "need frame: fixed");
      }
      return setUp<TurningRigidDiscRotor>(complete, gravity);
    }
    const std::vector<PlacedMagnet> magnets = placed(settings);
    if (!magnets.empty() && around.motor) {
      throw SetupError("magnets", "need a drive with a profile: a rotor on magnets has no motor");
    }
    if (!magnets.empty()) {
      return levitatedRotorSetup(std::make_shared<LagrangianDynamics<RigidDiscRotor>>(
                                     makeModel<RigidDiscRotor>(complete, gravity)),
                                 magnets);
    }
    if (around.motor) {
      ModelContext felt = around;
      felt.gravity = gravity;
      return setUpSpinning<RigidDiscRotor>(complete, felt);
    }
    const RigidDiscRotor rotor = makeModel<RigidDiscRotor>(complete, gravity);
    return withExactRunUps(setUpBesidesExact(rotor), jacobiIntegral(rotor));
  };
  return info;
}

}  // namespace whirl_twin
