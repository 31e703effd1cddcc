// Progress of a run: a bar with the remaining time, on standard error if that is an interactive
// terminal (and not also the one that the results go to), else one line for a run of more than ten
// seconds. A run whose first second predicts more than a day is rejected.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "requests/work_progress.h"

namespace whirl_twin {

class ProgressBar {
 public:
  /// `asked`: the option that sets the run length, "--duration: 100 s"; `steps` in number.
  /// results_on_standard_output: rows are printed there during the run. `insist`: no limit on the
  /// run time.
  ProgressBar(std::string asked, std::int64_t steps, bool results_on_standard_output, bool insist);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `step` steps are done. Returns the number of steps until the next call. Throws InputError, see
  /// above.
  std::int64_t show(std::int64_t step);
  /// Removes the bar, for a message or at the end.
  void clear();

 private:
  void draw(double part, double left);

  std::string asked_;
  std::int64_t steps_;
  bool insist_;
  bool on_;
  bool drawn_ = false;
  bool judged_ = false;
  double start_;  ///< [s], of the processor
  std::chrono::steady_clock::time_point next_{};
};

/// A bar, and SIGINT and SIGTERM where the command catches them (tools/interrupt.h).
class TerminalProgress final : public WorkProgress {
 public:
  explicit TerminalProgress(bool results_on_standard_output)
      : results_on_standard_output_(results_on_standard_output) {}

  void begin(const std::string& asked, std::int64_t steps, bool insist) override;
  std::int64_t show(std::int64_t done) override { return bar_ ? bar_->show(done) : 1; }
  void clear() override;
  bool interrupted() override;
  std::atomic<bool>& stop() override;

 private:
  bool results_on_standard_output_;
  std::optional<ProgressBar> bar_;
};

}  // namespace whirl_twin
