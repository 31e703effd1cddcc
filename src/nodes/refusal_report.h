// Reports rejected payloads in the diagnostics and the log of a node.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <vector>

#include "nodes/rising_count.h"
#include "transport/refused_payloads.h"

namespace whirl_twin {

class RefusalReport {
 public:
  /// Adds the diagnostics "LCM payloads" for these objects, which must outlive it; null ones are
  /// ignored.
  RefusalReport(diagnostic_updater::Updater& diagnostics, std::vector<const RefusedPayloads*> all);
  RefusalReport(const RefusalReport&) = delete;
  RefusalReport& operator=(const RefusalReport&) = delete;

 private:
  void summarize(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::vector<const RefusedPayloads*> all_;
  std::uint64_t logged_ = 0;
  double last_line_ = -1.0e9;  // [s], a monotonic clock
  RisingCount rising_;
};

}  // namespace whirl_twin
