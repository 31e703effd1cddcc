// How far a run has come: a bar with the time left, on standard error where a person watches it
// (a terminal that is not also the one the results go to), else a line where it takes more than ten
// seconds. What will take more than a day, as its first second tells, is refused.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace whirl_twin {

class ProgressBar {
 public:
  /// `asked`, so many steps: the number that makes it long, "--duration: 100 s".
  /// results_on_standard_output: rows scroll by there while the run goes on. `insist`: whatever it
  /// takes.
  ProgressBar(std::string asked, std::int64_t steps, bool results_on_standard_output, bool insist);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// So many are done. Returns after how many more to show it again. Throws Refusal, see above.
  std::int64_t show(std::int64_t step);
  /// Takes the bar away, for a message or the end.
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

}  // namespace whirl_twin
