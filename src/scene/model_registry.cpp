#include "scene/model_registry.h"

#include <algorithm>

#include "scene/models/models.h"

namespace whirl_twin {

const char* describe(Range range) {
  switch (range) {
    case Range::kPositive:
      return "> 0";
    case Range::kNotNegative:
      return ">= 0";
    case Range::kAny:
      break;
  }
  return "finite";
}

const std::vector<ModelInfo>& models() {
  static const std::vector<ModelInfo> all = [] {
    std::vector<ModelInfo> list{cartPendulumInfo(),     doublePendulumInfo(),
                                jeffcottRotorInfo(),    rodSliderInfo(),
                                rollingDiscInfo(),      rotatingPendulumInfo(),
                                spinningPendulumInfo(), sprungInvertedPendulumInfo(),
                                twoBarLinkageInfo()};
    std::sort(list.begin(), list.end(),
              [](const ModelInfo& a, const ModelInfo& b) { return a.name < b.name; });
    return list;
  }();
  return all;
}

const ModelInfo* findModel(const std::string& name) {
  const auto& all = models();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const ModelInfo& model) { return model.name == name; });
  return found == all.end() ? nullptr : &*found;
}

const std::vector<std::string>& integratorNames() {
  static const std::vector<std::string> names{
      "auto",          "semi_implicit_euler", "velocity_verlet",
      "runge_kutta_4", "gauss_legendre_6",    "exponential"};
  return names;
}

IntegratorChoice chooseIntegrator(const ModelInfo& model, const Dynamics& dynamics,
                                  bool speed_changes) {
  if (model.linear && !speed_changes) {
    return {"exponential", "linear at constant speed: the exact step"};
  }
  if (model.linear && !dynamics.speedDependent()) {
    return {"exponential", "linear with matrices that do not change with speed: exact free motion"};
  }
  if (model.linear) {
    return {"gauss_legendre_6", "its matrices change with the drive's speed"};
  }
  return {"gauss_legendre_6", "nonlinear: order 6, symplectic, stable at any step"};
}

std::string integratorObjection(const ModelInfo& model, const Dynamics& dynamics, bool on_drive,
                                const std::string& integrator) {
  if (integrator != "exponential") {
    return "";
  }
  const auto& suited = model.integrators;
  if (std::find(suited.begin(), suited.end(), integrator) == suited.end()) {
    return "exponential is for linear rotors; " + model.name + " is not linear";
  }
  if (on_drive && dynamics.speedDependent()) {
    return "exponential needs matrices that do not change with speed: rotating damping on a "
           "drive excludes it; gauss_legendre_6 or runge_kutta_4 will do";
  }
  return "";
}

}  // namespace whirl_twin
