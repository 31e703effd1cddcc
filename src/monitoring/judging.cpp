#include "monitoring/judging.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

namespace whirl_twin {
namespace {

constexpr double kRetryPeriod = 10.0;  // s, simulated, after an evaluation that failed
constexpr double kOthersWait = 0.2;    // s, for one evaluation
constexpr double kMostBetween = 0.1;   // s, that count between two looks at what is being made
constexpr std::size_t kFurtherThreads = 2;
constexpr std::chrono::seconds kPatienceAtEnd{1};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string tookTooLong() {
  return fmt::format("its evaluation takes longer than {:g} s", kLongestEvaluation);
}

}  // namespace

Judging::Judging(const std::vector<SharedSystem>& systems, Mode mode,
                 std::vector<std::shared_ptr<const ClosedLoop>> loops)
    : beside_(mode == Mode::kBeside), watched_at_(now()) {
  loops.resize(systems.size());
  desk_->waiting.resize(systems.size());
  desk_->first_speeds.resize(systems.size());
  for (std::size_t i = 0; i < systems.size(); ++i) {
    desk_->seats.push_back(std::make_shared<Seat>(Seat{systems[i], loops[i]}));
    if (beside_) {
      desk_->to_prepare.push_back(i);
    } else {
      desk_->first_speeds[i] = firstSpeeds(*desk_->seats[i]);
    }
  }
  std::unique_lock<std::mutex> lock(desk_->mutex);
  if (beside_) {
    startThread(desk_);
    const double end = watched_at_ + kLongestEvaluation;
    while ((!desk_->to_prepare.empty() || !desk_->running.empty()) && now() < end) {
      desk_->answered.wait_for(lock, std::chrono::milliseconds(20));
      watch();
    }
  }
  first_speeds_ = desk_->first_speeds;
}

Judging::~Judging() {
  std::unique_lock<std::mutex> lock(desk_->mutex);
  desk_->ending = true;
  desk_->asked.notify_all();
  desk_->answered.wait_for(lock, kPatienceAtEnd, [this] { return desk_->threads == 0; });
}

void Judging::ask(JudgementRequest request) {
  const std::size_t system = request.system;
  Waiting waiting{std::move(request), now()};
  const std::lock_guard<std::mutex> lock(desk_->mutex);
  if (!beside_) {
    Seat& seat = *desk_->seats[system];
    desk_->done.push_back(judge(seat, waiting, true));
    desk_->busy += now() - waiting.since;
    return;
  }
  const std::optional<Waiting>& older = desk_->waiting[system];
  waiting.complete = older && older->complete && older->request.built == waiting.request.built &&
                     older->request.loop == waiting.request.loop;
  desk_->waiting[system] = std::move(waiting);
  desk_->asked.notify_one();
}

std::vector<Judgement> Judging::take() {
  const std::lock_guard<std::mutex> lock(desk_->mutex);
  watch();
  return std::exchange(desk_->done, {});
}

bool Judging::pending() {
  const std::lock_guard<std::mutex> lock(desk_->mutex);
  const auto awaited = [](const auto& one) { return one->taken <= kLongestEvaluation; };
  return !desk_->done.empty() ||
         std::any_of(desk_->running.begin(), desk_->running.end(), awaited) ||
         std::any_of(desk_->waiting.begin(), desk_->waiting.end(),
                     [](const auto& waiting) { return waiting.has_value(); });
}

double Judging::busy() {
  const std::lock_guard<std::mutex> lock(desk_->mutex);
  return desk_->busy;
}

void Judging::watch() {
  const double time = now();
  const double passed = std::min(time - std::exchange(watched_at_, time), kMostBetween);
  bool others_wait = !desk_->running.empty();
  for (const std::shared_ptr<Evaluation>& one : desk_->running) {
    one->taken += passed;
    others_wait = others_wait && one->taken > kOthersWait;
    std::optional<Waiting>& newer = desk_->waiting[one->system];
    if (one->left || one->taken <= kLongestEvaluation || !newer) {
      continue;
    }
    const JudgementRequest& request = newer->request;
    const SharedSystem& built = one->of ? one->of->request.built : one->seat->built;
    const bool same = built == request.built && (!one->of || one->of->request.loop == request.loop);
    if (same || desk_->threads >= desk_->seats.size() + kFurtherThreads) {
      desk_->done.push_back(uncertain(*std::exchange(newer, std::nullopt), tookTooLong()));
    } else {  // its other parameters are another matter
      one->left = true;
      desk_->seats[one->system] = std::make_shared<Seat>(Seat{request.built, request.loop});
      desk_->asked.notify_one();
    }
  }
  if (others_wait && desk_->running.size() == desk_->threads &&
      desk_->threads < desk_->seats.size() + kFurtherThreads) {
    startThread(desk_);
  }
}

JudgedSpeeds Judging::firstSpeeds(Seat& seat) {
  try {
    seat.judge = std::make_unique<SystemJudge>(seat.built, seat.loop);
    return seat.judge->speeds();
  } catch (const std::exception&) {  // the first judgement says why
    seat.judge.reset();
    return {};
  }
}

Judgement Judging::uncertain(const Waiting& waiting, const std::string& why) {
  const JudgementRequest& request = waiting.request;
  Judgement judgement;
  judgement.system = request.system;
  judgement.run = request.run;
  judgement.arrived_at = request.arrived_at;
  judgement.built = request.built;
  judgement.speed = request.speed;
  judgement.of_loop = request.loop != nullptr;
  judgement.failure = why;
  judgement.margin = uncertainMargin(*request.built, request.at, request.q, request.speed);
  judgement.margin.age = now() - waiting.since;
  return judgement;
}

Judgement Judging::judge(Seat& seat, const Waiting& waiting, bool complete) {
  const JudgementRequest& request = waiting.request;
  if (seat.built != request.built || seat.loop != request.loop) {
    seat = {request.built, request.loop};
  }
  const double since = request.at.time - seat.failed_at;
  if (seat.failure.empty() || since < 0.0 || since >= kRetryPeriod) {
    try {
      Judgement judgement = uncertain(waiting, "");
      evaluate(seat, waiting, complete || !seat.failure.empty(), judgement);
      seat.failure.clear();
      judgement.margin.age = now() - waiting.since;
      for (state::ControllerMargins& margins : judgement.loop) {
        margins.age = judgement.margin.age;
      }
      return judgement;
    } catch (const std::exception& failure) {
      seat.failure = failure.what();
      seat.failed_at = request.at.time;
      seat.judge.reset();
    }
  }
  return uncertain(waiting, seat.failure);
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

void Judging::startThread(const std::shared_ptr<Desk>& desk) {
  ++desk->threads;
  std::thread([desk] { run(desk); }).detach();
}

void Judging::run(const std::shared_ptr<Desk>& desk) {
  std::unique_lock<std::mutex> lock(desk->mutex);
  // One thread at most waits for work: who comes back late is not needed any more.
  while (!desk->ending && desk->threads - desk->running.size() <= 1) {
    const std::shared_ptr<Evaluation> one = desk->next();
    if (!one) {
      desk->asked.wait(lock);
      continue;
    }
    desk->running.push_back(one);
    lock.unlock();
    const double begun = now();
    std::optional<Judgement> judgement;
    JudgedSpeeds first;
    if (one->of) {
      judgement = judge(*one->seat, *one->of, one->of->complete);
    } else {
      first = firstSpeeds(*one->seat);
    }
    const double taken = now() - begun;
    lock.lock();
    desk->busy += taken;
    desk->running.erase(std::find(desk->running.begin(), desk->running.end(), one));
    if (!one->left && judgement) {
      desk->finish(*one, std::move(*judgement));
    } else if (!one->left) {
      desk->first_speeds[one->system] = std::move(first);
    }
    desk->answered.notify_all();
  }
  --desk->threads;
  desk->asked.notify_one();  // whom it leaves its work to
  desk->answered.notify_all();
}

void Judging::Desk::finish(const Evaluation& made, Judgement judgement) {
  Seat& seat = *made.seat;
  if (made.taken > kLongestEvaluation) {  // about a state of long ago
    auto speeds = std::move(judgement.speeds);
    judgement = uncertain(*made.of, tookTooLong());
    if (!speeds) {  // else it goes faster from now on
      seat.failure = judgement.failure;
      seat.failed_at = made.of->request.at.time;
    }
    judgement.speeds = std::move(speeds);
  } else if (!judgement.speeds && seat.failure.empty()) {
    // They come with the next turn, about the newest state.
    std::optional<Waiting>& newer = waiting[made.system];
    if (!newer) {
      newer = made.of;
    }
    newer->complete = newer->request.built == judgement.built;
  }
  done.push_back(std::move(judgement));
}

bool Judging::Desk::isBusy(std::size_t system) const {
  return std::any_of(running.begin(), running.end(),
                     [&](const auto& one) { return one->system == system && !one->left; });
}

std::shared_ptr<Judging::Evaluation> Judging::Desk::next() {
  if (!to_prepare.empty()) {
    const std::size_t system = to_prepare.front();
    to_prepare.erase(to_prepare.begin());
    return std::make_shared<Evaluation>(Evaluation{system, seats[system], std::nullopt});
  }
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    const std::size_t system = (turn + i) % waiting.size();
    if (waiting[system] && !isBusy(system)) {
      turn = system + 1;
      return std::make_shared<Evaluation>(
          Evaluation{system, seats[system], std::exchange(waiting[system], std::nullopt)});
    }
  }
  return nullptr;
}

}  // namespace whirl_twin
