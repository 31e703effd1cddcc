// Looks for what takes long and no verdict waits for: the parameter nearest to the loss of
// stability, for systems that are quick to search (isQuickToSearch), the cross-coupling that a
// rotor bears, what a spread of its numbers does, and up to which amplitude the decrement holds.
// Beside the verdicts in a thread of its own that gives way to every other; or, where judgements
// are made at once, at once.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "analysis/validity.h"
#include "monitoring/judging.h"
#include "monitoring/parameter_margins.h"
#include "monitoring/spread_margin.h"

namespace whirl_twin {

class MarginSearch {
 public:
  MarginSearch(std::size_t systems, Judging::Mode mode);
  ~MarginSearch();
  MarginSearch(const MarginSearch&) = delete;
  MarginSearch& operator=(const MarginSearch&) = delete;

  /// A judgement passes by: what was found of its system, with its parameters, is put into it. It
  /// is looked for anew where the parameters have changed; of a linear system where its speed has
  /// by a hundredth, a second [simulated] apart at least; of any other every ten seconds.
  /// Members are beyond that decay slower than `slowest` [1/s].
  void take(Judgement& judgement, double slowest);

 private:
  struct Question {
    SharedSystem built;
    SteadyMotion motion;
    double speed = 0.0;  ///< [rad/s]
    double time = 0.0;   ///< [s], simulated
  };
  struct Answer {
    Question of;
    std::optional<ParameterMargin> nearest;
    std::optional<double> cross_coupling;  ///< [N/m]
    std::optional<SpreadMargin> spread;
    std::optional<DecrementAmplitude> decrement;
  };
  struct Seat {
    std::optional<Question> asked;  ///< last
    std::optional<Question> waiting;
    std::optional<Answer> answer;
  };

  static bool isNews(const std::optional<Question>& asked, const Question& now);
  std::optional<Answer> search(const Question& question) const;
  void run();

  std::mutex mutex_;  ///< of seats_, and of `ending_` where it is waited for
  std::condition_variable asked_;
  std::vector<Seat> seats_;
  std::size_t turn_ = 0;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace whirl_twin
