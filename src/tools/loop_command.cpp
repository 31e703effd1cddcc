#include <memory>
#include <optional>

#include "reports/csv_table.h"
#include "requests/scene_requests.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kLoopDescription =
    "Stability of the sampled control loops of a scene, with the rates and delays of "
    "all\ncontrollers together.";

constexpr const char* kLoopFooter =
    "Linearized about the motion in which the loop holds its systems, with the present set-points\n"
    "(where it holds none, about the equilibrium nearest to the start), through the transition\n"
    "matrix of one sample (with several rates: of the period after which all samples repeat). Its\n"
    "characteristic polynomial is put to the exact Routh test in w with z = (1 + w)/(1 - w); the\n"
    "eigenvalues are printed beside it. Limits, slew rate and resolution are not linear and not\n"
    "included.\n"
    "In the picture: Bode and Nyquist diagrams of the loop opened at each sensor, and the\n"
    "sensitivity there over the zones of ISO 14839-3.\n"
    "\n"
    "Examples:\n"
    "  twin loop my_rotor.yaml --plot loop.svg\n"
    "  twin loop my_rotor.yaml --speed 300 --json";

struct LoopOptions {
  SceneArgument scene;
  std::optional<double> speed;
  std::optional<std::string> plot;
  bool json = false;
};

int loopsOf(const LoopOptions& options) {
  requirePictureName(options.plot);
  const Document document = loopDocument(sceneOf(options.scene), options.speed);
  return printDocument(document, options.json, std::nullopt, options.plot);
}

}  // namespace

void addLoopCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("loop", kLoopDescription);
  const auto request = std::make_shared<LoopOptions>();
  addSceneOption(command, request->scene);
  command
      .quantity("--speed", request->speed, kSignedShaftSpeed, "speed of all shafts",
                "that at the start")
      .type("W");
  command.option("--plot", request->plot, "the diagrams, FILE.svg or FILE.png").type("FILE");
  addJsonOption(command, request->json);
  command.footer(kLoopFooter);
  command.callback([request, &status] { status = loopsOf(*request); });
}

}  // namespace whirl_twin
