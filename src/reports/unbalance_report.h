// What `twin balance --measured` shows: the unbalance of a running rotor from a log, the masses
// that cancel it, and what is not identifiable from the log.
#pragma once

#include <string>
#include <vector>

#include "estimation/unbalance_fit.h"
#include "reports/csv_table.h"
#include "reports/rotor_record.h"
#include "reports/rotor_systems.h"

namespace whirl_twin {

struct UnbalanceRequest {
  std::vector<std::string> planes;  ///< stations; none: those that the model's unbalances are at
  bool run_out_known = false;       ///< that of the scene's sensors, none where they say nothing
  double from = 0.0;                ///< [rad/s], of the speeds that are used
  double to = 1.0e6;
};

struct UnbalanceReport {
  const RotorSystem* system = nullptr;
  std::string log;
  std::vector<std::string> planes, probes;
  double phase_mark = 0.0;  ///< [rad], on the shaft: angles count from it
  RecordCounts counts;
  UnbalanceEstimate estimate;
  std::vector<std::string> notes;  ///< what is not identifiable from the log
};

/// Throws InputError for a plane that there is not and where no sample is within the speeds.
UnbalanceReport unbalanceReport(const RotorSystem& system, const RotorRecord& record,
                                const UnbalanceRequest& request);

Json json(const UnbalanceReport& report);
std::string text(const UnbalanceReport& report);
/// The masses to add; run-outs of the probes.
CsvTables tables(const UnbalanceReport& report);

}  // namespace whirl_twin
