// The labels in a chart: names of reference lines, and notes, placed without overlap.
#include <algorithm>
#include <cmath>
#include <utility>

#include "plots/chart_drawing.h"

namespace whirl_twin {

namespace {

constexpr double kWordsSize = 12.0;    // px
constexpr double kWordsHeight = 15.0;  // px

}  // namespace

/// Names of reference lines, and notes.
void ChartDrawing::drawWords() {
  if (chart_.vertical.empty() && chart_.horizontal.empty() && chart_.notes.empty()) {
    return;
  }
  LabelPlaces places(plot_);
  for (const Series& series : chart_.series) {
    std::vector<Spot> line;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      line.push_back(at(series.x[i], series.y[i]));
      if (series.marks != Marks::kNone) {
        places.avoid(
            Rectangle{line.back().x - kMark, line.back().y - kMark, 2.0 * kMark, 2.0 * kMark});
      }
    }
    if (series.line) {
      places.avoid(line);
    }
  }
  nameReferences(places);
  for (const Note& note : chart_.notes) {
    const Spot spot = at(note.x, note.y);
    if (!std::isfinite(spot.x) || !std::isfinite(spot.y)) {
      continue;
    }
    const double width =
        canvas_.textWidth(note.text, Lettering{kWordsSize, ink::kGrey, Align::kEnd, Align::kEnd});
    std::vector<Rectangle> around;
    for (const double away : {7.0, 13.0}) {
      for (const auto& [across, down] :
           {std::pair{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}}) {
        around.push_back({spot.x + across * (away + 0.5 * width) - 0.5 * width,
                          spot.y + down * (away + 0.5 * kWordsHeight) - 0.5 * kWordsHeight, width,
                          kWordsHeight});
      }
    }
    const auto place = std::find_if(around.begin(), around.end(),
                                    [&](const Rectangle& near) { return places.free(near); });
    if (place != around.end()) {  // farther away they would be ambiguous
      places.avoid(*place);
      canvas_.text({place->left, place->top + 0.5 * kWordsHeight}, note.text,
                   {kWordsSize, ink::kBlack, Align::kStart, Align::kMiddle});
    }
  }
}

/// Each beside its line: at a vertical one rotated, preferably high, or horizontal where that does
/// not fit; along a horizontal one, preferably to the right.
void ChartDrawing::nameReferences(LabelPlaces& places) {
  constexpr double kStride = 10.0;  // px
  Lettering upright{kWordsSize, ink::kGrey, Align::kMiddle, Align::kMiddle};
  const Lettering level = upright;
  upright.upwards = true;
  for (const ReferenceLine& line : chart_.vertical) {
    const double x = plot_.left + x_.place(line.at) * plot_.width;
    places.avoid({{x, plot_.top}, {x, plot_.bottom()}});
  }
  const auto drawAt = [&](const std::vector<Rectangle>& beside, const std::string& words) {
    const Rectangle place = places.take(beside);
    canvas_.text({place.left + 0.5 * place.width, place.top + 0.5 * place.height}, words,
                 place.width > place.height ? level : upright);
  };
  for (const ReferenceLine& line : chart_.vertical) {
    if (line.label.empty() || !seen(x_.place(line.at))) {
      continue;
    }
    const double x = plot_.left + x_.place(line.at) * plot_.width;
    const double length = canvas_.textWidth(line.label, level);
    std::vector<Rectangle> beside;
    for (double y = plot_.top + 5.0; beside.empty() || y + length < plot_.bottom(); y += kStride) {
      beside.push_back({x - 2.0 - kWordsHeight, y, kWordsHeight, length});
      beside.push_back({x + 2.0, y, kWordsHeight, length});
    }
    for (const double away : {2.0, 20.0, 40.0, 60.0}) {
      for (double y = plot_.top + 5.0; y < plot_.top + 60.0; y += kStride) {
        beside.push_back({x + away, y, length, kWordsHeight});
        beside.push_back({x - away - length, y, length, kWordsHeight});
      }
    }
    drawAt(beside, line.label);
  }
  for (const ReferenceLine& line : chart_.horizontal) {
    if (line.label.empty() || !seen(y_.place(line.at))) {
      continue;
    }
    const double y = plot_.bottom() - y_.place(line.at) * plot_.height;
    const double length = canvas_.textWidth(line.label, level);
    std::vector<Rectangle> beside;
    for (double x = plot_.right() - 5.0 - length; beside.empty() || x > plot_.left; x -= kStride) {
      beside.push_back({x, y - 2.0 - kWordsHeight, length, kWordsHeight});
      beside.push_back({x, y + 2.0, length, kWordsHeight});
    }
    drawAt(beside, line.label);
  }
}

}  // namespace whirl_twin
