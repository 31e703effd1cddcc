#include "monitoring/evaluation_queue.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

namespace whirl_twin {
namespace {

constexpr double kReevaluationPeriod = 10.0;  // s, simulated, after an evaluation that failed
constexpr double kOthersWait = 0.2;           // s, for one evaluation
constexpr double kMaxCheckPeriod = 0.1;       // s, that count between two checks
constexpr std::size_t kFurtherThreads = 2;
constexpr std::chrono::seconds kMaxJoin{1};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string tookTooLong() {
  return fmt::format("its evaluation takes longer than {:g} s", kMaxEvaluation);
}

}  // namespace

EvaluationQueue::EvaluationQueue(const std::vector<SharedSystem>& systems, Mode mode,
                                 std::vector<std::shared_ptr<const ClosedLoop>> loops)
    : concurrent_(mode == Mode::kConcurrent), checked_at_(now()) {
  loops.resize(systems.size());
  shared_->waiting.resize(systems.size());
  shared_->first_speeds.resize(systems.size());
  for (std::size_t i = 0; i < systems.size(); ++i) {
    shared_->slots.push_back(std::make_shared<Slot>(Slot{systems[i], loops[i]}));
    if (concurrent_) {
      shared_->to_prepare.push_back(i);
    } else {
      shared_->first_speeds[i] = firstSpeeds(*shared_->slots[i]);
    }
  }
  std::unique_lock<std::mutex> lock(shared_->mutex);
  if (concurrent_) {
    startThread(shared_);
    const double end = checked_at_ + kMaxEvaluation;
    while ((!shared_->to_prepare.empty() || !shared_->running.empty()) && now() < end) {
      shared_->finished.wait_for(lock, std::chrono::milliseconds(20));
      checkTimeouts();
    }
  }
  first_speeds_ = shared_->first_speeds;
}

EvaluationQueue::~EvaluationQueue() {
  std::unique_lock<std::mutex> lock(shared_->mutex);
  shared_->ending = true;
  shared_->requested.notify_all();
  shared_->finished.wait_for(lock, kMaxJoin, [this] { return shared_->threads == 0; });
}

void EvaluationQueue::add(EvaluationRequest request) {
  const std::size_t system = request.system;
  Pending waiting{std::move(request), now()};
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  if (!concurrent_) {
    Slot& slot = *shared_->slots[system];
    shared_->done.push_back(makeResult(slot, waiting, true));
    shared_->busy += now() - waiting.since;
    return;
  }
  const std::optional<Pending>& older = shared_->waiting[system];
  waiting.complete = older && older->complete && older->request.built == waiting.request.built &&
                     older->request.loop == waiting.request.loop;
  shared_->waiting[system] = std::move(waiting);
  shared_->requested.notify_one();
}

std::vector<StabilityResult> EvaluationQueue::take() {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  checkTimeouts();
  return std::exchange(shared_->done, {});
}

bool EvaluationQueue::pending() {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  const auto awaited = [](const auto& one) { return one->taken <= kMaxEvaluation; };
  return !shared_->done.empty() ||
         std::any_of(shared_->running.begin(), shared_->running.end(), awaited) ||
         std::any_of(shared_->waiting.begin(), shared_->waiting.end(),
                     [](const auto& waiting) { return waiting.has_value(); });
}

double EvaluationQueue::busy() {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  return shared_->busy;
}

void EvaluationQueue::checkTimeouts() {
  const double time = now();
  const double passed = std::min(time - std::exchange(checked_at_, time), kMaxCheckPeriod);
  bool others_wait = !shared_->running.empty();
  for (const std::shared_ptr<Evaluation>& one : shared_->running) {
    one->taken += passed;
    others_wait = others_wait && one->taken > kOthersWait;
    std::optional<Pending>& newer = shared_->waiting[one->system];
    if (one->left || one->taken <= kMaxEvaluation || !newer) {
      continue;
    }
    const EvaluationRequest& request = newer->request;
    const SharedSystem& built = one->of ? one->of->request.built : one->slot->built;
    const bool same = built == request.built && (!one->of || one->of->request.loop == request.loop);
    if (same || shared_->threads >= shared_->slots.size() + kFurtherThreads) {
      shared_->done.push_back(uncertain(*std::exchange(newer, std::nullopt), tookTooLong()));
    } else {  // its new parameters may be quicker
      one->left = true;
      shared_->slots[one->system] = std::make_shared<Slot>(Slot{request.built, request.loop});
      shared_->requested.notify_one();
    }
  }
  if (others_wait && shared_->running.size() == shared_->threads &&
      shared_->threads < shared_->slots.size() + kFurtherThreads) {
    startThread(shared_);
  }
}

CharacteristicSpeeds EvaluationQueue::firstSpeeds(Slot& slot) {
  try {
    slot.evaluator = std::make_unique<StabilityEvaluator>(slot.built, slot.loop);
    return slot.evaluator->speeds();
  } catch (const std::exception&) {  // the first result reports why
    slot.evaluator.reset();
    return {};
  }
}

StabilityResult EvaluationQueue::uncertain(const Pending& waiting, const std::string& why) {
  const EvaluationRequest& request = waiting.request;
  StabilityResult result;
  result.request = request;
  result.failure = why;
  result.margin = uncertainMargin(*request.built, request.at, request.q, request.speed);
  result.margin.age = now() - waiting.since;
  return result;
}

StabilityResult EvaluationQueue::makeResult(Slot& slot, const Pending& waiting, bool complete) {
  const EvaluationRequest& request = waiting.request;
  if (slot.built != request.built || slot.loop != request.loop) {
    slot = {request.built, request.loop};
  }
  const double since = request.at.time - slot.failed_at;
  if (slot.failure.empty() || since < 0.0 || since >= kReevaluationPeriod) {
    try {
      StabilityResult result = uncertain(waiting, "");
      evaluate(slot, waiting, complete || !slot.failure.empty(), result);
      slot.failure.clear();
      result.margin.age = now() - waiting.since;
      for (state::ControllerMargins& margins : result.loop) {
        margins.age = result.margin.age;
      }
      return result;
    } catch (const std::exception& failure) {
      slot.failure = failure.what();
      slot.failed_at = request.at.time;
      slot.evaluator.reset();
    }
  }
  return uncertain(waiting, slot.failure);
}

void EvaluationQueue::evaluate(Slot& slot, const Pending& waiting, bool complete,
                               StabilityResult& result) {
  const EvaluationRequest& request = waiting.request;
  if (!slot.evaluator) {
    slot.evaluator = std::make_unique<StabilityEvaluator>(request.built, request.loop);
  }
  result.margin = slot.evaluator->evaluate(request.at, request.q, request.v, request.speed,
                                           request.beside, request.acceleration);
  result.failure = slot.evaluator->failure();
  result.motion = slot.evaluator->motion();
  if (complete && slot.evaluator->isPartial()) {
    slot.evaluator->complete(request.speed, result.margin);
  }
  if (!slot.evaluator->isPartial()) {
    result.speeds = slot.evaluator->speeds();
  }
  result.loop = slot.evaluator->loopMargins(request.at);
}

void EvaluationQueue::startThread(const std::shared_ptr<Shared>& shared) {
  ++shared->threads;
  std::thread([shared] { run(shared); }).detach();
}

void EvaluationQueue::run(const std::shared_ptr<Shared>& shared) {
  std::unique_lock<std::mutex> lock(shared->mutex);
  // One thread at most waits for work: one that returns late is not needed any more.
  while (!shared->ending && shared->threads - shared->running.size() <= 1) {
    const std::shared_ptr<Evaluation> one = shared->next();
    if (!one) {
      shared->requested.wait(lock);
      continue;
    }
    shared->running.push_back(one);
    lock.unlock();
    const double begun = now();
    std::optional<StabilityResult> result;
    CharacteristicSpeeds first;
    if (one->of) {
      result = makeResult(*one->slot, *one->of, one->of->complete);
    } else {
      first = firstSpeeds(*one->slot);
    }
    const double taken = now() - begun;
    lock.lock();
    shared->busy += taken;
    shared->running.erase(std::find(shared->running.begin(), shared->running.end(), one));
    if (!one->left && result) {
      shared->finish(*one, std::move(*result));
    } else if (!one->left) {
      shared->first_speeds[one->system] = std::move(first);
    }
    shared->finished.notify_all();
  }
  --shared->threads;
  shared->requested.notify_one();  // which it leaves its work to
  shared->finished.notify_all();
}

void EvaluationQueue::Shared::finish(const Evaluation& made, StabilityResult result) {
  Slot& slot = *made.slot;
  if (made.taken > kMaxEvaluation) {  // about a state of long ago
    auto speeds = std::move(result.speeds);
    result = uncertain(*made.of, tookTooLong());
    if (!speeds) {  // else it goes faster from now on
      slot.failure = result.failure;
      slot.failed_at = made.of->request.at.time;
    }
    result.speeds = std::move(speeds);
  } else if (!result.speeds && slot.failure.empty()) {
    // They come with the next turn, about the newest state.
    std::optional<Pending>& newer = waiting[made.system];
    if (!newer) {
      newer = made.of;
    }
    newer->complete = newer->request.built == result.request.built;
  }
  done.push_back(std::move(result));
}

bool EvaluationQueue::Shared::isBusy(std::size_t system) const {
  return std::any_of(running.begin(), running.end(),
                     [&](const auto& one) { return one->system == system && !one->left; });
}

std::shared_ptr<EvaluationQueue::Evaluation> EvaluationQueue::Shared::next() {
  if (!to_prepare.empty()) {
    const std::size_t system = to_prepare.front();
    to_prepare.erase(to_prepare.begin());
    return std::make_shared<Evaluation>(Evaluation{system, slots[system], std::nullopt});
  }
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    const std::size_t system = (turn + i) % waiting.size();
    if (waiting[system] && !isBusy(system)) {
      turn = system + 1;
      return std::make_shared<Evaluation>(
          Evaluation{system, slots[system], std::exchange(waiting[system], std::nullopt)});
    }
  }
  return nullptr;
}

}  // namespace whirl_twin
