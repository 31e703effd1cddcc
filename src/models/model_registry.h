// The models a scene can name.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "models/model_info.h"

namespace whirl_twin {

/// Sets the source of models that are not built in. It is called once, on the first look-up of a
/// name that no built-in model has, or when all models are listed: set it before. A model that is
/// incomplete, or whose name is in use, is skipped and `warn` is called with the reason.
void setModelSource(std::function<std::vector<ModelInfo>()> source,
                    std::function<void(const std::string&)> warn);

/// All models, sorted by name: asks the source.
const std::vector<ModelInfo>& models();

/// The names of models().
std::vector<std::string> modelNames();

/// The model of that name, or nullptr. Valid for ever.
const ModelInfo* findModel(const std::string& name);

/// Every integrator name a scene may use, `auto` first.
const std::vector<std::string>& integratorNames();

/// The method selected by `auto`, and the reason.
struct IntegratorChoice {
  std::string integrator;
  std::string reason;
};
/// speed_changes: the model is on a drive that has a profile or may be given a new speed.
IntegratorChoice chooseIntegrator(const ModelSetup& setup, bool speed_changes);

/// Why a model cannot step with an integrator named in a scene; "" if it can.
/// on_drive: as speed_changes above.
std::string integratorDiagnostic(const ModelSetup& setup, bool on_drive,
                                 const std::string& integrator);

/// The setup has that integrator, and there is no objection to it.
bool canStepWith(const ModelSetup& setup, bool on_drive, const std::string& integrator);

}  // namespace whirl_twin
