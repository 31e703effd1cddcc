#include "twin/scene_lines.h"

#include <fmt/format.h>

#include <optional>
#include <sstream>

#include "messages/checksum.h"
#include "scene/node_reader.h"

namespace whirl_twin {

namespace {

/// A number has the same text in any notation.
std::string normalised(const std::string& scalar) {
  const std::optional<double> number = parseNumber(scalar);
  return number ? fmt::format("{}", *number) : scalar;
}

void gather(const YAML::Node& node, const std::string& path, SceneLines& lines) {
  if ((node.IsMap() || node.IsSequence()) && node.size() == 0) {
    lines[path] = "nothing";
  } else if (node.IsMap()) {
    for (const auto& member : node) {
      const auto key = member.first.as<std::string>();
      gather(member.second, path.empty() ? key : path + "." + key, lines);
    }
  } else if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      gather(node[i], fmt::format("{}[{}]", path, i), lines);
    }
  } else {
    lines[path] = node.IsScalar() ? normalised(node.Scalar()) : "nothing";
  }
}

std::string described(const InputSignal& table) {
  std::uint64_t sum = kNoFingerprint;
  for (std::size_t i = 0; i < table.instants.size(); ++i) {
    sum = fingerprint(&table.instants[i], sizeof table.instants[i], sum);
    sum = fingerprint(&table.values[i], sizeof table.values[i], sum);
  }
  return fmt::format("a table of {} rows, checksum {:016x}", table.instants.size(), sum);
}

}  // namespace

SceneLines sceneLines(const YAML::Node& tree) {
  SceneLines lines;
  gather(tree, "", lines);
  return lines;
}

state::SceneText sceneText(const YAML::Node& tree, const std::string& source) {
  state::SceneText text;
  text.source = source;
  std::istringstream lines(YAML::Dump(tree));
  for (std::string line; std::getline(lines, line);) {
    text.line.push_back(line);
  }
  return text;
}

SceneLines sceneLines(const YAML::Node& tree, const Twin& twin) {
  SceneLines lines = sceneLines(tree);
  lines["step"] = fmt::format("{} ns", twin.scene().step);
  std::string& order = lines["order"];
  for (const DriveSpec& drive : twin.scene().drives) {
    order += drive.name + " ";
  }
  for (std::size_t i = 0; i < twin.systems().size(); ++i) {
    const BuiltSystem& system = *twin.systems()[i];
    const std::string& name = system.spec.name;
    order += name + " ";
    lines["systems." + name + ".method"] =
        fmt::format("{}, {} in a step", system.integrator, system.spec.substeps);
    const Inputs& inputs = twin.inputs(i);
    for (std::size_t k = 0; k < inputs.count(); ++k) {
      if (inputs.isTable(k)) {
        lines[fmt::format("systems.{}.inputs.{}", name, system.dynamics->inputs()[k].name)] =
            described(inputs.signal(k));
      }
    }
  }
  for (const ControllerSpec& controller : twin.scene().controllers) {
    order += controller.name + " ";
  }
  return lines;
}

}  // namespace whirl_twin
