#include <memory>
#include <optional>

#include "reports/csv_table.h"
#include "requests/study_requests.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kFitDescription =
    "Identifies parameters of a system from measured runs: values, confidence intervals, "
    "parameters\nthat are not identifiable, and how well validation runs are predicted.";

constexpr const char* kFitFooter =
    "STUDY is YAML; its paths are relative to its folder:\n"
    "  scene: double.yaml\n"
    "  system: pendulum\n"
    "  runs:                                              comma-separated values, a row of names\n"
    "    - {file: swing_1.csv, use: train, time: time, measured: {theta1: q1, theta2: q2}}\n"
    "    - {file: swing_9.csv, use: validate, time: time, measured: {theta1: q1, theta2: q2},\n"
    "       inputs: {torque1: tau}}                       measured inputs of the model\n"
    "  windows: {length: 1.0, start: estimated}           s, or all; start: measured\n"
    "  fit: {mass1: {min: 0.01, max: 1.0}, coulomb1: {min: 0.0}}\n"
    "A run may be an LCM log or a rosbag: swing.lcmlog, swing.bag, with channels of one source as "
    "columns.\n"
    "A coordinate, or its rate as theta1_rate, is scale * state + offset:\n"
    "  measured: {theta1: {column: q1, offset: fit, scale: 1.0, deviation: 0.001}}\n"
    "An angle that counts within a turn is unwrapped, and a remark reports it; `wrap: false` "
    "leaves it unchanged.\n"
    "  inputs: {torque1: {column: tau, scale: fit, offset: fit, delay: fit, hold: true}}\n"
    "A value `fit` is one for all runs; `each_run` is one for each run, validation runs included.\n"
    "Values start as in the scene. In directions that are not identifiable they keep these "
    "values,\nand a remark reports it. Exit status: 0 fitted; 1 no fit was found; 2 a study, scene "
    "or run that\ncannot be used.";

struct FitOptions {
  std::string study;
  std::optional<std::string> plot, csv;
  bool json = false;
  FitRequest request;
};

int fit(const FitOptions& options) {
  requirePictureName(options.plot);
  requireCsvName(options.csv);
  TerminalProgress progress(options.json);
  return printDocument(fitDocument(options.study, options.request, progress), options.json,
                       options.csv, options.plot);
}

}  // namespace

void addFitCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("fit", kFitDescription);
  const auto options = std::make_shared<FitOptions>();
  FitRequest* const request = &options->request;
  command.option("STUDY", options->study, "the study (YAML)").required().type("");
  command.option("--output", request->output, "write the scene with the fitted values")
      .type("FILE.yaml");
  command
      .option("--plot", options->plot,
              "draw each run and its prediction: FILE.svg or FILE.png, of several runs "
              "FILE_RUN")
      .type("FILE");
  command
      .option("--lcm-prefix", request->lcm_prefix,
              "prefix of the machine's channels in runs that are logs; default: "
              "TWIN_")
      .type("PREFIX");
  command.flag("--validate-only", request->validate_only,
               "fit only the initial states of the windows");
  command.flag("--check", request->check,
               "fit nothing: report anomalies of the runs, with their rows");
  addCsvOption(command, options->csv);
  addJsonOption(command, options->json);
  addInsistOption(command, request->insist);
  command.footer(kFitFooter);
  command.callback([options, &status] { status = fit(*options); });
}

}  // namespace whirl_twin
