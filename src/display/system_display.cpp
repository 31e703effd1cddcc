#include "display/system_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "display/layout.h"
#include "display/scales.h"
#include "display/status_text.h"
#include "mechanics/round_number.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxBars = 6;  // bars of a system
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
  for (std::size_t i = 0; i < kMaxBars; ++i) {
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
  for (std::size_t i = 0; i < kMaxBars; ++i) {
    const bool shown = i < loops.size() && !compact;
    board.text("loop_caption", {0.0, y + 0.7 * words, 0.03}, words, shown ? loops[i] : "",
               kWordsColor);
    y += shown ? 1.2 * words : 0.0;
  }
  return y + (commands.empty() ? 0.0 : room);
}

namespace {

constexpr Color kText{0.90F, 0.92F, 0.94F};
constexpr Color kLearned{0.55F, 0.85F, 1.0F};
constexpr double kHeadlineHeight = 0.095;  // m
constexpr double kLineHeight = 0.072;      // m
constexpr double kCompactHeadline = 0.17;  // m
constexpr double kCompactAlert = 0.13;     // m
constexpr std::size_t kLineOfPlace = 40;   // characters, about the width of a place
constexpr std::size_t kAlertsShown = 3;

}  // namespace

Color severityColor(int severity) {
  if (severity >= Alert::DANGER) {
    return {1.0F, 0.30F, 0.25F};
  }
  return severity == Alert::WARNING ? Color{1.0F, 0.72F, 0.15F} : Color{0.55F, 0.80F, 1.0F};
}

Color severityColor(const std::vector<Alert>& alerts, const Color& calm) {
  int highest = Alert::INFO;
  for (const auto& alert : alerts) {
    highest = std::max<int>(highest, alert.severity);
  }
  return highest == Alert::INFO ? calm : severityColor(highest);
}

void TextStack::add(const std::string& part, const std::vector<std::string>& lines, double height,
                    const Color& color) {
  const double block = static_cast<double>(lines.size()) * (height + 0.01);
  board_.text(part, foot_ + 0.5 * block * Eigen::Vector3d::UnitY(), height, joinedLines(lines),
              color);
  foot_.y() += lines.empty() ? 0.0 : block + 0.35 * height;
}

void drawStatus(const std::string& headline, const std::vector<std::string>& lines, double speed,
                const SystemStatus& status, const Eigen::Vector3d& foot, MarkerCanvas& canvas) {
  MarkerCanvas board = canvas.turned(foot, boardAxes());
  const double margins = drawInstruments(status.live, speed, status.compact, board);
  const double instruments =
      drawCommands(status.commands, status.loops, status.compact, margins, board);
  TextStack stack({0.0, instruments, 0.0}, board);
  const Color color = severityColor(status.alerts, kText);
  if (status.compact) {
    const std::string name =
        std::isfinite(speed) ? fmt::format("{}  {:.1f} rad/s", headline, speed) : headline;
    stack.add("text", {name}, kCompactHeadline, color);
    std::vector<std::string> alert;
    if (!status.alerts.empty()) {
      const std::size_t more = status.alerts.size() - 1;
      alert = {status.alerts[0].type + (more > 0 ? fmt::format("  +{}", more) : "")};
    } else if (!status.live.margin) {
      alert = {"no live verdict"};
    }
    stack.add("alerts", alert, kCompactAlert, color);
    return;
  }
  std::vector<std::string> wrapped;
  for (const auto& line : lines) {
    const auto pieces = wrapText(line, kLineOfPlace);
    wrapped.insert(wrapped.end(), pieces.begin(), pieces.end());
  }
  stack.add("text", wrapped, kLineHeight, kText);
  stack.add("follow", status.follow ? followLines(*status.follow) : std::vector<std::string>{},
            kLineHeight, kLearned);
  stack.add("text", {headline}, kHeadlineHeight, color);
  // The most severe alert is on top in full, the others below it by their names. Lines without an
  // alert are written empty, which clears them.
  const std::vector<Alert>& alerts = status.alerts;
  for (std::size_t i = kAlertsShown; i-- > 0;) {
    std::vector<std::string> sentence;
    int severity = Alert::INFO;
    if (i < alerts.size()) {
      severity = alerts[i].severity;
      const std::string& words = i == 0 ? alerts[i].text : alerts[i].type;
      sentence = wrapText(severityName(severity) + ": " + words, kLineOfPlace);
      if (i + 1 == kAlertsShown && alerts.size() > kAlertsShown) {
        sentence.push_back(fmt::format("and {} more", alerts.size() - kAlertsShown));
      }
    }
    stack.add("alerts", sentence, kLineHeight, severityColor(severity));
  }
}

}  // namespace whirl_twin
