// Makes a ModelInfo of a model struct: with every method that suits it, those that must be fast
// composed with it at compile time.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "integration/dormand_prince_8.h"
#include "integration/erased_system.h"
#include "integration/exponential.h"
#include "integration/gauss_legendre.h"
#include "integration/jacobi_integral.h"
#include "integration/method_list.h"
#include "integration/runge_kutta_4.h"
#include "integration/stoermer.h"
#include "mechanics/dry_friction.h"
#include "mechanics/lagrangian_dynamics.h"
#include "models/exact_stepper.h"
#include "models/model_info.h"

namespace whirl_twin {

#ifdef WHIRL_TWIN_LONG_EQUATIONS
constexpr bool kLongEquations = true;
#else
constexpr bool kLongEquations = false;
#endif

/// Methods that a model is composed with, for their speed; any other reaches it by calls. Of a
/// linear model that is the exact step: no other fast one is needed.
template <class Model>
using ComposedMethods = std::conditional_t<
    Model::kLinear, MethodList<Exponential<Model::kDof>>,
    std::conditional_t<kLongEquations, MethodList<>,
                       MethodList<RungeKutta4, DormandPrince8, Stoermer<Model::kDof>,
                                  GaussLegendre6<Model::kDof>>>>;

/// All that suit it, by their names.
template <class Model>
std::vector<std::string> integratorsOf() {
  std::vector<std::string> names = methodNames(AnyModelsMethods<Model::kDof>{});
  if (Model::kLinear) {
    names.push_back(Exponential<Model::kDof>::kName);
  }
  return names;
}

template <class Model, class = void>
struct HasGravity : std::false_type {};
template <class Model>
struct HasGravity<Model, std::void_t<decltype(&Model::gravity)>> : std::true_type {};

template <class Model>
Model makeModel(const ParameterValues& values, double gravity) {
  Model model{};
  for (const auto& p : Model::parameters()) {
    model.*p.member = values.at(p.name);
  }
  if constexpr (HasGravity<Model>::value) {
    model.gravity = gravity;
  }
  return model;
}

/// Whether the matrices of a model define it completely, so that its exact step with inputs can use
/// them.
template <class Model>
constexpr bool kGivenByMatrices = Model::kLinear && !HasAlternatingLoads<Model>::value;

/// Composed with `Methods`.
template <class Model, class Methods = ComposedMethods<Model>>
ModelSetup setUp(const Model& model) {
  const auto dynamics = std::make_shared<const LagrangianDynamics<Model>>(model);
  return {
      dynamics, integratorsOf<Model>(),
      [model, dynamics](const std::string& integrator, const StepContext& excitation, double step,
                        int substeps) {
        if constexpr (kGivenByMatrices<Model>) {
          if (excitation.inputs != nullptr && integrator == Exponential<Model::kDof>::kName) {
            return exactStepper(dynamics, jacobiIntegral(model), excitation, step, substeps);
          }
        }
        const InputForce inputs(excitation.inputs, dynamics->inputs());
        std::unique_ptr<Stepper> system;
        if (HasDryContacts<Model>::of(model).count == 0) {  // else in sub-steps, type-erased
          system =
              makeStepper(Methods{}, model, integrator, excitation.drive, inputs, step, substeps);
        }
        if (!system) {
          system = erasedSystem(ErasedModel<Model::kDof>::of(model), integrator, excitation.drive,
                                inputs, step, substeps);
        }
        if (!system) {
          throw std::logic_error(std::string(Model::kName) + " has no integrator " + integrator);
        }
        return system;
      }};
}

/// Without its exact step, which others take: withExactRunUps().
template <class Model>
ModelSetup setUpBesidesExact(const Model& model) {
  return setUp<Model, MethodList<>>(model);
}

template <class Model>
ModelSetup setUp(const ParameterValues& values, double gravity) {
  return setUp(makeModel<Model>(values, gravity));
}

template <class Model>
ModelVariant variant(const std::string& when) {
  ModelVariant v;
  v.when = when;
  for (const Coordinate& c : Model::kCoordinates) {
    v.coordinates.push_back({c.name, c.unit, c.meaning});
  }
  v.linear = Model::kLinear;
  v.rotor = RotorTraits<Model>::kRotor;
  v.integrators = integratorsOf<Model>();
  v.inputs = ModelInputs<Model>::of(Model{});
  return v;
}

/// Description of a model of one form, without its set-up.
template <class Model>
ModelInfo modelDescription() {
  ModelInfo info;
  info.name = Model::kName;
  info.summary = Model::kSummary;
  info.variants = {variant<Model>("")};
  for (const auto& p : Model::parameters()) {
    ParameterInfo parameter{p.name, p.unit, p.range, p.meaning, std::nullopt, ""};
    if (p.fallback_parameter != nullptr) {
      parameter.fallback_parameter = p.fallback_parameter;
    } else if (isFinite(p.fallback)) {
      parameter.fallback = p.fallback;
    }
    info.parameters.push_back(parameter);
  }
  info.has_shaft = Model::kHasShaft;
  return info;
}

/// A model of one form.
template <class Model>
ModelInfo modelInfo() {
  ModelInfo info = modelDescription<Model>();
  info.setUp = [](const ParameterValues& values, const Settings&, const ModelContext& around) {
    return setUp<Model>(values, around.gravity);
  };
  return info;
}

/// A further form of a model with the same parameters, used where `chosen` returns true; `when` is
/// printed in the help.
template <class Model>
void addVariant(ModelInfo& info, const std::string& when,
                std::function<bool(const ParameterValues&, const Settings&)> chosen) {
  info.variants.push_back(variant<Model>(when));
  info.setUp = [plain = info.setUp, chosen = std::move(chosen)](const ParameterValues& values,
                                                                const Settings& settings,
                                                                const ModelContext& around) {
    return chosen(values, settings) ? setUp<Model>(values, around.gravity)
                                    : plain(values, settings, around);
  };
}

/// The same, taken where a choice of the scene has the second of its two values.
template <class Model>
void addVariant(ModelInfo& info, const std::string& setting, const std::string& plain_value,
                const std::string& value, const std::string& meaning) {
  info.settings.push_back(
      {setting, SettingKind::kChoice, "", meaning, {plain_value, value}, false, {}, {}});
  addVariant<Model>(info, setting + ": " + value,
                    [setting, value](const ParameterValues&, const Settings& settings) {
                      const auto found = settings.choices.find(setting);
                      return found != settings.choices.end() && found->second == value;
                    });
}

}  // namespace whirl_twin
