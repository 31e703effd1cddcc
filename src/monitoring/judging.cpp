#include "monitoring/judging.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace whirl_twin {
namespace {

constexpr double kRetryPeriod = 10.0;  // s, simulated, after an evaluation that failed

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Judging::Judging(const std::vector<SharedSystem>& systems, Mode mode,
                 std::vector<std::shared_ptr<const ClosedLoop>> loops)
    : waiting_(systems.size()) {
  loops.resize(systems.size());
  for (std::size_t i = 0; i < systems.size(); ++i) {
    seats_.push_back({systems[i], loops[i], nullptr});
    first_speeds_.emplace_back();
    try {
      seats_.back().judge = std::make_unique<SystemJudge>(systems[i], loops[i]);
      first_speeds_.back() = seats_.back().judge->speeds();
    } catch (const std::exception&) {  // the first judgement says why
      seats_.back().judge.reset();
    }
  }
  if (mode == Mode::kBeside) {
    thread_ = std::thread([this] { run(); });
  }
}

Judging::~Judging() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  asked_.notify_one();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Judging::ask(JudgementRequest request) {
  const std::size_t system = request.system;
  Waiting waiting{std::move(request), now()};
  if (!thread_.joinable()) {
    done_.push_back(judge(waiting, true));
    busy_ += now() - waiting.since;
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::optional<Waiting>& older = waiting_[system];
    waiting.complete = older && older->complete && older->request.built == waiting.request.built &&
                       older->request.loop == waiting.request.loop;
    waiting_[system] = std::move(waiting);
  }
  asked_.notify_one();
}

std::vector<Judgement> Judging::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(done_, {});
}

bool Judging::pending() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return judging_ || !done_.empty() ||
         std::any_of(waiting_.begin(), waiting_.end(), [](const auto& w) { return w.has_value(); });
}

double Judging::busy() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return busy_;
}

Judgement Judging::judge(const Waiting& waiting, bool complete) {
  const JudgementRequest& request = waiting.request;
  Seat& seat = seats_[request.system];
  if (seat.built != request.built || seat.loop != request.loop) {
    seat = {request.built, request.loop, nullptr};
  }
  Judgement judgement;
  judgement.system = request.system;
  judgement.run = request.run;
  judgement.arrived_at = request.arrived_at;
  judgement.built = request.built;
  judgement.speed = request.speed;
  judgement.of_loop = seat.loop != nullptr;
  const double since = request.at.time - seat.failed_at;
  if (seat.failure.empty() || since < 0.0 || since >= kRetryPeriod) {
    try {
      evaluate(seat, waiting, complete || !seat.failure.empty(), judgement);
      seat.failure.clear();
    } catch (const std::exception& failure) {
      seat.failure = failure.what();
      seat.failed_at = request.at.time;
      seat.judge.reset();
    }
  }
  if (!seat.failure.empty()) {
    judgement.failure = seat.failure;
    judgement.motion.reset();
    judgement.speeds.reset();
    judgement.loop.clear();
    judgement.margin = uncertainMargin(*request.built, request.at, request.q, request.speed);
  }
  judgement.margin.age = now() - waiting.since;
  for (state::ControllerMargins& margins : judgement.loop) {
    margins.age = judgement.margin.age;
  }
  return judgement;
}

void Judging::evaluate(Seat& seat, const Waiting& waiting, bool complete, Judgement& judgement) {
  const JudgementRequest& request = waiting.request;
  if (!seat.judge) {
    seat.judge = std::make_unique<SystemJudge>(request.built, request.loop);
  }
  judgement.margin = seat.judge->judge(request.at, request.q, request.v, request.speed,
                                       request.beside, request.acceleration);
  judgement.failure = seat.judge->failure();
  judgement.motion = seat.judge->motion();
  if (complete && seat.judge->isPartial()) {
    seat.judge->complete(request.speed, judgement.margin);
  }
  if (!seat.judge->isPartial()) {
    judgement.speeds = seat.judge->speeds();
  }
  judgement.loop = seat.judge->loopMargins(request.at);
}

void Judging::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    std::optional<Waiting> waiting = next();
    if (ending_) {
      return;
    }
    if (!waiting) {
      asked_.wait(lock);
      continue;
    }
    judging_ = true;
    lock.unlock();
    const double begun = now();
    Judgement judgement = judge(*waiting, waiting->complete);
    const double taken = now() - begun;
    lock.lock();
    judging_ = false;
    busy_ += taken;
    std::optional<Waiting>& newer = waiting_[judgement.system];
    if (!judgement.speeds &&
        seats_[judgement.system]
            .failure.empty()) {  // they come with the next turn, about the newest state
      if (!newer) {
        newer = std::move(waiting);
      }
      newer->complete = newer->request.built == judgement.built;
    }
    done_.push_back(std::move(judgement));
  }
}

std::optional<Judging::Waiting> Judging::next() {
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const std::size_t system = (turn_ + i) % waiting_.size();
    if (waiting_[system]) {
      turn_ = system + 1;
      return std::exchange(waiting_[system], std::nullopt);
    }
  }
  return std::nullopt;
}

}  // namespace whirl_twin
