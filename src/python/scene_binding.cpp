// Scenes: read from a file, text or tree of Python, and what they hold.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "messages/input_error.h"
#include "python/conversions.h"
#include "python/listening.h"
#include "python/scene_object.h"
#include "requests/shipped_scenes.h"
#include "scene/scene_changes.h"
#include "scene/scene_error.h"
#include "scene/scene_reader.h"
#include "scene/yaml_file.h"

namespace py = pybind11;

namespace whirl_twin {

namespace {

constexpr const char* kContents = "a step and at least one system";

/// `tree` gives what is to be read; all its errors are those of a scene.
SharedScene readShared(const std::string& source, const std::function<YAML::Node()>& tree) {
  auto read = std::make_shared<SceneObject>();
  runListening(py::none(), [&](WorkProgress&) {
    try {
      read->tree = tree();
    } catch (const InputError& error) {
      throw SceneError({error.what()});
    }
    read->scene = readScene(read->tree, source);
  });
  return read;
}

SharedScene sceneOfFile(const std::string& path) {
  return readShared(path, [&] { return readYamlFile(path, "a scene", kContents); });
}

SharedScene sceneOfText(const std::string& text, const std::string& source) {
  return readShared(source, [&] { return readYamlText(text, source, "a scene", kContents); });
}

SharedScene sceneOfTree(const py::handle& value, const std::string& source) {
  const YAML::Node tree = treeOf(value);
  return readShared(source, [&] { return tree; });
}

SharedScene changedScene(const SceneObject& scene,
                         const std::vector<std::pair<std::string, py::object>>& changes) {
  YAML::Node tree = separated(scene.tree);
  for (const auto& [path, value] : changes) {
    changeScene(tree, path, treeOf(value));
  }
  return readShared(scene.scene.source, [&] { return tree; });
}

py::dict systemsOf(const SceneObject& object) {
  py::dict systems;
  for (const SystemSpec& system : object.scene.systems) {
    systems[pythonText(system.name)] = pythonText(system.model);
  }
  return systems;
}

std::string yamlOf(const SceneObject& object) {
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << object.tree;
  return std::string(out.c_str()) + "\n";
}

std::vector<std::string> shippedNames() {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : sceneFiles(shippedSceneFolder())) {
    names.push_back(file.stem().string());
  }
  return names;
}

}  // namespace

void bindScene(py::module_& module) {
  py::class_<SceneObject, std::shared_ptr<SceneObject>>(module, "Scene")
      .def_property_readonly("name", [](const SceneObject& s) { return pythonText(s.scene.name); })
      .def_property_readonly("source",
                             [](const SceneObject& s) { return pythonText(s.scene.source); })
      .def_property_readonly("step", [](const SceneObject& s) { return s.scene.stepSeconds(); })
      .def_property_readonly("systems", systemsOf)
      .def("to_dict", [](const SceneObject& s) { return pythonOf(s.tree); })
      .def("to_yaml", [](const SceneObject& s) { return pythonText(yamlOf(s)); });
  module.def("scene_of_file", sceneOfFile, py::arg("path"));
  module.def("scene_of_text", sceneOfText, py::arg("text"), py::arg("source"));
  module.def("scene_of_tree", sceneOfTree, py::arg("tree"), py::arg("source"));
  module.def("changed_scene", changedScene, py::arg("scene"), py::arg("changes"));
  module.def("scene_path", scenePath, py::arg("scene"));
  module.def("shipped_scenes", shippedNames);
  module.def("quantity", quantityOf, py::arg("name"), py::arg("value"), py::arg("unit"));
}

}  // namespace whirl_twin
