// How far a run has come, on standard error and only where a person watches it: on a terminal that
// is not also the one the results go to.
#pragma once

#include <chrono>
#include <cstdint>

namespace whirl_twin {

class ProgressBar {
 public:
  /// results_on_standard_output: rows scroll by there while the run goes on.
  ProgressBar(std::int64_t steps, bool results_on_standard_output);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(std::int64_t step);
  /// Takes the bar away, for a message or the end.
  void clear();

 private:
  std::int64_t steps_;
  bool on_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace whirl_twin
