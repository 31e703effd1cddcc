#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

#include "analysis/cross_coupling_margin.h"
#include "analysis/routh.h"
#include "monitoring/evaluation_queue.h"

namespace whirl_twin {

namespace {

constexpr double kMinSearchPeriod = 1.0;       // s, simulated, of a linear system
constexpr double kMaxSearchPeriod = 10.0;      // s, simulated, of any other
constexpr std::chrono::minutes kMaxSearch{1};  // others wait for it
constexpr int kLowestPriority = 19;            // a nice value

}  // namespace

StabilityBoundarySearch::StabilityBoundarySearch(std::size_t systems, EvaluationQueue::Mode mode)
    : slots_(systems) {
  if (mode == EvaluationQueue::Mode::kConcurrent) {
    thread_ = std::thread([this] { run(); });
  }
}

StabilityBoundarySearch::~StabilityBoundarySearch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  requested_.notify_one();
  if (thread_.joinable()) {
    thread_.join();
  }
}

bool StabilityBoundarySearch::isNews(const std::optional<Question>& searched, const Question& now) {
  if (!searched || searched->built != now.built || now.time < searched->time) {
    return true;
  }
  const double since = now.time - searched->time;
  if (!now.built->dynamics->linear()) {  // it takes longer, and its steady motion may have moved
    return since >= kMaxSearchPeriod;
  }
  const bool faster =
      std::fabs(now.speed - searched->speed) > kSpeedNews * std::fabs(searched->speed);
  return faster && since >= kMinSearchPeriod;
}

void StabilityBoundarySearch::addTo(StabilityResult& result, double slowest) {
  state::StabilityMargin& margin = result.margin;
  const auto verdict = static_cast<Verdict>(margin.verdict);
  const bool stable = verdict == Verdict::kAsymptoticallyStable || verdict == Verdict::kMarginal;
  if (!stable || !result.motion) {
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  Slot& slot = slots_[result.request.system];
  const Question now{result.request.built, *result.motion, result.request.speed, margin.at.time};
  if (isNews(slot.searched, now)) {
    slot.searched = now;
    if (thread_.joinable()) {
      slot.pending = now;
      requested_.notify_one();
    } else {
      slot.answer = search(now);
    }
  }
  if (!slot.answer || slot.answer->of.built != now.built || slot.answer->of.time > now.time) {
    return;
  }
  const Answer& found = *slot.answer;
  margin.nearest_time = found.of.time;
  margin.cross_coupling_margin = found.cross_coupling.value_or(margin.cross_coupling_margin);
  if (found.spread) {
    margin.members = static_cast<std::uint32_t>(found.spread->decay_rates.size());
    margin.members_beyond = static_cast<std::uint32_t>(found.spread->beyond(slowest));
    margin.lowest_decay_rate = found.spread->lowest_decay_rate;
    margin.stable_throughout = found.spread->stable_throughout;
  }
  if (found.decrement) {
    margin.log_decrement_coordinate = found.decrement->coordinate;
    margin.log_decrement_amplitude = found.decrement->amplitude;
  }
  if (found.nearest) {
    margin.nearest_parameter = found.nearest->parameter;
    margin.nearest_change = found.nearest->change;
    margin.nearest_value = found.nearest->loss.value;
    margin.nearest_loss = lossName(found.nearest->loss.kind, *now.built->dynamics);
    margin.nearest_frequency = found.nearest->loss.frequency;
  }
}

std::optional<StabilityBoundarySearch::Answer> StabilityBoundarySearch::search(
    const Question& question) const {
  Answer answer{question, std::nullopt, std::nullopt, std::nullopt, std::nullopt};
  const auto end = std::chrono::steady_clock::now() + kMaxSearch;
  const auto given_up = [this, end] {
    return ending_.load() || (thread_.joinable() && std::chrono::steady_clock::now() > end);
  };
  try {
    if (isQuickToSearch(*question.built)) {
      answer.nearest =
          nearestInstability(*question.built, question.motion, question.speed, given_up);
    }
    if (question.built->spec.ensemble.count == 0) {
      answer.spread =
          robustStabilityMargin(*question.built, question.motion, question.speed, given_up);
    }
    if (isQuickToSearch(*question.built)) {
      answer.decrement =
          linearDampingLimit(*question.built->dynamics, question.motion, question.speed);
    }
    const auto margin = crossCouplingMarginOf(*question.built->dynamics, question.speed);
    answer.cross_coupling = margin ? margin->stiffness : std::nullopt;
  } catch (const std::exception&) {  // numbers beyond the range of double: nothing is known
    return std::nullopt;
  }
  return answer;
}

void StabilityBoundarySearch::run() {
  // Of this thread alone, as Linux has it. Where it is refused the search runs like any
  // other thread.
  static_cast<void>(setpriority(PRIO_PROCESS, 0, kLowestPriority));
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ending_) {
    std::optional<Question> question;
    std::size_t system = 0;
    for (std::size_t i = 0; i < slots_.size() && !question; ++i) {
      system = (turn_ + i) % slots_.size();
      question = std::exchange(slots_[system].pending, std::nullopt);
    }
    if (!question) {
      requested_.wait(lock);
      continue;
    }
    turn_ = system + 1;
    lock.unlock();
    std::optional<Answer> answer = search(*question);
    lock.lock();
    slots_[system].answer = std::move(answer);
  }
}

}  // namespace whirl_twin
