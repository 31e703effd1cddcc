#include "reports/motion_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/shaft_picture.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kGhosts = 4;        // later positions
constexpr double kGhostDistance = 0.3;    // of the tracer's range, from one to the next
constexpr double kLongestTrace = 6.0;     // of the tracer's range
constexpr std::size_t kPositions = 5000;  // of a run, looked at
constexpr double kUnseenMotion = 1.0e-3;  // of the picture's size, of a motion that is not seen

double distance(const SketchPoint& a, const SketchPoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

Sketch sketchAt(const Dynamics& dynamics, const PlotHistory& history, std::size_t sample) {
  Eigen::VectorXd q(dynamics.dof());
  for (std::size_t k = 0; k < history.coordinates.size(); ++k) {
    q[static_cast<Eigen::Index>(k)] = history.coordinates[k][sample];
  }
  return dynamics.sketch(q, history.moments[sample]);
}

/// The diagonal of the box that holds the tracer's path.
double range(const std::vector<Sketch>& sketches) {
  const double infinity = std::numeric_limits<double>::infinity();
  SketchPoint low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Sketch& s : sketches) {
    low = {std::min(low.x, s.tracer.x), std::min(low.y, s.tracer.y), std::min(low.z, s.tracer.z)};
    high = {std::max(high.x, s.tracer.x), std::max(high.y, s.tracer.y),
            std::max(high.z, s.tracer.z)};
  }
  return distance(low, high);
}

}  // namespace

std::optional<SketchPicture> motionPicture(const std::string& title, const Dynamics& dynamics,
                                           const PlotHistory& history) {
  if (std::optional<SketchPicture> shaft = shaftPicture(dynamics, history)) {
    shaft->title = title;
    return shaft;
  }
  SketchPicture picture;
  picture.title = title;
  picture.sketch = sketchAt(dynamics, history, 0);
  if (picture.sketch.empty()) {
    return std::nullopt;
  }
  if (!picture.sketch.has_tracer) {
    return picture;
  }
  std::vector<Sketch> sketches;
  const std::size_t stride = 1 + history.time.size() / kPositions;
  for (std::size_t i = 0; i < history.time.size() && std::isfinite(history.kinetic[i]);
       i += stride) {
    sketches.push_back(sketchAt(dynamics, history, i));
  }
  const double all = range(sketches);
  if (all < kUnseenMotion * picture.sketch.size) {
    return picture;
  }
  // The first stretch of the motion: all of it would be a blot.
  double length = 0.0;
  std::size_t last_ghost = 0;
  for (std::size_t i = 0; i < sketches.size() && length < kLongestTrace * all; ++i) {
    length += i == 0 ? 0.0 : distance(sketches[i].tracer, sketches[i - 1].tracer);
    picture.trace.push_back(sketches[i].tracer);
    if (picture.ghosts.size() < kGhosts &&
        distance(sketches[i].tracer, sketches[last_ghost].tracer) > kGhostDistance * all) {
      picture.ghosts.push_back(sketches[i]);
      last_ghost = i;
    }
  }
  return picture;
}

}  // namespace whirl_twin
