#include "models/model_registry.h"

#include <algorithm>
#include <utility>

#include "integration/lateral_rotor.h"
#include "integration/step_methods.h"
#include "integration/stoermer_weights.h"
#include "models/models.h"

namespace whirl_twin {

namespace {

struct ModelSource {
  std::function<std::vector<ModelInfo>()> models;
  std::function<void(const std::string&)> warn;
};

ModelSource& modelSource() {
  static ModelSource source;
  return source;
}

const ModelInfo* find(const std::vector<ModelInfo>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const ModelInfo& model) { return model.name == name; });
  return found == list.end() ? nullptr : &*found;
}

const std::vector<ModelInfo>& builtInModels() {
  static const std::vector<ModelInfo> built_in{cantileverBeamInfo(),   cartPendulumInfo(),
                                               doublePendulumInfo(),   flexibleRotorInfo(),
                                               freeRotorInfo(),        frictionOscillatorInfo(),
                                               governorInfo(),         hingedBeamInfo(),
                                               jeffcottRotorInfo(),    linearSystemInfo(),
                                               pendulumInfo(),         rigidDiscRotorInfo(),
                                               rodSliderInfo(),        rollingDiscInfo(),
                                               rotatingPendulumInfo(), slidingMassFlywheelInfo(),
                                               spinningPendulumInfo(), sprungInvertedPendulumInfo(),
                                               twoBarLinkageInfo(),    elasticPendulumInfo(),
                                               foucaultPendulumInfo(), kapitzaPendulumInfo(),
                                               massSpringDamperInfo()};
  return built_in;
}

/// Why a model of the source cannot join `list`; "" if it can.
std::string objection(const ModelInfo& model, const std::vector<ModelInfo>& list) {
  if (model.name.empty() || model.variants.empty() || !model.setUp) {
    return "model '" + model.name + "' is not registered: it has no name, variant or setup";
  }
  if (find(list, model.name) != nullptr) {
    return "model '" + model.name + "' is not registered: duplicate name";
  }
  return "";
}

}  // namespace

void setModelSource(std::function<std::vector<ModelInfo>()> source,
                    std::function<void(const std::string&)> warn) {
  modelSource() = {std::move(source), std::move(warn)};
}

const char* describe(Range range) {
  switch (range) {
    case Range::kPositive:
      return "> 0";
    case Range::kNotNegative:
      return ">= 0";
    case Range::kCount:
      return "a whole number from 1 to 1000000";
    case Range::kAny:
      break;
  }
  return "finite";
}

const std::vector<ModelInfo>& models() {
  static const std::vector<ModelInfo> all = [] {
    std::vector<ModelInfo> list = builtInModels();
    const ModelSource& source = modelSource();
    for (ModelInfo& model : source.models ? source.models() : std::vector<ModelInfo>()) {
      const std::string why = objection(model, list);
      if (why.empty()) {
        list.push_back(std::move(model));
      } else {
        source.warn(why);
      }
    }
    std::sort(list.begin(), list.end(),
              [](const ModelInfo& a, const ModelInfo& b) { return a.name < b.name; });
    return list;
  }();
  return all;
}

std::vector<std::string> modelNames() {
  std::vector<std::string> names;
  for (const ModelInfo& model : models()) {
    names.push_back(model.name);
  }
  return names;
}

const ModelInfo* findModel(const std::string& name) {
  const ModelInfo* built_in = find(builtInModels(), name);
  return built_in != nullptr ? built_in : find(models(), name);
}

const std::vector<std::string>& integratorNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"auto"};
    for (const StepMethod& method : stepMethods()) {
      all.push_back(method.name);
    }
    return all;
  }();
  return names;
}

IntegratorChoice chooseIntegrator(const ModelSetup& setup, bool speed_changes) {
  const Dynamics& dynamics = *setup.dynamics;
  if (dynamics.linear() && !dynamics.hasShaft()) {
    return {"exponential", "linear: the exact step"};
  }
  if (dynamics.linear() && !speed_changes) {
    return {"exponential", "linear at constant speed: the exact step"};
  }
  if (dynamics.linear() && setup.exact_run_ups && lateralRotor(dynamics.linearRotor())) {
    return {"exponential", "linear, of two coordinates: the exact step at any speed"};
  }
  if (dynamics.linear() && setup.exact_run_ups) {
    return {"exponential", "linear: the exact step, from a table over the drive's speeds"};
  }
  if (dynamics.linear() && !dynamics.speedDependent()) {
    return {"exponential", "linear with constant matrices: exact free motion"};
  }
  if (dynamics.linear()) {
    return {"gauss_legendre_6", "its matrices depend on the drive's speed"};
  }
  const bool exact_rest = setup.exact_run_ups;
  if (exact_rest && !dynamics.hasShaft()) {
    return {"exponential",
            "its linear part by the exact step, its spin and local forces by order 5"};
  }
  if (exact_rest) {
    return {"exponential", "its linear part by the exact step, local forces by order 5"};
  }
  return {"gauss_legendre_6", "nonlinear: order 6, symplectic, stable at any step"};
}

std::string integratorDiagnostic(const ModelSetup& setup, bool on_drive,
                                 const std::string& integrator) {
  const auto& suited = setup.integrators;
  const bool suits = std::find(suited.begin(), suited.end(), integrator) != suited.end();
  const auto& multistep = kStoermerSchemes;
  if (!suits && std::any_of(multistep.begin(), multistep.end(),
                            [&](const StoermerScheme& s) { return integrator == s.name; })) {
    return integrator + " is for models defined by energies; " + setup.dynamics->model() +
           " is defined by matrices: use exponential, the exact step";
  }
  if (integrator != "exponential") {
    return "";
  }
  if (!suits) {
    return "exponential is for linear systems; " + setup.dynamics->model() + " is not linear";
  }
  if (on_drive && setup.dynamics->speedDependent() && !setup.exact_run_ups) {
    return "exponential needs matrices independent of the drive's speed; use gauss_legendre_6 or "
           "runge_kutta_4";
  }
  return "";
}

bool canStepWith(const ModelSetup& setup, bool on_drive, const std::string& integrator) {
  const std::vector<std::string>& all = setup.integrators;
  return std::find(all.begin(), all.end(), integrator) != all.end() &&
         integratorDiagnostic(setup, on_drive, integrator).empty();
}

}  // namespace whirl_twin
