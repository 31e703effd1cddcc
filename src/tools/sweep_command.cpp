#include <fmt/format.h>

#include <array>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "messages/input_error.h"
#include "reports/asked_cost.h"
#include "reports/output.h"
#include "reports/study_report.h"
#include "studies/block_evaluator.h"
#include "studies/hdf5_results.h"
#include "studies/ranks.h"
#include "studies/study_reader.h"
#include "studies/sweep.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "tools/progress_bar.h"
#include "tools/report_options.h"

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

constexpr const char* kSweepDescription =
    "Runs a scene at every point of a study: tolerances, grids, designs, sensitivities. "
    "The\nmeasures are written to a folder, their statistics are printed.";

constexpr const char* kSweepFooter =
    "STUDY is YAML; its keys:\n"
    "  study: {scene: rotor.yaml, seed: 7}\n"
    "  vary:\n"
    "    rotor.stiffness: {uniform: [0.9e4, 1.1e4]}\n"
    "    rotor.eccentricity: {normal: [1.0e-4, 1.0e-5]}\n"
    "    shaft.max_acceleration: {list: [5, 10, 20, 40]}\n"
    "  design: {latin_hypercube: 10000}      or monte_carlo, sobol, grid, list, one_at_a_time,\n"
    "                                        sobol_indices, morris\n"
    "  run: {duration: 20.0}                 s; or analyze\n"
    "  measure: {peak: max(rotor.whirl.radius), critical: \"critical_speeds[0]\"}\n"
    "  require: {peak: \"< 2.0e-4\"}\n"
    "In place of `design`, `optimize: {minimize: peak, over: [rotor.damping]}` finds the "
    "minimum\nor maximum of a measure within the ranges, subject to `require`.\n"
    "A point depends only on the study and its number: results do not depend on workers, "
    "interruptions\nor machines. After an interruption the same command resumes. Failed points are "
    "in failed.csv of\nthe folder. Processes of mpirun or srun get blocks of points on request.\n"
    "\n"
    "Examples:\n"
    "  twin sweep study.yaml --output results\n"
    "  twin sweep study.yaml --output results --status\n"
    "  twin sweep study.yaml --point 1234\n"
    "  mpirun -n 64 twin sweep study.yaml --output results\n"
    "  twin sweep study.yaml --output results --part 3/16       one of 16 jobs; then --merge\n"
    "  twin sweep optimum.yaml                                  an optimization\n"
    "Exit status: 0 done, with or without failed points; 1 interrupted, cannot be written, or\nall "
    "points failed; 2 an invalid study or scene.";

struct SweepRequest {
  std::string study;
  std::optional<std::string> output;
  std::optional<std::uint64_t> point;
  std::optional<std::string> part;
  unsigned workers = 0;
  bool merge = false;
  bool status = false;
  bool mixed = false;
  bool json = false;
  bool insist = false;
};

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
void print(const SweepRequest& request, const Study& study, const Report& report) {
  if (request.json) {
    printJson(json(study, report));
  } else {
    printText(text(study, report));
  }
}

/// Reports failures on standard error as well, for users who do not read the report.
int failed(const std::string& why) {
  complain("twin: " + why + "\n");
  return kFailed;
}

int runPoint(const SweepRequest& request, const Study& study, const std::atomic<bool>& stop) {
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
  print(request, study, point);
  return point.outcome.failure.empty()
             ? kDone
             : failed(fmt::format("point {}: {}", point.point, point.outcome.failure));
}

/// Progress bar for the points of these blocks.
SweepProgress progressOf(const Study& study, const std::vector<std::uint64_t>& blocks,
                         bool insist) {
  std::uint64_t of = 0;
  for (const std::uint64_t block : blocks) {
    of += study.sizeOf(block);
  }
  const auto bar = std::make_shared<ProgressBar>(fmt::format("{} points", of),
                                                 static_cast<std::int64_t>(of), false, insist);
  return [bar](std::uint64_t done) { bar->show(static_cast<std::int64_t>(done)); };
}

/// A study without points.
int runOptimization(const SweepRequest& request, const Study& study,
                    const std::atomic<bool>& stop) {
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
  std::optional<ProgressBar> bar;
  const auto most = static_cast<std::int64_t>(study.optimization->evaluations);
  try {
    const Optimum optimum =
        optimize(study, chooseSteps(study), stop, [&](std::uint64_t evaluations) {
          if (!bar) {
            bar.emplace(fmt::format("at most {} evaluations", most), most, false, request.insist);
          }
          bar->show(static_cast<std::int64_t>(evaluations));
        });
    bar.reset();
    print(request, study, optimum);
    return optimum.values.empty() ? failed("optimize: no point satisfies the requirements") : kDone;
  } catch (const Interrupted&) {
    throw RunFailure("interrupted");
  }
}

void runAll(const SweepRequest& request, const Study& study, const ResultFolder& folder,
            std::atomic<bool>& stop) {
  const std::vector<std::uint64_t> blocks = unfinishedBlocks(study, folder, shareOf(request.part));
  if (blocks.empty()) {
    return;
  }
  const unsigned workers =
      request.workers > 0 ? request.workers : std::max(1U, std::thread::hardware_concurrency());
  BlockDeck deck(blocks);
  sweep(
      study, folder, static_cast<unsigned>(std::min<std::uint64_t>(workers, blocks.size())),
      [&](std::uint64_t) { return deck.next(); }, stop, progressOf(study, blocks, request.insist));
}

