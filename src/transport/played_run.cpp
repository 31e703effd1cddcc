#include "transport/played_run.h"

#include "transport/lcm_decode.h"

namespace whirl_twin {

bool PlayedRun::take(const Message& message) {
  const auto* const loop = std::get_if<state::LoopStatistics>(&message);
  if (loop != nullptr) {
    loop_ = *loop;
    told_ = true;
  }
  if (seriesStep(message)) {
    std::visit(
        [this](const auto& state) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(state)>, state::Alert>) {
            now_ = state.at;
          }
        },
        message);
    heard_ = true;
    if (jumped_) {
      jumped_ = false;
      // Two announcements, as who listens asks for; where there was none before, of what ends.
      if (!told_) {
        say(jumps_, 0);
      }
      ++jumps_;
      say(jumps_, 1);
      say(jumps_, 2);
    }
  }
  if (loop != nullptr && jumps_ > 0) {
    now_ = loop->at;
    say(jumps_, 0);
    return true;
  }
  return false;
}

void PlayedRun::hold(bool held) {
  loop_.paused = held;
  if (heard_) {
    say(jumps_, 0);
  }
}

/// later: a little, by which announcements differ [ns].
void PlayedRun::say(std::uint64_t epoch, std::int64_t later) {
  state::LoopStatistics said = loop_;
  said.at = now_;
  said.at.stamp += later;
  said.started = told_ ? loop_.started : started_;
  said.epoch += epoch;
  lcm_.publish(said);
}

}  // namespace whirl_twin
