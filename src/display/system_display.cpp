#include "display/system_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "display/follow_text.h"
#include "display/layout.h"
#include "display/status_text.h"

namespace whirl_twin {
namespace {

constexpr Color kText{0.90F, 0.92F, 0.94F};
constexpr Color kLearned{0.55F, 0.85F, 1.0F};
constexpr double kHeadlineHeight = 0.095;  // m
constexpr double kLineHeight = 0.072;      // m
constexpr double kCompactHeadline = 0.17;  // m
constexpr double kCompactAlert = 0.13;     // m
constexpr std::size_t kLineOfPlace = 40;   // characters, about as wide as a place
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
  // The most severe stands on top in full, the others below it by their names. Places without an
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
