#include "studies/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "messages/input_error.h"
#include "studies/block_evaluator.h"

namespace whirl_twin {

namespace {

constexpr std::chrono::milliseconds kStopPollPeriod{100};

class Workers {
 public:
  Workers(const Study& study, const ResultFolder& folder, const BlockDealer& dealer,
          std::atomic<bool>& stop)
      : study_(study), folder_(folder), dealer_(dealer), stop_(stop) {}

  void run(unsigned count, const SweepProgress& progress) {
    running_ = count;
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < count; ++i) {
      threads.emplace_back([this] { work(); });
    }
    const auto join = [&] {
      for (std::thread& thread : threads) {
        thread.join();
      }
    };
    try {
      std::unique_lock<std::mutex> lock(mutex_);
      while (!ended_.wait_for(lock, kStopPollPeriod, [this] { return running_ == 0; })) {
        lock.unlock();
        progress(done_.load());
        lock.lock();
      }
    } catch (...) {  // an exception of progress() ends the sweep
      stop_.store(true);
      join();
      throw;
    }
    join();
    if (error_) {
      std::rethrow_exception(error_);
    }
    progress(done_.load());
  }

 private:
  void work() {
    try {
      BlockEvaluator evaluator(study_, folder_.steps(), stop_);
      while (const auto block = dealer_(done_.load())) {
        runBlock(*block, evaluator);
      }
    } catch (const Interrupted&) {  // the caller reports it
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!error_) {
        error_ = std::current_exception();
      }
      stop_.store(true);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    --running_;
    ended_.notify_one();
  }

  void runBlock(std::uint64_t block, BlockEvaluator& evaluator) {
    const std::vector<Outcome> outcomes =
        evaluator.outcomes(block, [this](std::uint64_t more) { done_ += more; });
    for (std::size_t i = 0; study_.stop_at_failure && i < outcomes.size(); ++i) {
      if (!outcomes[i].failure.empty()) {
        throw RunFailure(
            fmt::format("point {}: {}", study_.firstOf(block) + i, outcomes[i].failure));
      }
    }
    folder_.write(block, outcomes);
  }

  const Study& study_;
  const ResultFolder& folder_;
  const BlockDealer& dealer_;
  std::atomic<bool>& stop_;
  std::atomic<std::uint64_t> done_{0};
  std::mutex mutex_;
  std::condition_variable ended_;
  unsigned running_ = 0;
  std::exception_ptr error_;
};

}  // namespace

std::vector<std::uint64_t> unfinishedBlocks(const Study& study, const ResultFolder& folder,
                                            const Share& share) {
  const std::vector<bool> finished = folder.finished();
  std::vector<std::uint64_t> blocks;
  for (std::uint64_t block = share.part; block < study.blocks(); block += share.parts) {
    if (!finished[block]) {
      blocks.push_back(block);
    }
  }
  return blocks;
}

void sweep(const Study& study, const ResultFolder& folder, unsigned workers,
           const BlockDealer& dealer, std::atomic<bool>& stop, const SweepProgress& progress) {
  Workers(study, folder, dealer, stop).run(workers, progress);
  if (stop.load()) {
    throw RunFailure(fmt::format("interrupted; finished points are in {}: the same command resumes",
                                 folder.path()));
  }
}

}  // namespace whirl_twin
