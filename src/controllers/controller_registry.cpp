#include "controllers/controller_registry.h"

#include <algorithm>
#include <utility>

#include "controllers/controllers.h"
#include "controllers/notch.h"

namespace whirl_twin {

namespace {

struct ControllerSource {
  std::function<std::vector<ControllerInfo>()> controllers;
  std::function<void(const std::string&)> warn;
};

ControllerSource& controllerSource() {
  static ControllerSource source;
  return source;
}

const ControllerInfo* find(const std::vector<ControllerInfo>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const ControllerInfo& info) { return info.name == name; });
  return found == list.end() ? nullptr : &*found;
}

const std::vector<ControllerInfo>& builtInControllers() {
  static const std::vector<ControllerInfo> built_in{
      withNotch(leadInfo()), withNotch(linearInfo()), withNotch(lqgInfo()),
      withNotch(lqrInfo()),  withNotch(pidInfo()),    withNotch(stateFeedbackInfo()),
      speedInfo(),           swingUpInfo(),           externalInfo()};
  return built_in;
}

/// Why a controller of the source cannot join `list`; "" if it can.
std::string objection(const ControllerInfo& info, const std::vector<ControllerInfo>& list) {
  if (info.name.empty() || !info.make) {
    return "controller '" + info.name + "' is not registered: it has no name or no factory";
  }
  if (find(list, info.name) != nullptr) {
    return "controller '" + info.name + "' is not registered: duplicate name";
  }
  return "";
}

}  // namespace

void setControllerSource(std::function<std::vector<ControllerInfo>()> source,
                         std::function<void(const std::string&)> warn) {
  controllerSource() = {std::move(source), std::move(warn)};
}

const std::vector<ControllerInfo>& controllers() {
  static const std::vector<ControllerInfo> all = [] {
    std::vector<ControllerInfo> list = builtInControllers();
    const ControllerSource& source = controllerSource();
    for (ControllerInfo& info :
         source.controllers ? source.controllers() : std::vector<ControllerInfo>()) {
      const std::string why = objection(info, list);
      if (why.empty()) {
        list.push_back(std::move(info));
      } else {
        source.warn(why);
      }
    }
    std::sort(list.begin(), list.end(),
              [](const ControllerInfo& a, const ControllerInfo& b) { return a.name < b.name; });
    return list;
  }();
  return all;
}

std::vector<std::string> controllerNames() {
  std::vector<std::string> names;
  for (const ControllerInfo& info : controllers()) {
    names.push_back(info.name);
  }
  return names;
}

const ControllerInfo* findController(const std::string& name) {
  const ControllerInfo* built_in = find(builtInControllers(), name);
  return built_in != nullptr ? built_in : find(controllers(), name);
}

}  // namespace whirl_twin
