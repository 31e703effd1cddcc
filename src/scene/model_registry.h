// The models a scene can name.
#pragma once

#include <string>
#include <vector>

#include "scene/model_info.h"

namespace whirl_twin {

/// All models, sorted by name.
const std::vector<ModelInfo>& models();

/// The model of that name, or nullptr.
const ModelInfo* findModel(const std::string& name);

/// Every integrator name a scene may use, `auto` first.
const std::vector<std::string>& integratorNames();

/// The method `auto` stands for, and why.
struct IntegratorChoice {
  std::string integrator;
  std::string reason;
};
/// speed_changes: the model is on a drive that has a profile or may be given a new speed.
IntegratorChoice chooseIntegrator(const ModelInfo& model, const Dynamics& dynamics,
                                  bool speed_changes);

/// Why a model cannot step with an integrator named in a scene; "" if it can.
/// on_drive: as speed_changes above.
std::string integratorObjection(const ModelInfo& model, const Dynamics& dynamics, bool on_drive,
                                const std::string& integrator);

}  // namespace whirl_twin
