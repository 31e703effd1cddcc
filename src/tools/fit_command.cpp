#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "estimation/fit_study_reader.h"
#include "estimation/shooting_fit.h"
#include "messages/input_error.h"
#include "reports/csv_table.h"
#include "reports/drawings.h"
#include "reports/fit_report.h"
#include "reports/measured_file.h"
#include "scene/scene_reader.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"
#include "tools/report_options.h"
#include "transport/channels.h"

namespace whirl_twin {

#ifndef WHIRL_TWIN_FIT
ShootingFit fitByShooting(const FitStudy&, const FitProgress&) {
  throw RunFailure("fit: built without Ceres: run scripts/setup --fit, then build again");
}
#endif

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

struct FitRequest {
  std::string study;
  std::optional<std::string> output;
  std::optional<std::string> plot, csv;
  std::string lcm_prefix = kDefaultLcmPrefix;
  bool validate_only = false;
  bool check = false;
  bool json = false;
  bool insist = false;
};

std::string pictureOf(const std::string& plot, const FitStudy& study, std::size_t run) {
  const std::string name = std::filesystem::path(study.runs[run].file).stem().string();
  return pictureName(plot, name, study.runs.size() > 1);
}

void writeScene(const FitStudy& study, const ShootingFit& fit, const std::string& path) {
  PendingFile file(path);
  std::ofstream out(file.path(), std::ios::binary);
  out << fittedScene(study, fit, std::filesystem::path(path).parent_path().string()) << std::flush;
  if (!out) {
    throw RunFailure(path + ": cannot be written");
  }
  out.close();
  readSceneFile(file.path());
  file.complete();
}

int fit(const FitRequest& request) {
  requirePictureName(request.plot);
  requireLcmPrefix(request.lcm_prefix);
  requireCsvName(request.csv);
  const FitStudy study =
      readFitStudy(request.study, request.validate_only || request.check,
                   [&](const std::string& path, const std::string& time,
                       const std::vector<std::string>& columns) {
                     return readRecordedRun(path, request.lcm_prefix, time, columns);
                   });
  if (request.check) {
    if (request.json) {
      printJson(checkJson(study));
    } else {
      printText(checkText(study));
    }
    return kDone;
  }
  std::optional<ProgressBar> bar;
  const ShootingFit fit = fitByShooting(study, [&](int done, int of) {
    if (!bar) {
      bar.emplace(fmt::format("at most {} iterations", of), of, request.json, request.insist);
    }
    bar->show(done);
  });
  bar.reset();
  if (request.output) {
    writeScene(study, fit, *request.output);
  }
  Drawings drawings;
  for (std::size_t run = 0; request.plot && run < study.runs.size(); ++run) {
    drawings.add(pictureOf(*request.plot, study, run), figureJson(figure(study, fit, run)));
  }
  drawings.write();
  if (request.csv) {
    writeCsv(*request.csv, tables(fit));
  }
  if (request.json) {
    printJson(json(study, fit));
  } else {
    printText(text(study, fit));
  }
  return fit.converged ? kDone : kFailed;
}

}  // namespace

void addFitCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("fit", kFitDescription);
  const auto request = std::make_shared<FitRequest>();
  command.option("STUDY", request->study, "the study (YAML)").required().type("");
  command.option("--output", request->output, "write the scene with the fitted values")
      .type("FILE.yaml");
  command
      .option("--plot", request->plot,
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
  addCsvOption(command, request->csv);
  addJsonOption(command, request->json);
  addInsistOption(command, request->insist);
  command.footer(kFitFooter);
  command.callback([request, &status] { status = fit(*request); });
}

}  // namespace whirl_twin
