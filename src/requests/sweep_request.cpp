#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <filesystem>
#include <functional>
#include <thread>
#include <utility>

#include "messages/input_error.h"
#include "reports/asked_cost.h"
#include "reports/study_report.h"
#include "requests/study_requests.h"
#include "studies/answers.h"
#include "studies/block_evaluator.h"
#include "studies/hdf5_results.h"
#include "studies/optimizer.h"

namespace whirl_twin {

#ifndef WHIRL_TWIN_HDF5
void writeHdf5Results(const Study&, const ResultFolder&, const Answers&) {
  complain("twin: no results.h5: built without HDF5 (scripts/setup --studies)\n");
}
#endif

#ifndef WHIRL_TWIN_NLOPT
Optimum optimize(const Study&, const StepsChosen&, const std::atomic<bool>&,
                 const std::function<void(std::uint64_t)>&) {
  throw RunFailure("optimize: built without NLopt: run scripts/setup --studies, then build again");
}
#endif

namespace {

/// "3/16", from 1.
Share shareOf(const std::optional<std::string>& text) {
  if (!text) {
    return {};
  }
  Share share;
  const char* const end = text->data() + text->size();
  const auto [slash, error] = std::from_chars(text->data(), end, share.part);
  if (error == std::errc() && slash != end && *slash == '/') {
    const auto [last, wrong] = std::from_chars(slash + 1, end, share.parts);
    if (wrong == std::errc() && last == end && share.part >= 1 && share.part <= share.parts) {
      --share.part;
      return share;
    }
  }
  throw InputError(fmt::format("--part: must be I/N with 1 <= I <= N, found '{}'", *text));
}

template <class Report>
Document documentOf(const Study& study, const Report& report) {
  Document document;
  document.json = json(study, report);
  document.text = text(study, report);
  return document;
}

void fail(Document& document, const std::string& why) {
  document.done = false;
  document.failure = why;
}

Document documentOfPoint(const Study& study, const SweepRequest& request,
                         const std::atomic<bool>& stop) {
  if (*request.point >= study.points()) {
    throw InputError(
        fmt::format("--point: must be from 0 to {}, found {}", study.points() - 1, *request.point));
  }
  const StepsChosen steps = request.output
                                ? ResultFolder(*request.output, study, request.mixed).steps()
                                : chooseSteps(study);
  StudyPoint point{*request.point, study.valuesAt(*request.point), {}};
  try {
    point.outcome = BlockEvaluator(study, steps, stop).at(point.point);
  } catch (const Interrupted&) {
    throw RunFailure("interrupted");
  }
  Document document = documentOf(study, point);
  if (!point.outcome.failure.empty()) {
    fail(document, fmt::format("point {}: {}", point.point, point.outcome.failure));
  }
  return document;
}

/// A study without points.
Document documentOfOptimum(const Study& study, const SweepRequest& request,
                           WorkProgress& progress) {
  const std::array<std::pair<bool, const char*>, 6> for_points{
      {{request.output.has_value(), "--output"},
       {request.point.has_value(), "--point"},
       {request.part.has_value(), "--part"},
       {request.merge, "--merge"},
       {request.status, "--status"},
       {request.mixed, "--mixed"}}};
  for (const auto& [given, name] : for_points) {
    if (given) {
      throw InputError(fmt::format(
          "{}: needs a study with a design; {} is an optimization, whose result is printed", name,
          study.source));
    }
  }
  bool begun = false;
  const auto most = static_cast<std::int64_t>(study.optimization->evaluations);
  try {
    const Optimum optimum =
        optimize(study, chooseSteps(study), progress.stop(), [&](std::uint64_t evaluations) {
          if (!std::exchange(begun, true)) {
            progress.begin(fmt::format("at most {} evaluations", most), most, request.insist);
          }
          progress.show(static_cast<std::int64_t>(evaluations));
        });
    progress.clear();
    Document document = documentOf(study, optimum);
    if (optimum.values.empty()) {
      fail(document, "optimize: no point satisfies the requirements");
    }
    return document;
  } catch (const Interrupted&) {
    throw RunFailure("interrupted");
  }
}

void runAll(const Study& study, const ResultFolder& folder, const SweepRequest& request,
            WorkProgress& progress) {
  const std::vector<std::uint64_t> blocks = unfinishedBlocks(study, folder, shareOf(request.part));
  if (blocks.empty()) {
    return;
  }
  const unsigned workers =
      request.workers > 0 ? request.workers : std::max(1U, std::thread::hardware_concurrency());
  BlockDeck deck(blocks);
  sweep(
      study, folder, static_cast<unsigned>(std::min<std::uint64_t>(workers, blocks.size())),
      [&](std::uint64_t) { return deck.next(); }, progress.stop(),
      sweepProgress(study, blocks, request.insist, progress));
  progress.clear();
}

/// The varied numbers and the measures of every point.
CsvTable pointsTable(const Study& study, const ResultFolder& folder) {
  CsvTable table{"points", {"point"}};
  for (const Variation& variation : study.vary) {
    table.columns.push_back(variation.path);
  }
  for (const Measure& measure : study.measures) {
    table.columns.push_back(measure.name);
  }
  folder.forEachPoint([&](const PointResult& result) {
    Json row{{"point", result.point}};
    for (std::size_t k = 0; k < study.vary.size(); ++k) {
      row[study.vary[k].path] = result.values[k];
    }
    for (std::size_t k = 0; k < study.measures.size() && result.outcome.failure.empty(); ++k) {
      row[study.measures[k].name] = result.outcome.measures[k];
    }
    table.rows.push_back(std::move(row));
  });
  return table;
}

}  // namespace

SweepProgress sweepProgress(const Study& study, const std::vector<std::uint64_t>& blocks,
                            bool insist, WorkProgress& progress) {
  std::uint64_t of = 0;
  for (const std::uint64_t block : blocks) {
    of += study.sizeOf(block);
  }
  progress.begin(fmt::format("{} points", of), static_cast<std::int64_t>(of), insist);
  return [&progress](std::uint64_t done) { progress.show(static_cast<std::int64_t>(done)); };
}

void requireSweepUse(const SweepRequest& request) {
  if (request.workers > 4096) {
    throw InputError(fmt::format("--workers: must be from 1 to 4096, found {}", request.workers));
  }
  static_cast<void>(shareOf(request.part));
}

Document sweepDocument(const Study& study, const SweepRequest& request, WorkProgress& progress) {
  requireSweepUse(request);
  if (study.optimization) {
    return documentOfOptimum(study, request, progress);
  }
  if (request.point) {
    return documentOfPoint(study, request, progress.stop());
  }
  if (!request.output) {
    throw InputError("--output: missing; must be the folder of the results");
  }
  if ((request.status || request.merge) &&
      !std::filesystem::exists(*request.output + "/manifest.yaml")) {
    throw InputError(fmt::format("--output: {} has no results of a study", *request.output));
  }
  const auto points = static_cast<double>(study.points());
  const auto columns = static_cast<double>(study.measures.size() + 1);  // one is sorted beside
  tell({0.0, sizeof(double) * points * columns, fmt::format("{} points", study.points())},
       request.insist || request.status);
  const ResultFolder folder(*request.output, study, request.mixed);
  if (request.status) {
    return documentOf(study, statusOf(study, folder));
  }
  if (!request.merge) {
    runAll(study, folder, request, progress);
  }
  const StudyStatus status = statusOf(study, folder);
  if (request.part && status.done < study.points()) {
    return documentOf(study, status);
  }
  if (status.done < study.points()) {
    throw RunFailure(fmt::format("{}: {} of {} points are done: run the other parts first",
                                 *request.output, status.done, study.points()));
  }
  return sweepAnswers(study, folder, request);
}

Document sweepAnswers(const Study& study, const ResultFolder& folder, const SweepRequest& request) {
  const Answers answers = answersOf(study, folder.merge());
  writeHdf5Results(study, folder, answers);
  Document document = documentOf(study, answers);
  if (answers.failures >= answers.points) {
    fail(document, fmt::format("{}/failed.csv: all points failed", *request.output));
  }
  if (request.with_points) {
    document.tables = {pointsTable(study, folder)};
  }
  return document;
}

}  // namespace whirl_twin
