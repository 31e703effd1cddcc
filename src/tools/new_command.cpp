// `twin new`.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "messages/input_error.h"
#include "messages/names.h"
#include "models/model_registry.h"
#include "reports/model_text.h"
#include "reports/output.h"
#include "requests/shipped_scenes.h"
#include "scene/yaml_file.h"
#include "tools/commands.h"

namespace whirl_twin {

namespace {

constexpr const char* kNewDescription =
    "Writes a first scene with one system of a model: every key with its unit and meaning,\nvalues "
    "of a scene of the package, and defaults as comments.";

constexpr const char* kNewFooter =
    "Examples:\n"
    "  twin new double_pendulum > mine.yaml && twin check mine.yaml && twin plot mine.yaml\n"
    "  twin new flexible_rotor > rotor.yaml";

struct Example {
  YAML::Node tree;
  std::string system;
  std::size_t length = 0;  // its count of numbers and tables
};

/// The system of this model with the fewest parameters in the package's scenes.
Example plainest(const std::string& model) {
  Example found;
  for (const std::filesystem::path& file : sceneFiles(shippedSceneFolder())) {
    const YAML::Node tree = readYamlFile(file, "a scene", "systems");
    for (const auto& system : tree["systems"]) {
      const YAML::Node& of = system.second;
      const bool motor = of["drive"] && tree["drives"][of["drive"].Scalar()]["motor"];
      const std::size_t length = (of["parameters"] ? of["parameters"].size() : 0) +
                                 (of["initial"] ? of["initial"].size() : 0);
      if (of["model"].Scalar() == model && !of["inputs"] && !motor &&
          (found.system.empty() || length < found.length)) {
        found = {tree, system.first.Scalar(), length};
      }
    }
  }
  return found;
}

int writeNewScene(const std::string& name) {
  const ModelInfo* const model = findModel(name);
  if (model == nullptr) {
    throw InputError(fmt::format("no model '{}'{}", name, hint(name, modelNames())));
  }
  const Example example = plainest(name);
  printText(newScene(*model, example.tree, example.system));
  return kDone;
}

}  // namespace

void addNewCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("new", kNewDescription);
  const auto model = std::make_shared<std::string>();
  command.option("MODEL", *model, "one of `twin models`").required().type("");
  command.footer(kNewFooter);
  command.callback([model, &status] { status = writeNewScene(*model); });
}

}  // namespace whirl_twin
