#include "display/system_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "display/status_text.h"

namespace whirl_twin {
namespace {

constexpr Color kText{0.90F, 0.92F, 0.94F};
constexpr double kHeadlineHeight = 0.095;  // m
constexpr double kLineHeight = 0.072;      // m
constexpr std::size_t kLineLength = 40;    // characters, about as wide as a place
constexpr std::size_t kAlertsShown = 3;

// Stacks blocks of text upwards. rviz sets lines a line's height and 0.01 m apart.
class TextStack {
 public:
  TextStack(const Eigen::Vector3d& foot, const Eigen::Vector3d& up, MarkerCanvas& canvas)
      : foot_(foot), up_(up), canvas_(canvas) {}

  void add(const std::string& part, const std::vector<std::string>& lines, double height,
           const Color& color) {
    const double block = static_cast<double>(lines.size()) * (height + 0.01);
    canvas_.text(part, foot_ + 0.5 * block * up_, height, joinedLines(lines), color);
    foot_ += (lines.empty() ? 0.0 : block + 0.02) * up_;
  }

 private:
  Eigen::Vector3d foot_;
  Eigen::Vector3d up_;
  MarkerCanvas& canvas_;
};

}  // namespace

std::vector<Eigen::Vector3d> sideBySide(std::size_t places) {
  std::vector<Eigen::Vector3d> row;
  for (std::size_t i = 0; i < places; ++i) {
    const double y = (static_cast<double>(i) - 0.5 * static_cast<double>(places - 1)) * kPlaceWidth;
    row.emplace_back(kEchelon * y, y, 0.0);
  }
  return row;
}

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

void drawStatus(const std::string& headline, const std::vector<std::string>& lines,
                const std::vector<Alert>& alerts, const Eigen::Vector3d& foot,
                const Eigen::Vector3d& up, MarkerCanvas& canvas) {
  TextStack stack(foot, up, canvas);
  std::vector<std::string> wrapped;
  for (const auto& line : lines) {
    const auto pieces = wrapText(line, kLineLength);
    wrapped.insert(wrapped.end(), pieces.begin(), pieces.end());
  }
  stack.add("text", wrapped, kLineHeight, kText);
  stack.add("text", {headline}, kHeadlineHeight, severityColor(alerts, kText));
  // The most severe stands on top in full, the others below it by their names. Places without an
  // alert are written empty, which clears them.
  for (std::size_t i = kAlertsShown; i-- > 0;) {
    std::vector<std::string> sentence;
    int severity = Alert::INFO;
    if (i < alerts.size()) {
      severity = alerts[i].severity;
      const std::string& words = i == 0 ? alerts[i].text : alerts[i].type;
      sentence = wrapText(severityName(severity) + ": " + words, kLineLength);
      if (i + 1 == kAlertsShown && alerts.size() > kAlertsShown) {
        sentence.push_back(fmt::format("and {} more", alerts.size() - kAlertsShown));
      }
    }
    stack.add("alerts", sentence, kLineHeight, severityColor(severity));
  }
}

}  // namespace whirl_twin
