// `twin serve`.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/step_choice.h"
#include "messages/input_error.h"
#include "reports/output.h"
#include "requests/simulation.h"
#include "tools/alarm_settings_file.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "tools/patience.h"
#include "web/served_twin.h"
#include "web/web_files.h"

namespace whirl_twin {

namespace {

constexpr const char* kServeDescription =
    "Runs a scene in real time with its monitor, and shows it in a browser: motion, orbits, "
    "traces,\n"
    "alarms, sliders for parameters, inputs and speeds. Without ROS, until Ctrl-C.";

constexpr const char* kServeFooter =
    "Open the address that it prints. Foxglove, Lichtblick and PlotJuggler connect to the same "
    "port\n"
    "(ws://127.0.0.1:8765): states, alerts and margins are channels in JSON.\n"
    "\n"
    "Only programs of this machine can connect, and only the page of this server. --address with "
    "an\n"
    "address of the network requires a token, which is part of the address that it prints; there "
    "is "
    "no\n"
    "encryption. Exit status: 0 after Ctrl-C, 1 the port is in use, 2 bad input.\n"
    "\n"
    "Examples:\n"
    "  twin serve demo\n"
    "  twin serve compressor --port 0 --paused\n"
    "  twin serve pump.yaml --address 0.0.0.0 --read-only";

struct ServeRequest {
  SceneArgument scene;
  int port = 8765;
  std::string address = "127.0.0.1";
  std::vector<std::string> origins;
  std::optional<std::string> settings;
  std::string realtime = "ignore";
  double rate = 100.0;  // Hz
  double real_time_factor = 1.0;
  bool read_only = false, paused = false;
};

ServeSettings settingsOf(const ServeRequest& request) {
  constexpr double kLowestRate = 1.0e-3;  // Hz
  if (request.port < 0 || request.port > UINT16_MAX) {
    throw InputError(fmt::format("--port: must be from 0 (any free one) to {}, found {}",
                                 UINT16_MAX, request.port));
  }
  if (!(request.rate == 0.0 || (request.rate >= kLowestRate && std::isfinite(request.rate)))) {
    throw InputError(fmt::format("--rate: must be 0 (every step) or >= {:g} Hz, found {}",
                                 kLowestRate, request.rate));
  }
  ServeSettings settings;
  settings.access.address = request.address;
  settings.access.port = static_cast<std::uint16_t>(request.port);
  settings.access.origins = request.origins;
  settings.access.token = isLoopback(request.address) ? "" : randomToken();
  settings.files = readPage(pageFolder());
  settings.rate = request.rate;
  settings.real_time_factor = request.real_time_factor;
  settings.paused = request.paused;
  settings.read_only = request.read_only;
  settings.realtime = parseRealtimeMode(request.realtime);
  return settings;
}

int serve(const ServeRequest& request) {
  ServeSettings settings = settingsOf(request);
  const Scene scene = withStepsChosen(sceneOf(request.scene));
  warnOfExternalControllers(scene);
  settings.alarms = alarmSettingsOf(build(scene), request.settings);
  catchInterrupts();
  ServedTwin twin(scene, settings, [] { return !interrupted(); });
  runsUntilStopped();
  printText(twin.url() + "\n");
  finishStandardOutput();
  const bool interrupted_by_user = twin.run();
  complain(fmt::format("twin serve: stopped after {} steps\n", twin.steps()));
  return interrupted_by_user ? kDone : kFailed;
}

}  // namespace

void addServeCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("serve", kServeDescription);
  const auto request = std::make_shared<ServeRequest>();
  addSceneOption(command, request->scene);
  command.option("--port", request->port, "TCP port; 0: any free one; default: 8765").type("PORT");
  command
      .option("--address", request->address,
              "to listen on; default: 127.0.0.1, this machine only; any other needs a token")
      .type("IP");
  command
      .option("--origin", request->origins,
              "further page that may connect, as http://localhost:8080; repeatable")
      .oneByOne()
      .type("URL");
  command.flag("--read-only", request->read_only, "clients can change nothing");
  command.flag("--paused", request->paused, "start paused");
  command
      .option("--rate", request->rate, "states per second to clients; 0: every step; default: 100")
      .type("HZ");
  command
      .option("--real-time-factor", request->real_time_factor,
              "simulated seconds per second, 0.01 to 1000; 0: as fast as possible; default: 1")
      .type("F");
  command
      .option("--settings", request->settings,
              "limits of the alarms, YAML like config/monitor.yaml; default: that file")
      .type("FILE");
  command
      .option("--realtime", request->realtime,
              "real-time priority of the loop: required, if possible, or not requested; default: "
              "ignore")
      .among({"enforce", "warn", "ignore"});
  command.footer(kServeFooter);
  command.callback([request, &status] { status = serve(*request); });
}

}  // namespace whirl_twin
