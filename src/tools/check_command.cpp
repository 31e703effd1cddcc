#include <memory>
#include <optional>

#include "reports/rotor_systems.h"
#include "reports/scene_check.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kCheckDescription =
    "Checks a scene file and prints what will be modelled: systems, states, integrators, "
    "messages,\nand the cost of a step on this machine.";

constexpr const char* kCheckFooter =
    "All errors of a scene are printed at once, one per line on standard error: the file, the "
    "key,\nwhat is required with its unit, and what was found. Exit status 2.\n"
    "\n"
    "Examples:\n"
    "  twin check demo\n"
    "  twin check demo --system rotor --json";

struct CheckRequest {
  SceneArgument scene;
  std::optional<std::string> system;
  bool json = false;
  bool insist = false;
};

int check(const CheckRequest& request) {
  const Scene scene = sceneOf(request.scene);
  const std::vector<std::size_t> systems = selectedSystems(scene, request.system);
  tell(costOfCheck(scene, systems), request.insist);
  const SceneCheck result = checkScene(scene, systems);
  return printReport(request.json, json(result), text(result));
}

}  // namespace

void addCheckCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("check", kCheckDescription);
  const auto request = std::make_shared<CheckRequest>();
  addSceneOption(command, request->scene);
  command.option("--system", request->system, "show this system only").type("NAME");
  command.flag("--json", request->json,
               "print one JSON object; `accuracy` of each system: the error bound and its horizon");
  addInsistOption(command, request->insist);
  command.footer(kCheckFooter);
  command.callback([request, &status] { status = check(*request); });
}

}  // namespace whirl_twin
