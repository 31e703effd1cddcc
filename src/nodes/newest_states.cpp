#include "nodes/newest_states.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace whirl_twin {

NewestStates::NewestStates(std::chrono::microseconds period,
                           std::function<void(const Message&)> tell,
                           std::function<std::int64_t()> now)
    : period_(period), tell_(std::move(tell)), now_(std::move(now)), told_(now_()) {}

void NewestStates::take(const Message& message, std::int64_t arrived) {
  std::visit(
      [&](const auto& state) {
        using State = std::decay_t<decltype(state)>;
        if (period_.count() == 0 || !State::kKind.has(MessageKind::kSeries)) {
          tellAll();
          return tell(message, arrived);
        }
        const auto [place, is_new] =
            kept_.insert_or_assign({&State::kKind, subjectOf(state)}, Kept{message, arrived});
        left_out_ += is_new ? 0 : 1;
      },
      message);
}

void NewestStates::tellDue() {
  if (now_() - told_ >= period_.count()) {
    tellAll();
    told_ = now_();
  }
}

std::chrono::microseconds NewestStates::nextDue(std::chrono::microseconds longest) const {
  const std::chrono::microseconds left(told_ + period_.count() - now_());
  return kept_.empty() ? longest : std::clamp(left, std::chrono::microseconds(1), longest);
}

void NewestStates::tellAll() {
  for (const auto& [whose, kept] : kept_) {
    tell(kept.message, kept.arrived);
  }
  kept_.clear();
}

void NewestStates::tell(const Message& message, std::int64_t arrived) {
  tell_(message);
  latency_.add(1000 * (now_() - arrived));
}

}  // namespace whirl_twin
