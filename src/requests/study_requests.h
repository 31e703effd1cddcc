// What is requested of a study: the points of a sweep or its optimum, the fit to measured runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "requests/document.h"
#include "requests/work_progress.h"
#include "studies/result_folder.h"
#include "studies/study.h"
#include "studies/sweep.h"
#include "transport/channels.h"

namespace whirl_twin {

/// The arguments of `twin sweep`.
struct SweepRequest {
  std::optional<std::string> output;   ///< folder of the results
  std::optional<std::uint64_t> point;  ///< run this point alone
  std::optional<std::string> part;     ///< as typed, "3/16"
  unsigned workers = 0;                ///< threads; 0: one for each core
  bool merge = false;
  bool status = false;
  bool mixed = false;
  bool insist = false;
  bool with_points = false;  ///< the document has a table of all points
};

/// Progress for the points of these blocks.
SweepProgress sweepProgress(const Study& study, const std::vector<std::uint64_t>& blocks,
                            bool insist, WorkProgress& progress);

/// Throws InputError for options that exclude each other or are out of range.
void requireSweepUse(const SweepRequest& request);

/// Runs the study, resumes it, or reports on its results, as requested. Throws InputError, and
/// RunFailure if it is interrupted or its results cannot be written.
Document sweepDocument(const Study& study, const SweepRequest& request, WorkProgress& progress);

/// Statistics of a study of which all points are done.
Document sweepAnswers(const Study& study, const ResultFolder& folder, const SweepRequest& request);

/// The arguments of `twin fit`.
struct FitRequest {
  std::optional<std::string> output;  ///< path for the scene with the values found
  std::string lcm_prefix = kDefaultLcmPrefix;
  bool validate_only = false;  ///< only the starts of the windows are fitted
  bool check = false;          ///< nothing is fitted: what is odd about the runs
  bool insist = false;
};

/// `study`: path. Throws InputError, and RunFailure where no fit can be computed.
Document fitDocument(const std::string& study, const FitRequest& request, WorkProgress& progress);

}  // namespace whirl_twin
