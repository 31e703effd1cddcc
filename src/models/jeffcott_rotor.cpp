#include "mechanics/rotors/jeffcott_rotor.h"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "mechanics/lagrangian_dynamics.h"
#include "models/levitated_rotor.h"
#include "models/linear_rotor_setup.h"
#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

namespace {

constexpr double kFilmCost = 30.0;      // by implicit steps
constexpr double kExactFilmCost = 6.0;  // by the exact step of all else
constexpr double kKinkCost = 8.0;

bool given(const ParameterValues& values, const char* name) {
  return values.at(name) > 0.0;
}

void need(const ParameterValues& values, const char* name, const std::string& unit,
          const std::string& with) {
  if (!given(values, name)) {
    throw SetupError(name, "must be > 0 " + unit + " with " + with);
  }
}

bool isNonlinear(const ParameterValues& values) {
  return given(values, "loss_factor") || given(values, "rub_stiffness");
}

/// What fits in each range but not together.
void check(const ParameterValues& values, const ModelContext& around) {
  if (around.motor) {
    need(values, "polar_inertia", "kg m^2", "a motor");
  }
  for (const char* name : {"rub_clearance", "rub_friction", "rub_damping", "rotor_radius"}) {
    if (given(values, name)) {
      need(values, "rub_stiffness", "N/m", name);
    }
  }
  if (given(values, "rub_friction")) {
    need(values, "rotor_radius", "m", "rub_friction");
  }
  for (const char* name :
       {"bearing_diameter", "bearing_clearance", "bearing_viscosity", "journal_mass"}) {
    if (given(values, name)) {
      need(values, "bearing_length", "m", name);
    }
  }
  if (given(values, "bearing_length")) {
    need(values, "bearing_diameter", "m", "bearing_length");
    need(values, "bearing_clearance", "m", "bearing_length");
    need(values, "bearing_viscosity", "Pa s", "bearing_length");
    need(values, "journal_mass", "kg", "bearing_length");
    if (isNonlinear(values)) {
      throw SetupError("bearing_length",
                       "must not be given with journal bearings: loss_factor, rub");
    }
  }
}

/// On a magnet at the disc.
ModelSetup setUpLevitated(const ParameterValues& values, const Settings& settings,
                          const ModelContext& around) {
  const std::vector<TableRow>& rows = magnetRows(settings);
  if (rows.size() != 1) {
    throw SetupError("magnets", fmt::format("must be one map, at the disc, found {}", rows.size()));
  }
  if (around.motor || isNonlinear(values) || given(values, "bearing_length")) {
    throw SetupError("magnets",
                     "must not be given with a motor, a loss_factor, a rub or journal "
                     "bearings");
  }
  const std::shared_ptr<const Dynamics> plain = std::make_shared<LagrangianDynamics<JeffcottRotor>>(
      makeModel<JeffcottRotor>(values, around.gravity));
  const Station disc = plain->stations().front();
  return levitatedRotorSetup(
      plain, {{rotorMagnet(rows[0], "magnets[0]"), "", disc.along_x, disc.along_y}});
}

ModelSetup setUpLinear(const ParameterValues& values, const ModelContext& around) {
  if (around.motor) {
    return setUpSpinningJeffcott(values, around);
  }
  const JeffcottRotor rotor = makeModel<JeffcottRotor>(values, around.gravity);
  return withExactRunUps(setUpBesidesExact(rotor), jacobiIntegral(rotor));
}

}  // namespace

ModelInfo jeffcottRotorInfo() {
  ModelInfo info = modelDescription<JeffcottRotor>();
  info.takes_motor = true;
  info.settings.push_back({"gravity_on_shaft",
                           SettingKind::kChoice,
                           "",
                           "the scene's gravity acts on the rotor, along -y",
                           {"false", "true"},
                           false,
                           {},
                           {}});
  info.settings.push_back(magnetsSetting({}, "current_x, current_y"));
  info.variants.push_back(nonlinearJeffcottVariant("loss_factor > 0"));
  info.variants.push_back(nonlinearJeffcottVariant("rub_stiffness > 0"));
  info.variants.push_back(journalJeffcottVariant("bearing_length > 0"));
  info.variants.push_back(spinningJeffcottVariant("a motor"));
  info.setUp = [](const ParameterValues& values, const Settings& settings,
                  const ModelContext& around) {
    check(values, around);
    const auto gravity_on = settings.choices.find("gravity_on_shaft");
    ModelContext felt = around;
    if (gravity_on == settings.choices.end() || gravity_on->second != "true") {
      felt.gravity = 0.0;
    }
    if (!magnetRows(settings).empty()) {
      return setUpLevitated(values, settings, felt);
    }
    ModelSetup setup = isNonlinear(values)               ? setUpNonlinearJeffcott(values, felt)
                       : given(values, "bearing_length") ? setUpJournalJeffcott(values, felt)
                                                         : setUpLinear(values, felt);
    // At a kink, as of a rub, implicit steps are solved by many evaluations.
    setup.evaluation_cost = given(values, "bearing_length")
                                ? (around.motor ? kFilmCost : kExactFilmCost)
                            : isNonlinear(values) ? kKinkCost
                                                  : 1.0;
    return setup;
  };
  return info;
}

}  // namespace whirl_twin
