#include <memory>
#include <optional>
#include <string>

#include "reports/csv_table.h"
#include "requests/field_balancing.h"
#include "requests/rotor_requests.h"
#include "requests/scene_argument.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kBalanceDescription =
    "Balances a rotor in several planes: by influence coefficients, from measured trial runs or "
    "of\n"
    "an earlier job; or, of a rotor with a model, from one log of the running machine.";

constexpr const char* kBalanceFooter =
    "FILE is YAML or JSON:\n"
    "  probes:  [left, right]                      what is measured, each at each speed\n"
    "  planes:  [disc_1, disc_2]                   where masses can be added\n"
    "  initial: [[12e-6, 40], [9e-6, 130]]         amplitude and phase lag (deg) of each; the\n"
    "                                              amplitudes without a unit, or with: 2.5 mil\n"
    "  trials:                                     runs with one more trial mass each\n"
    "    - {plane: disc_1, mass_radius: 1e-4, angle: 0, readings: [[8e-6, 55], [7e-6, 120]]}\n"
    "    - {plane: disc_2, mass_radius: 100 g mm, angle: 90, readings: [[10e-6, 20], [5e-6, "
    "150]]}\n"
    "mass_radius in kg m, or with a unit: 15 g mm, 5 oz in; angles in deg, from the shaft's phase\n"
    "mark in the direction of rotation. Optional:\n"
    "  left_in: true         in a trial run: its mass stays in during the later runs\n"
    "  influence: [[[0.11 um/(g m), 40], ...], ...]   in place of trials: the coefficients of an\n"
    "                        earlier job, a row for each probe, as this command prints them\n"
    "  symmetric: {probes: [[left, right]], planes: [[disc_1, disc_2]]}   the rotor is the same\n"
    "                        from either end: one trial run serves both planes of a pair\n"
    "  phase: lead           of the readings; default: lag\n"
    "  angles: against_rotation   default: with_rotation\n"
    "  weights: [1, 1]       of the probes\n"
    "  deviation: 0.2e-6     standard deviation of either component of a reading; default: from\n"
    "                        the residual, where there are more probes than planes\n"
    "  limits: {disc_1: 20 g mm}                      the largest mass times radius of a plane\n"
    "  places: {disc_1: {count: 12, first: 15}}       holes, or a list of angles: each mass is\n"
    "                        split over the two places beside its angle\n"
    "  tolerance: {grade: 2.5, mass: 40, speed: 3000 rpm, shares: {disc_1: 0.5, disc_2: 0.5}}\n"
    "                        of ISO 21940-11, grade in mm/s; default: equal shares\n"
    "The correction masses are to be added after the trial masses are removed.\n"
    "\n"
    "With --measured, FILE is a scene, and LOG an LCM log, a rosbag or a table with the "
    "measurements of "
    "its\n"
    "`sensors`, as `twin simulate --measure` writes it: displacement probes and a keyphasor, over "
    "a\n"
    "run-up or at several steady speeds. All sources with probes at the rotor are used. The "
    "slow-roll\n"
    "run-out is estimated with the unbalance. Angles count from the shaft's phase mark.\n"
    "Unbalances that the log does not identify are reported, and null in the JSON.\n"
    "\n"
    "Examples:\n"
    "  twin balance runs.yaml\n"
    "  twin simulate balancing --duration 14 --measure sensors --output run.lcmlog\n"
    "  twin balance balancing --measured run.lcmlog --planes node_2 node_4";

constexpr OptionQuantity kAnySpeed{"a shaft speed", "rad/s", 0.0};

struct BalanceRequest {
  SceneArgument scene;  // or the file of the trial runs
  std::optional<std::string> measured, csv;
  MeasuredBalanceRequest log;
  bool json = false;
};

int balanceRuns(const BalanceRequest& request) {
  return printDocument(fieldBalancingDocument(readBalancingJob(request.scene.name)), request.json,
                       request.csv);
}

int balanceMeasured(const BalanceRequest& request) {
  return printDocument(balanceDocument(sceneOf(request.scene), request.log), request.json,
                       request.csv);
}

}  // namespace

void addBalanceCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("balance", kBalanceDescription);
  const auto request = std::make_shared<BalanceRequest>();
  command.option("FILE", request->scene.name, "the balancing job; with --measured the scene")
      .required()
      .type("");
  const Option measured =
      command.option("--measured", request->measured, "log of the running machine").type("LOG");
  const auto with_log = [measured](const Option& option) { return option.needs(measured); };
  with_log(addSetOption(command, request->scene));
  with_log(command.option("--system", request->log.system, "this rotor").type("NAME"));
  with_log(
      command
          .option("--planes", request->log.unbalance.planes,
                  "stations where masses can be added; default: those of the scene's unbalances")
          .type("STATION"));
  with_log(command
               .quantity("--from", request->log.unbalance.from, kAnySpeed,
                         "slower intervals are left out: speed")
               .type("W"));
  with_log(command
               .quantity("--to", request->log.unbalance.to, kAnySpeed,
                         "faster intervals are left out: speed")
               .type("W"));
  with_log(command.flag("--known-run-out", request->log.unbalance.run_out_known,
                        "use the run-out of the scene's sensors, 0 where they have none"));
  with_log(command
               .option("--lcm-prefix", request->log.lcm_prefix,
                       "prefix of the log's channels; default: TWIN_")
               .type("PREFIX"));
  with_log(addImportOption(command, request->log.import));
  addCsvOption(command, request->csv);
  addJsonOption(command, request->json);
  command.footer(kBalanceFooter);
  command.callback([request, &status] {
    requireCsvName(request->csv);
    request->log.measured = request->measured.value_or("");
    status = request->measured ? balanceMeasured(*request) : balanceRuns(*request);
  });
}

}  // namespace whirl_twin
