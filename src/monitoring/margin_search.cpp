#include "monitoring/margin_search.h"

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

#include "analysis/cross_coupling_margin.h"
#include "analysis/routh.h"

namespace whirl_twin {

namespace {

constexpr double kShortestBreak = 1.0;             // s, simulated, of a linear system
constexpr double kLongestBreak = 10.0;             // s, simulated, of any other
constexpr std::chrono::minutes kLongestSearch{1};  // others wait for it
constexpr int kLowestPriority = 19;                // a nice value

}  // namespace

MarginSearch::MarginSearch(std::size_t systems, Judging::Mode mode) : seats_(systems) {
  if (mode == Judging::Mode::kBeside) {
    thread_ = std::thread([this] { run(); });
  }
}

MarginSearch::~MarginSearch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  asked_.notify_one();
  if (thread_.joinable()) {
    thread_.join();
  }
}

bool MarginSearch::isNews(const std::optional<Question>& asked, const Question& now) {
  if (!asked || asked->built != now.built || now.time < asked->time) {
    return true;
  }
  const double since = now.time - asked->time;
  if (!now.built->dynamics->linear()) {  // it takes longer, and its steady motion may have moved
    return since >= kLongestBreak;
  }
  const bool faster = std::fabs(now.speed - asked->speed) > kSpeedNews * std::fabs(asked->speed);
  return faster && since >= kShortestBreak;
}

void MarginSearch::take(Judgement& judgement, double slowest) {
  state::StabilityMargin& margin = judgement.margin;
  const auto verdict = static_cast<Verdict>(margin.verdict);
  const bool stable = verdict == Verdict::kAsymptoticallyStable || verdict == Verdict::kMarginal;
  if (!stable || !judgement.motion) {
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  Seat& seat = seats_[judgement.system];
  const Question now{judgement.built, *judgement.motion, judgement.speed, margin.at.time};
  if (isNews(seat.asked, now)) {
    seat.asked = now;
    if (thread_.joinable()) {
      seat.waiting = now;
      asked_.notify_one();
    } else {
      seat.answer = search(now);
    }
  }
  if (!seat.answer || seat.answer->of.built != now.built || seat.answer->of.time > now.time) {
    return;
  }
  const Answer& found = *seat.answer;
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

std::optional<MarginSearch::Answer> MarginSearch::search(const Question& question) const {
  Answer answer{question, std::nullopt, std::nullopt, std::nullopt, std::nullopt};
  const auto end = std::chrono::steady_clock::now() + kLongestSearch;
  const auto given_up = [this, end] {
    return ending_.load() || (thread_.joinable() && std::chrono::steady_clock::now() > end);
  };
  try {
    if (isQuickToSearch(*question.built)) {
      answer.nearest = nearestLoss(*question.built, question.motion, question.speed, given_up);
    }
    if (question.built->spec.ensemble.count == 0) {
      answer.spread = spreadMargin(*question.built, question.motion, question.speed, given_up);
    }
    if (isQuickToSearch(*question.built)) {
      answer.decrement =
          decrementAmplitude(*question.built->dynamics, question.motion, question.speed);
    }
    const auto margin = crossCouplingMarginOf(*question.built->dynamics, question.speed);
    answer.cross_coupling = margin ? margin->stiffness : std::nullopt;
  } catch (const std::exception&) {  // numbers beyond the range of double: nothing is known
    return std::nullopt;
  }
  return answer;
}

void MarginSearch::run() {
  // Of this thread alone, as Linux has it. Where it is refused the search takes part like any
  // other.
  static_cast<void>(setpriority(PRIO_PROCESS, 0, kLowestPriority));
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ending_) {
    std::optional<Question> question;
    std::size_t system = 0;
    for (std::size_t i = 0; i < seats_.size() && !question; ++i) {
      system = (turn_ + i) % seats_.size();
      question = std::exchange(seats_[system].waiting, std::nullopt);
    }
    if (!question) {
      asked_.wait(lock);
      continue;
    }
    turn_ = system + 1;
    lock.unlock();
    std::optional<Answer> answer = search(*question);
    lock.lock();
    seats_[system].answer = std::move(answer);
  }
}

}  // namespace whirl_twin
