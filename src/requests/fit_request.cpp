#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>

#include "estimation/fit_study_reader.h"
#include "estimation/shooting_fit.h"
#include "messages/input_error.h"
#include "reports/figure.h"
#include "reports/fit_report.h"
#include "reports/measured_file.h"
#include "requests/study_requests.h"
#include "scene/scene_reader.h"

namespace whirl_twin {

#ifndef WHIRL_TWIN_FIT
ShootingFit fitByShooting(const FitStudy&, const FitProgress&) {
  throw RunFailure("fit: built without Ceres: run scripts/setup --fit, then build again");
}
#endif

namespace {

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

}  // namespace

Document fitDocument(const std::string& path, const FitRequest& request, WorkProgress& progress) {
  requireLcmPrefix(request.lcm_prefix);
  const auto study = std::make_shared<const FitStudy>(
      readFitStudy(path, request.validate_only || request.check,
                   [&](const std::string& file, const TableSettings& table,
                       const std::vector<WantedColumn>& columns) {
                     return readRecordedRun(file, request.lcm_prefix, table, columns);
                   }));
  Document document;
  if (request.check) {
    document.json = checkJson(*study);
    document.text = checkText(*study);
    return document;
  }
  bool begun = false;
  const auto fit = std::make_shared<const ShootingFit>(fitByShooting(*study, [&](int done, int of) {
    if (!std::exchange(begun, true)) {
      progress.begin(fmt::format("at most {} iterations", of), of, request.insist);
    }
    progress.show(done);
  }));
  progress.clear();
  if (request.output) {
    writeScene(*study, *fit, *request.output);
  }
  document.json = json(*study, *fit);
  document.text = text(*study, *fit);
  document.tables = tables(*fit);
  document.done = fit->converged;
  for (std::size_t run = 0; run < study->runs.size(); ++run) {
    document.drawings.push_back(
        {std::filesystem::path(study->runs[run].file).stem().string(),
         [study, fit, run] { return figureJson(figure(*study, *fit, run)); }});
  }
  return document;
}

}  // namespace whirl_twin
