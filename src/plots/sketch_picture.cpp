#include "plots/sketch_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plots/sketch_parts.h"
#include "plots/ticks.h"

namespace whirl_twin {
namespace {

constexpr double kWidest = 800.0;   // px
constexpr double kHighest = 620.0;  // px
constexpr double kTop = 40.0;       // px, of the title
constexpr double kMargin = 24.0;    // px
constexpr double kFoot = 34.0;      // px, area of the scale bar
constexpr double kGhost = 0.72;     // share of white

/// Scale bar, "0.2 m", a third of the picture at most.
struct ScaleBar {
  double length;  // m
  std::string label;
};
ScaleBar scaleBar(double width) {
  const std::vector<double> ticks = linearTicks({0.0, width / 3.0}, 3);
  const double length = ticks[1] > width / 3.0 ? 0.5 * ticks[1] : ticks[1];
  return {length,
          length < 0.01 ? fmt::format("{:g} mm", 1000.0 * length) : fmt::format("{:g} m", length)};
}

SketchBounds boundsOfAll(const SketchPicture& picture, const SketchView& view) {
  SketchBounds all = boundsOf(picture.sketch, view);
  const auto include = [&all](const SketchBounds& b) {
    all = {std::min(all.left, b.left), std::min(all.top, b.top), std::max(all.right, b.right),
           std::max(all.bottom, b.bottom)};
  };
  for (const Sketch& ghost : picture.ghosts) {
    include(boundsOf(ghost, view));
  }
  const auto includePath = [&](const std::vector<SketchPoint>& path) {
    for (const SketchPoint& point : path) {
      const Spot spot = view.at(point);
      include({spot.x, spot.y, spot.x, spot.y});
    }
  };
  includePath(picture.trace);
  for (const std::vector<SketchPoint>& orbit : picture.orbits) {
    includePath(orbit);
  }
  return all;
}

SketchView viewOf(const SketchPicture& picture) {
  SketchView view;
  if (picture.sketch.spatial) {
    view.raised = 0.35;
    view.turned = 0.30;
  }
  return view;
}

}  // namespace

bool fitsASheet(const SketchPicture& picture) {
  constexpr double kFarthest = 1.0e100;  // m
  const SketchBounds all = boundsOfAll(picture, viewOf(picture));
  const auto within = [](double low, double high) {
    return low >= -kFarthest && high <= kFarthest && low <= high;
  };
  return within(all.left, all.right) && within(all.top, all.bottom);
}

std::string sketchImage(const SketchPicture& picture, ImageFormat format) {
  SketchView view = viewOf(picture);
  const SketchBounds bounds = boundsOfAll(picture, view);  // at 1 px/m
  const double size = 1e-9 + bounds.right - bounds.left;
  const double height = 1e-9 + bounds.bottom - bounds.top;
  view.scale =
      std::min((kWidest - 2.0 * kMargin) / size, (kHighest - kTop - kMargin - kFoot) / height);
  const Lettering title{17.0, ink::kBlack, Align::kMiddle, Align::kMiddle, true};
  const double sheet_width = std::max(view.scale * size + 2.0 * kMargin, 0.5 * kWidest);
  const double sheet_height = view.scale * height + kTop + kMargin + kFoot;
  view.origin = {0.5 * sheet_width - 0.5 * view.scale * (bounds.left + bounds.right),
                 kTop + 0.5 * kMargin - view.scale * bounds.top};

  Canvas canvas(format, static_cast<int>(std::lround(sheet_width)),
                static_cast<int>(std::lround(sheet_height)), picture.title,
                picture.note.empty()
                    ? fmt::format("{} later positions (faint)", picture.ghosts.size())
                    : picture.note);
  canvas.text({0.5 * sheet_width, 20.0}, picture.title, title);
  for (auto ghost = picture.ghosts.rbegin(); ghost != picture.ghosts.rend(); ++ghost) {
    drawParts(*ghost, view, kGhost, canvas);
  }
  drawParts(picture.sketch, view, 0.0, canvas);
  const auto drawPath = [&](const std::vector<SketchPoint>& path) {
    std::vector<Spot> spots;
    for (const SketchPoint& point : path) {
      spots.push_back(view.at(point));
    }
    canvas.line(thinned(spots), {paler(ink::kVermilion, 0.15), 1.4});
  };
  drawPath(picture.trace);
  for (const std::vector<SketchPoint>& orbit : picture.orbits) {
    drawPath(orbit);
  }

  const ScaleBar bar = scaleBar(sheet_width / view.scale);
  const double y = sheet_height - 18.0;
  const Pen pen{ink::kGrey, 1.5};
  const double end = kMargin + view.scale * bar.length;
  canvas.line({{kMargin, y - 4.0}, {kMargin, y + 4.0}}, pen);
  canvas.line({{kMargin, y}, {end, y}}, pen);
  canvas.line({{end, y - 4.0}, {end, y + 4.0}}, pen);
  canvas.text({end + 9.0, y}, bar.label, Lettering{13.0, ink::kGrey});
  canvas.text({sheet_width - kMargin, y}, picture.note, Lettering{13.0, ink::kGrey, Align::kEnd});
  return canvas.finish();
}

}  // namespace whirl_twin
