// Makes a ModelInfo of a model struct: every method that suits it, composed at compile time.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "integration/dormand_prince_8.h"
#include "integration/exponential.h"
#include "integration/gauss_legendre.h"
#include "integration/jacobi_integral.h"
#include "integration/runge_kutta_4.h"
#include "integration/semi_implicit_euler.h"
#include "integration/stepped_system.h"
#include "integration/stoermer.h"
#include "integration/velocity_verlet.h"
#include "models/exact_stepper.h"
#include "models/model_info.h"

namespace whirl_twin {

template <class... Methods>
struct MethodList {};

template <class List, class Method>
struct Extended;
template <class... Methods, class Method>
struct Extended<MethodList<Methods...>, Method> {
  using Type = MethodList<Methods..., Method>;
};

template <std::size_t n>
using AnyModelsMethods =
    MethodList<SemiImplicitEuler, VelocityVerlet, RungeKutta4, DormandPrince8, Stoermer<n>,
               ImplicitMidpoint<n>, GaussLegendre4<n>, GaussLegendre6<n>>;

/// The integrators that a class of steps is, by their names in scene files: one, or one for each of
/// its schemes, compiled once.
template <class Method, class = void>
struct Integrators {
  static void addNames(std::vector<std::string>& names) { names.push_back(Method::kName); }
  static std::optional<Method> find(const std::string& name) {
    return name == Method::kName ? std::optional<Method>(Method()) : std::nullopt;
  }
};
template <class Method>
struct Integrators<Method, std::void_t<decltype(Method::kSchemes)>> {
  static void addNames(std::vector<std::string>& names) {
    for (const auto& scheme : Method::kSchemes) {
      names.push_back(scheme.name);
    }
  }
  static std::optional<Method> find(const std::string& name) {
    for (const auto& scheme : Method::kSchemes) {
      if (name == scheme.name) {
        return Method(scheme);
      }
    }
    return std::nullopt;
  }
};

template <class Model>
using MethodsFor = std::conditional_t<
    Model::kLinear,
    typename Extended<AnyModelsMethods<Model::kDof>, Exponential<Model::kDof>>::Type,
    AnyModelsMethods<Model::kDof>>;

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

/// One that steps ahead of the twin (stepped_ahead.h), `count` of its steps at once; under inputs,
/// and where a spin is a coordinate, as the twin does.
template <class Model, class Method>
std::unique_ptr<Stepper> makeAhead(const Model& model, const Method& method, const Drive& drive,
                                   const InputForce& inputs, double step, int count) {
  using System = SteppedSystem<Model, Method>;
  auto near = std::make_unique<System>(model, drive, inputs, step, 1, method.byItself());
  if (inputs.acts() || HasSpin<Model>::value || count == 1) {
    return near;
  }
  count = std::min(count, SteppedAhead::kMostSteps);
  const double length = count * step;
  return std::make_unique<SteppedAhead>(
      std::make_unique<System>(model, drive, inputs, length, 1, method), std::move(near),
      method.scheme(), Model::kHasShaft ? &drive : nullptr, length, count);
}

/// With that method if it is of the name asked for.
template <class Model, class Method>
void makeStepperOf(const Model& model, const std::string& integrator, const Drive& drive,
                   const InputForce& inputs, double step, int substeps,
                   std::unique_ptr<Stepper>& system) {
  const std::optional<Method> method = Integrators<Method>::find(integrator);
  if (!method) {
    return;
  }
  if constexpr (HasHistory<Method>::value) {
    if (method->scheme().ahead) {
      system = makeAhead(model, *method, drive, inputs, step, substeps);
      return;
    }
  }
  system =
      std::make_unique<SteppedSystem<Model, Method>>(model, drive, inputs, step, substeps, *method);
}

template <class Model, class... Methods>
std::unique_ptr<Stepper> makeStepper(MethodList<Methods...>, const Model& model,
                                     const std::string& integrator, const Drive& drive,
                                     const InputForce& inputs, double step, int substeps) {
  std::unique_ptr<Stepper> system;
  (makeStepperOf<Model, Methods>(model, integrator, drive, inputs, step, substeps, system), ...);
  if (!system) {
    throw std::logic_error(std::string(Model::kName) + " has no integrator " + integrator);
  }
  return system;
}

template <class... Methods>
std::vector<std::string> methodNames(MethodList<Methods...>) {
  std::vector<std::string> names;
  (Integrators<Methods>::addNames(names), ...);
  return names;
}

/// Do the matrices of a model tell all of it, so that with inputs its exact step can go by them?
template <class Model>
constexpr bool kGivenByMatrices = Model::kLinear && !HasAlternatingLoads<Model>::value;

template <class Model>
ModelSetup setUp(const Model& model) {
  const auto dynamics = std::make_shared<const LagrangianDynamics<Model>>(model);
  return {dynamics, methodNames(MethodsFor<Model>{}),
          [model, dynamics](const std::string& integrator, const Excitation& excitation,
                            double step, int substeps) {
            if constexpr (kGivenByMatrices<Model>) {
              if (excitation.inputs != nullptr && integrator == Exponential<Model::kDof>::kName) {
                return exactStepper(dynamics, jacobiIntegral(model), excitation, step, substeps);
              }
            }
            return makeStepper(MethodsFor<Model>{}, model, integrator, excitation.drive,
                               InputForce(excitation.inputs, dynamics->inputs()), step, substeps);
          }};
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
    v.coordinates.push_back({c.name, c.unit});
  }
  v.linear = Model::kLinear;
  v.rotor = RotorTraits<Model>::kRotor;
  v.integrators = methodNames(MethodsFor<Model>{});
  v.inputs = ModelInputs<Model>::of(Model{});
  return v;
}

/// A model of one form.
template <class Model>
ModelInfo modelInfo() {
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
  info.setUp = [](const ParameterValues& values, const Settings&, const Surroundings& around) {
    return setUp<Model>(values, around.gravity);
  };
  return info;
}

/// A further form of a model with the same parameters, taken where `chosen` says so; `when` is said
/// to users.
template <class Model>
void addVariant(ModelInfo& info, const std::string& when,
                std::function<bool(const ParameterValues&, const Settings&)> chosen) {
  info.variants.push_back(variant<Model>(when));
  info.setUp = [plain = info.setUp, chosen = std::move(chosen)](const ParameterValues& values,
                                                                const Settings& settings,
                                                                const Surroundings& around) {
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
