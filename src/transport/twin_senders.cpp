#include "transport/twin_senders.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace whirl_twin {
namespace {

/// [s] that what was heard counts: some beats of each.
constexpr double kMemory = 5.0;
/// A twin that is started again in its place may overlap with the one that ends: that returns once.
constexpr std::size_t kTurns = 3;
constexpr std::size_t kMostSenders = 64;  // at a time

}  // namespace

TwinSenders::TwinSenders(std::string where, std::string remedy)
    : where_(std::move(where)), remedy_(std::move(remedy)) {}

void TwinSenders::take(const state::LoopStatistics& loop, double now) {
  if (loop.started == 0) {
    return;  // of before runs were told apart
  }
  while (!returns_.empty() && now - returns_.front() > kMemory) {
    returns_.pop_front();
  }
  for (auto one = heard_.begin(); one != heard_.end();) {
    one = now - one->second > kMemory ? heard_.erase(one) : std::next(one);
  }
  const Run run{loop.started, loop.sender};
  const bool known = heard_.count(run) > 0;
  if (!known && heard_.size() >= kMostSenders) {
    return;
  }
  if (known && run != last_ && returns_.size() < kMostSenders) {
    returns_.push_back(now);
  }
  heard_[run] = now;
  last_ = run;
}

std::string TwinSenders::trouble(double now) const {
  const auto turns = std::count_if(returns_.begin(), returns_.end(),
                                   [now](double at) { return now - at <= kMemory; });
  if (static_cast<std::size_t>(turns) < kTurns) {
    return "";
  }
  std::vector<std::string> names;
  for (const auto& [run, at] : heard_) {
    if (now - at <= kMemory) {
      names.push_back(run.second.empty() ? "a publisher without a name" : run.second);
    }
  }
  return fmt::format("{} twins on {}: {}; {}", names.size(), where_, fmt::join(names, " and "),
                     remedy_);
}

}  // namespace whirl_twin
