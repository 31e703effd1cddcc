// Makes a ModelInfo of a model struct: every method that suits it, composed at compile time.
#pragma once

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "integration/exponential.h"
#include "integration/gauss_legendre_6.h"
#include "integration/runge_kutta_4.h"
#include "integration/semi_implicit_euler.h"
#include "integration/velocity_verlet.h"
#include "scene/model_info.h"
#include "scene/stepped_system.h"

namespace whirl_twin {

template <class... Methods>
struct MethodList {};

template <class Model>
using MethodsFor = std::conditional_t<
    Model::kLinear,
    MethodList<SemiImplicitEuler, VelocityVerlet, RungeKutta4, GaussLegendre6<Model::kDof>,
               Exponential<Model::kDof>>,
    MethodList<SemiImplicitEuler, VelocityVerlet, RungeKutta4, GaussLegendre6<Model::kDof>>>;

template <class Model, class = void>
struct HasGravity : std::false_type {};
template <class Model>
struct HasGravity<Model, std::void_t<decltype(&Model::gravity)>> : std::true_type {};

template <class Model>
Model makeModel(const ParameterValues& values, double gravity) {
  Model model{};
  for (const Parameter<Model>& p : Model::parameters()) {
    model.*p.member = values.at(p.name);
  }
  if constexpr (HasGravity<Model>::value) {
    model.gravity = gravity;
  }
  return model;
}

template <class Model, class... Methods>
std::unique_ptr<System> makeSystem(MethodList<Methods...>, const Model& model,
                                   const std::string& integrator, const Drive& drive, double step,
                                   int substeps) {
  std::unique_ptr<System> system;
  ((integrator == Methods::kName ? void(system = std::make_unique<SteppedSystem<Model, Methods>>(
                                            model, drive, step, substeps))
                                 : void()),
   ...);
  if (!system) {
    throw std::invalid_argument(std::string(Model::kName) + " has no integrator " + integrator);
  }
  return system;
}

template <class... Methods>
std::vector<std::string> methodNames(MethodList<Methods...>) {
  return {Methods::kName...};
}

template <class Model>
ModelInfo modelInfo() {
  ModelInfo info;
  info.name = Model::kName;
  info.summary = Model::kSummary;
  info.coordinates = {Model::kCoordinates.begin(), Model::kCoordinates.end()};
  for (const Parameter<Model>& p : Model::parameters()) {
    ParameterInfo parameter{p.name, p.unit, p.range, p.meaning, std::nullopt, ""};
    if (p.fallback_parameter != nullptr) {
      parameter.fallback_parameter = p.fallback_parameter;
    } else if (isFinite(p.fallback)) {
      parameter.fallback = p.fallback;
    }
    info.parameters.push_back(parameter);
  }
  info.linear = Model::kLinear;
  info.has_shaft = Model::kHasShaft;
  info.rotor = RotorTraits<Model>::kRotor;
  info.integrators = methodNames(MethodsFor<Model>{});
  info.dynamics = [](const ParameterValues& values, double gravity) {
    return std::make_shared<const LagrangianDynamics<Model>>(makeModel<Model>(values, gravity));
  };
  info.system = [](const ParameterValues& values, double gravity, const std::string& integrator,
                   const Drive& drive, double step, int substeps) {
    return makeSystem(MethodsFor<Model>{}, makeModel<Model>(values, gravity), integrator, drive,
                      step, substeps);
  };
  return info;
}

}  // namespace whirl_twin
