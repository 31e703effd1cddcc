// A stepper of a model by the name of a method, from a list of methods.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "integration/macro_step.h"
#include "integration/stepped_system.h"
#include "integration/stepper.h"

namespace whirl_twin {

template <class... Methods>
struct MethodList {};

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

template <class... Methods>
std::vector<std::string> methodNames(MethodList<Methods...>) {
  std::vector<std::string> names;
  (Integrators<Methods>::addNames(names), ...);
  return names;
}

/// One that steps ahead of the twin (macro_step.h), `count` of its steps at once; under inputs,
/// with friction that can hold and where a spin is a coordinate, as the twin does.
template <class Model, class Method>
std::unique_ptr<Stepper> makeAhead(const Model& model, const Method& method, const Drive& drive,
                                   const InputForce& inputs, double step, int count) {
  using System = SteppedSystem<Model, Method>;
  using Form = SteppedModel<Model>;
  auto near = std::make_unique<System>(model, drive, inputs, step, 1, method.byItself());
  bool corners = inputs.acts();
  if constexpr (Form::kMayStick) {
    corners = corners || Form::sticks(model);
  }
  if (corners || Form::hasSpin(model) || count == 1) {
    return near;
  }
  count = std::min(count, MacroStep::kMaxSteps);
  const double length = count * step;
  return std::make_unique<MacroStep>(
      std::make_unique<System>(model, drive, inputs, length, 1, method), std::move(near),
      method.scheme(), Form::hasShaft(model) ? &drive : nullptr, length, count);
}

/// Creates a stepper with that method if its name matches.
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

/// nullptr: none of the methods is of that name.
template <class Model, class... Methods>
std::unique_ptr<Stepper> makeStepper(MethodList<Methods...>, [[maybe_unused]] const Model& model,
                                     [[maybe_unused]] const std::string& integrator,
                                     [[maybe_unused]] const Drive& drive,
                                     [[maybe_unused]] const InputForce& inputs,
                                     [[maybe_unused]] double step, [[maybe_unused]] int substeps) {
  std::unique_ptr<Stepper> system;
  (makeStepperOf<Model, Methods>(model, integrator, drive, inputs, step, substeps, system), ...);
  return system;
}

}  // namespace whirl_twin
