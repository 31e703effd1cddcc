#include "plugins/plugins.h"

#include <rospack/rospack.h>

#include <algorithm>
#include <cstdio>
#include <pluginlib/class_loader.hpp>
#include <string>
#include <utility>
#include <vector>

#include "controllers/controller_plugin.h"
#include "controllers/controller_registry.h"
#include "models/model_plugin.h"
#include "models/model_registry.h"

namespace whirl_twin {

namespace {

constexpr const char* kPackage = "whirl_twin";
constexpr const char* kAttribute = "plugin";

/// Joins the text of a loader to one line.
void warn(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::fprintf(stderr, "whirl_twin: %s\n", text.c_str());
}

/// The plugin descriptions that packages export to this one; none where ROS is not set up.
std::vector<std::string> descriptions() {
  rospack::Rospack packages;
  packages.setQuiet(true);
  std::vector<std::string> path;
  if (!packages.getSearchPathFromEnv(path)) {
    return {};
  }
  packages.crawl(path, false);
  std::vector<std::string> exports;  // "package file"
  if (!packages.plugins(kPackage, kAttribute, "", exports)) {
    return {};
  }
  std::vector<std::string> files;
  for (const std::string& line : exports) {
    files.push_back(line.substr(line.find(' ') + 1));
  }
  return files;
}

/// The descriptions that the plugins of a kind return: a ModelInfo each, or a ControllerInfo.
template <class Plugin>
auto infosOf(const char* base_class) {
  using Loader = pluginlib::ClassLoader<Plugin>;
  std::vector<decltype(std::declval<Plugin>().info())> all;
  const std::vector<std::string> files = descriptions();
  if (files.empty()) {
    return all;
  }
  try {
    // Never destroyed, because that would unload code that the twin uses.
    static Loader& loader = *new Loader(kPackage, base_class, kAttribute, files);
    for (const std::string& name : loader.getDeclaredClasses()) {
      try {
        all.push_back(loader.createUniqueInstance(name)->info());
      } catch (const std::exception& error) {
        warn("the plugin " + name + " is not loaded: " + error.what());
      }
    }
  } catch (const std::exception& error) {
    warn(std::string("no plugin can be loaded: ") + error.what());
  }
  return all;
}

}  // namespace

void usePlugins() {
  setModelSource([] { return infosOf<ModelPlugin>("whirl_twin::ModelPlugin"); }, warn);
  setControllerSource([] { return infosOf<ControllerPlugin>("whirl_twin::ControllerPlugin"); },
                      warn);
}

}  // namespace whirl_twin
