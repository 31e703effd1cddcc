#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>

#include "messages/input_error.h"
#include "reports/output.h"
#include "requests/study_requests.h"
#include "studies/ranks.h"
#include "studies/study_reader.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "tools/progress_bar.h"
#include "tools/report_options.h"

namespace whirl_twin {

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

struct SweepOptions {
  std::string study;
  bool json = false;
  SweepRequest request;
};

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

int sweepAmongRanks(const SweepOptions& options) {
  const SweepRequest& request = options.request;
  TerminalProgress progress(false);
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
    const Study study = readStudy(options.study);
    if (study.optimization) {
      throw InputError(study.source + ": an optimization must run in one process, without mpirun");
    }
    const ResultFolder folder(*request.output, study, request.mixed);
    const unsigned workers = std::max(1U, request.workers);
    if (!ranks.first()) {
      ranks.work(study, folder, workers, progress.stop());
      return kDone;
    }
    ranks.letTheFirstGoFirst();
    const std::vector<std::uint64_t> blocks = unfinishedBlocks(study, folder, {});
    ranks.lead(study, folder, workers, blocks, progress.stop(),
               sweepProgress(study, blocks, request.insist, progress));
    progress.clear();
    return printDocument(sweepAnswers(study, folder, request), options.json, std::nullopt);
  } catch (const std::exception& error) {
    if (ranks.first() || !interrupted()) {  // rank 0 reports an interrupt
      complain(fmt::format("twin: {}{}\n", ranks.first() ? "" : ranks.name() + ": ", error.what()));
    }
    ranks.end(dynamic_cast<const InputError*>(&error) != nullptr ? kBadInput : kFailed);
  }
#else
  static_cast<void>(request);
  throw InputError(
      "built without MPI, needed for mpirun: run scripts/setup --studies, then build again");
#endif
}

int sweepStudy(const SweepOptions& options) {
  const SweepRequest& request = options.request;
  requireSweepUse(request);
  catchInterrupts();
  std::signal(SIGXFSZ, SIG_IGN);  // the file size limit is handled like a full disk
  const bool whole = !request.point && !request.part && !request.merge && !request.status;
  const bool among_ranks = ranksStarted() > 1;
  if (whole && request.output && among_ranks) {
    return sweepAmongRanks(options);
  }
  const Study study = readStudy(options.study);
  if (study.optimization && among_ranks) {
    throw InputError(study.source + ": an optimization must run in one process, without mpirun");
  }
  TerminalProgress progress(false);
  return printDocument(sweepDocument(study, request, progress), options.json, std::nullopt);
}

}  // namespace

void addSweepCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("sweep", kSweepDescription);
  const auto options = std::make_shared<SweepOptions>();
  SweepRequest* const request = &options->request;
  command.option("STUDY", options->study, "the study (YAML)").required().type("");
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
  addJsonOption(command, options->json);
  addInsistOption(command, request->insist);
  command.footer(kSweepFooter);
  command.callback([options, &status] { status = sweepStudy(*options); });
}

}  // namespace whirl_twin
