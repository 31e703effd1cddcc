// A model as scenes see it: its name, coordinates, parameters and methods, and how to build one.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/motor.h"
#include "integration/step_context.h"
#include "integration/stepper.h"
#include "mechanics/dynamics.h"
#include "mechanics/model_description.h"
#include "messages/input_error.h"
#include "models/settings.h"

namespace whirl_twin {

using ParameterValues = std::map<std::string, double>;

struct ParameterInfo {
  std::string name;
  std::string unit;
  Range range;
  std::string meaning;
  std::optional<double> fallback;  ///< absent, with no fallback_parameter: must be given
  std::string fallback_parameter;  ///< default: the value of this one
};

/// One form of a model: a choice of coordinates, of exactness, of symmetry.
struct ModelVariant {
  std::string when;                         ///< "coordinates: relative"; "" for the plain form
  std::vector<CoordinateInfo> coordinates;  ///< empty: as many as the scene gives
  bool linear = false;
  bool rotor = false;  ///< x, y of a whirling disc: published as WhirlState
  std::vector<std::string> integrators;
  bool motor = false;  ///< of a rotor that a motor turns
  /// One name for all where there is an input for each COORDINATE or NODE; without directions.
  std::vector<InputInfo> inputs = {};
};

/// A model with its parameters, ready to be analysed and stepped.
struct ModelSetup {
  std::shared_ptr<const Dynamics> dynamics;
  std::vector<std::string> integrators;  ///< that it can step with
  /// Steps with one of `integrators`: step [s] in `substeps` parts, under what outlives it.
  std::function<std::unique_ptr<Stepper>(const std::string& integrator, const StepContext&,
                                         double step, int substeps)>
      system;
  std::string note = "";  ///< what the user should know of how it was set up
  /// `exponential` follows a speed that changes although the matrices change with it.
  bool exact_run_ups = false;
  /// Cost of an evaluation of its accelerations relative to a pendulum of as many coordinates:
  /// calibrations budget with it instead of measured time.
  double evaluation_cost = 1.0;
};

/// Parameters that are each in range but do not fit together.
class SetupError : public InputError {
 public:
  SetupError(std::string parameter, const std::string& what)
      : InputError(what), parameter_(std::move(parameter)) {}
  const std::string& parameter() const { return parameter_; }

 private:
  std::string parameter_;
};

/// What a scene surrounds a system with.
struct ModelContext {
  double gravity = 9.80665;  ///< [m/s^2]
  /// Of the drive that turns it: then the shaft's angle is a coordinate, `spin`, of the system.
  std::optional<Motor> motor = std::nullopt;

  ModelContext(double gravity_now) : gravity(gravity_now) {}
};

struct ModelInfo {
  std::string name;
  std::string summary;
  std::vector<ParameterInfo> parameters;
  std::vector<SettingInfo> settings;
  std::vector<ModelVariant> variants;  ///< the plain form first
  /// Which coordinates its parameters give it, where variants list none: names, units, meanings.
  std::string coordinates_meaning = "";
  bool has_shaft = false;    ///< a scene gives it a drive or a constant speed
  bool takes_motor = false;  ///< its drive may be a motor

  /// The model with these parameters (all of `parameters`) and settings. Throws SetupError.
  std::function<ModelSetup(const ParameterValues&, const Settings&, const ModelContext&)> setUp;
};

/// "> 0", ">= 0", "a whole number > 0" or "finite".
const char* describe(Range range);

}  // namespace whirl_twin