int tellAnswers(const SweepRequest& request, const Study& study, const ResultFolder& folder) {
  const Answers answers = answersOf(study, folder.merge());
  writeHdf5Results(study, folder, answers);
  print(request, study, answers);
  return answers.failures < answers.points
             ? kDone
             : failed(fmt::format("{}/failed.csv: all points failed", *request.output));
}

/// Number of processes that mpirun or srun has started together; 1: this one alone.
int ranksStarted() {
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    if (const char* const count = std::getenv(name)) {
      return std::atoi(count);
    }
  }
  const char* const count =
      std::getenv("PMIX_RANK") ? std::getenv("SLURM_STEP_NUM_TASKS") : nullptr;
  return count != nullptr ? std::atoi(count) : 1;
}

int sweepAmongRanks(const SweepRequest& request, std::atomic<bool>& stop) {
#ifdef WHIRL_TWIN_MPI
  Ranks ranks;
  try {
    if (!ranks.first()) {
      ranks.letTheFirstGoFirst();
      if (!std::filesystem::exists(*request.output + "/manifest.yaml")) {
        throw RunFailure(
            fmt::format("{}: not found: all ranks must see the same files", *request.output));
      }
    }
    const Study study = readStudy(request.study);
    if (study.optimization) {
      throw InputError(study.source + ": an optimization must run in one process, without mpirun");
    }
    const ResultFolder folder(*request.output, study, request.mixed);
    const unsigned workers = std::max(1U, request.workers);
    if (!ranks.first()) {
      ranks.work(study, folder, workers, stop);
      return kDone;
    }
    ranks.letTheFirstGoFirst();
    const std::vector<std::uint64_t> blocks = unfinishedBlocks(study, folder, {});
    ranks.lead(study, folder, workers, blocks, stop, progressOf(study, blocks, request.insist));
    return tellAnswers(request, study, folder);
  } catch (const std::exception& error) {
    if (ranks.first() || !interrupted()) {  // rank 0 reports an interrupt
      complain(fmt::format("twin: {}{}\n", ranks.first() ? "" : ranks.name() + ": ", error.what()));
    }
    ranks.end(dynamic_cast<const InputError*>(&error) != nullptr ? kBadInput : kFailed);
  }
#else
  static_cast<void>(request);
  static_cast<void>(stop);
  throw InputError(
      "built without MPI, needed for mpirun: run scripts/setup --studies, then build again");
#endif
}

int sweepStudy(const SweepRequest& request) {
  if (request.workers > 4096) {
    throw InputError(fmt::format("--workers: must be from 1 to 4096, found {}", request.workers));
  }
  static_cast<void>(shareOf(request.part));
  std::atomic<bool>& stop = catchInterrupts();
  std::signal(SIGXFSZ, SIG_IGN);  // the file size limit is handled like a full disk
  const bool whole = !request.point && !request.part && !request.merge && !request.status;
  if (whole && request.output && ranksStarted() > 1) {
    return sweepAmongRanks(request, stop);
  }
  const Study study = readStudy(request.study);
  if (study.optimization) {
    if (ranksStarted() > 1) {
      throw InputError(study.source + ": an optimization must run in one process, without mpirun");
    }
    return runOptimization(request, study, stop);
  }
  if (request.point) {
    return runPoint(request, study, stop);
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
    print(request, study, statusOf(study, folder));
    return kDone;
  }
  if (!request.merge) {
    runAll(request, study, folder, stop);
  }
  const StudyStatus status = statusOf(study, folder);
  if (request.part && status.done < study.points()) {
    print(request, study, status);
    return kDone;
  }
  if (status.done < study.points()) {
    throw RunFailure(fmt::format("{}: {} of {} points are done: run the other parts first",
                                 *request.output, status.done, study.points()));
  }
  return tellAnswers(request, study, folder);
}

}  // namespace

void addSweepCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("sweep", kSweepDescription);
  const auto request = std::make_shared<SweepRequest>();
  command.option("STUDY", request->study, "the study (YAML)").required().type("");
  command.option("--output", request->output, "folder of the results, created if missing")
      .type("FOLDER");
  command.option("--point", request->point, "run this point alone, from 0, and print it").type("I");
  command.option("--workers", request->workers, "threads; default: one per core, or one per rank")
      .type("N");
  command.option("--part", request->part, "run every N-th block, starting with the I-th")
      .type("I/N");
  command.flag("--merge", request->merge, "run nothing: merge the results of the parts");
  command.flag("--status", request->status, "run nothing: print the progress");
  command.flag("--mixed", request->mixed,
               "resume results of another version, compiler or processor");
  addJsonOption(command, request->json);
  addInsistOption(command, request->insist);
  command.footer(kSweepFooter);
  command.callback([request, &status] { status = sweepStudy(*request); });
}

}  // namespace whirl_twin
