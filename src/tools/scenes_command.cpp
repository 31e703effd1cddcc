#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

#include "messages/input_error.h"
#include "messages/names.h"
#include "reports/output.h"
#include "requests/shipped_scenes.h"
#include "scene/scene_reader.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kScenesDescription =
    "Lists the scenes of the package, or those of a folder: what each shows, what to watch, and "
    "its\n"
    "systems with their models.";

constexpr const char* kScenesFooter =
    "Any of them runs by its name:\n"
    "  twin analyze rod_slider\n"
    "  roslaunch whirl_twin demo.launch scene:=rod_slider\n"
    "\n"
    "Examples:\n"
    "  twin scenes\n"
    "  twin scenes --show rod_slider > mine.yaml\n"
    "  twin scenes my_scenes --json";

struct SceneEntry {
  std::string name;   ///< of the file, without .yaml
  std::string about;  ///< its subject: the first paragraph of its opening comment
  std::string watch;  ///< the rest of that comment: remarkable features
  std::string path;
  Scene scene;
  std::string inputError;  ///< why it cannot be read; "" if it can
};

/// The opening comment of a file, as paragraphs of running text.
std::vector<std::string> openingComment(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::string> paragraphs{""};
  for (std::string line; std::getline(in, line) && !line.empty() && line[0] == '#';) {
    const std::size_t start = line.find_first_not_of("# \r");
    if (start == std::string::npos) {
      paragraphs.emplace_back();
    } else {
      const std::size_t end = line.find_last_not_of(" \r") + 1;
      paragraphs.back() += (paragraphs.back().empty() ? "" : " ") + line.substr(start, end - start);
    }
  }
  return paragraphs;
}

SceneEntry readEntry(const std::filesystem::path& file) {
  SceneEntry entry;
  entry.name = file.stem();
  entry.path = file;
  const std::vector<std::string> paragraphs = openingComment(file);
  entry.about = paragraphs.front();
  for (std::size_t i = 1; i < paragraphs.size(); ++i) {
    entry.watch += (entry.watch.empty() ? "" : " ") + paragraphs[i];
  }
  try {
    entry.scene = readSceneFile(file);
  } catch (const SceneError& error) {
    entry.inputError = error.errors().front();
  }
  return entry;
}

std::string sceneEntryText(const SceneEntry& entry) {
  if (!entry.inputError.empty()) {
    return fmt::format("{}\n  cannot be read: {}\n", entry.name, entry.inputError);
  }
  std::string systems;
  for (const SystemSpec& system : entry.scene.systems) {
    systems += fmt::format("{}{} ({})", systems.empty() ? "" : ", ", system.name, system.model);
  }
  return fmt::format("{}\n  {}\n{}  systems: {}\n", entry.name, entry.about,
                     entry.watch.empty() ? "" : "  " + entry.watch + "\n", systems);
}

Json sceneEntryJson(const SceneEntry& entry) {
  Json json;
  json["path"] = entry.path;
  json["about"] = entry.about;
  json["watch"] = entry.watch;
  json["refusal"] = entry.inputError.empty() ? Json() : Json(entry.inputError);
  json["systems"] = Json::object();
  for (const SystemSpec& system : entry.scene.systems) {
    json["systems"][system.name] = system.model;
  }
  return json;
}

int listScenes(const std::optional<std::string>& folder, bool as_json) {
  const std::filesystem::path where =
      folder ? std::filesystem::path(*folder) : shippedSceneFolder();
  std::error_code error;
  if (!std::filesystem::is_directory(where, error)) {
    throw InputError(folder ? fmt::format("{}: must be a folder of scene files", *folder)
                            : "the scenes of the package were not found; give their folder");
  }
  Json all;
  all["folder"] = where.string();
  all["scenes"] = Json::object();
  std::string texts;
  for (const std::filesystem::path& file : sceneFiles(where)) {
    const SceneEntry entry = readEntry(file);
    all["scenes"][entry.name] = sceneEntryJson(entry);
    texts += (texts.empty() ? "" : "\n") + sceneEntryText(entry);
  }
  if (as_json) {
    printJson(all);
  } else {
    printText(texts);
  }
  return kDone;
}

/// The text of the scene file, comments included, to read or to start a new scene from.
int showScene(const std::string& name, bool as_json) {
  const std::string path = scenePath(name);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    std::vector<std::string> names;
    for (const std::filesystem::path& file : sceneFiles(shippedSceneFolder())) {
      names.push_back(file.stem());
    }
    throw InputError(fmt::format("--show: no scene '{}'{}", name, hint(name, names)));
  }
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) {
    throw InputError(fmt::format("--show: {}: cannot be read", path));
  }
  if (as_json) {
    printJson({{"path", path}, {"text", text}});
  } else {
    printText(text);
  }
  return kDone;
}

}  // namespace

void addScenesCommand(const ProgramCommand& twin, int& status) {
  struct ScenesRequest {
    std::optional<std::string> folder, show;
    bool json = false;
  };
  const ProgramCommand command = twin.subcommand("scenes", kScenesDescription);
  const auto request = std::make_shared<ScenesRequest>();
  command.option("FOLDER", request->folder, "of scene files; default: the package's").type("");
  command.option("--show", request->show, "print this scene's file, and list none").type("NAME");
  addJsonOption(command, request->json);
  command.footer(kScenesFooter);
  command.callback([request, &status] {
    status = request->show ? showScene(*request->show, request->json)
                           : listScenes(request->folder, request->json);
  });
}

}  // namespace whirl_twin
