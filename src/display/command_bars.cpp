#include "display/command_bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "display/scale_bar.h"
#include "mechanics/round_number.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMostBars = 6;  // bars of a system
constexpr Color kBar{0.30F, 0.58F, 0.86F};
constexpr Color kAtLimit{0.80F, 0.20F, 0.17F};
constexpr Color kMiddle{0.80F, 0.83F, 0.87F};

}  // namespace

void LiveController::take(const ControllerState& state, double limit) {
  const std::size_t outputs = state.output.size();
  if (state.input.size() != outputs || state.input_unit.size() != outputs) {
    return;  // of somebody else
  }
  state_ = state;
  limit_ = limit;
  largest_.resize(state.output.size(), 0.0);
  for (std::size_t i = 0; i < largest_.size(); ++i) {
    if (std::isfinite(state.output[i])) {
      largest_[i] = std::max(largest_[i], std::fabs(state.output[i]));
    }
  }
}

std::vector<Command> LiveController::commandsOn(const std::string& system) const {
  std::vector<Command> commands;
  for (std::size_t i = 0; i < largest_.size(); ++i) {
    const std::string& input = state_.input[i];
    if (input.rfind(system + ".", 0) != 0) {
      continue;
    }
    Command command;
    command.input = input.substr(system.size() + 1);
    command.unit = state_.input_unit[i];
    command.value = state_.output[i];
    if (std::isfinite(limit_)) {
      command.end = limit_;
      command.at_limit = std::fabs(command.value) >= limit_ * (1.0 - 1.0e-9);
    } else if (largest_[i] > 0.0) {
      command.end = 1.0 / roundDown125(1.0 / largest_[i]);
    }
    commands.push_back(command);
  }
  return commands;
}

std::string LiveController::loopText() const {
  if (!margins_ || !std::isfinite(margins_->sensitivity_peak)) {
    return margins_ && margins_->zone == "unbounded" ? "loop " + margins_->verdict_name : "";
  }
  std::string text =
      fmt::format("sensitivity {:.3g}, zone {}", margins_->sensitivity_peak, margins_->zone);
  if (margins_->saturated > 0.0) {
    text += fmt::format("; {:.0f} % saturated", 100.0 * margins_->saturated);
  }
  return text;
}

std::string commandText(const Command& command) {
  return fmt::format("{} {:.3g} of {:.3g} {}", command.input, command.value, command.end,
                     command.unit);
}

double drawCommands(const std::vector<Command>& commands, const std::vector<std::string>& loops,
                    bool compact, double y, MarkerCanvas& board) {
  const double height = compact ? 0.07 : 0.04;  // m
  const double words = compact ? 0.0 : 0.058;   // m, of a line of them
  const double room = compact ? 0.04 : 0.03;    // m, between
  for (std::size_t i = 0; i < kMostBars; ++i) {
    const bool shown = i < commands.size();
    const Command command = shown ? commands[i] : Command{};
    const double place =
        0.5 + 0.5 * (std::isfinite(command.value) ? command.value : 0.0) / command.end;
    ScaleBar bar("command", y + 0.5 * height, height, board);
    bar.range("track", 0.0, shown ? 1.0 : 0.0, kTrackColor, 0);
    bar.range("bar", std::min(0.5, place), shown ? std::max(0.5, place) : 0.0,
              command.at_limit ? kAtLimit : kBar, 1);
    bar.range("middle", 0.498, shown ? 0.502 : 0.0, kMiddle, 2);
    board.text("command_caption", {0.0, y + height + 0.7 * words, 0.03}, words,
               shown && !compact ? commandText(command) : "", kWordsColor);
    y += shown ? height + 1.4 * words + room : 0.0;
  }
  for (std::size_t i = 0; i < kMostBars; ++i) {
    const bool shown = i < loops.size() && !compact;
    board.text("loop_caption", {0.0, y + 0.7 * words, 0.03}, words, shown ? loops[i] : "",
               kWordsColor);
    y += shown ? 1.2 * words : 0.0;
  }
  return y + (commands.empty() ? 0.0 : room);
}

}  // namespace whirl_twin
