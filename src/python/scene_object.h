// A scene as Python has it: what was read, and the tree that it was read from.
#pragma once

#include <pybind11/pybind11.h>
#include <yaml-cpp/yaml.h>

#include <memory>

#include "scene/scene.h"

namespace whirl_twin {

struct SceneObject {
  Scene scene;
  YAML::Node tree;
};

using SharedScene = std::shared_ptr<const SceneObject>;

void bindScene(pybind11::module_& module);
void bindSimulation(pybind11::module_& module);
void bindTwin(pybind11::module_& module);
void bindReports(pybind11::module_& module);
void bindStudies(pybind11::module_& module);
void bindLogs(pybind11::module_& module);

}  // namespace whirl_twin
