#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "mechanics/round_number.h"
#include "reports/system_plots.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kGhosts = 4;        // later positions
constexpr double kGhostDistance = 0.3;    // of the tracer's range, from one to the next
constexpr double kMaxTrace = 6.0;         // of the tracer's range
constexpr std::size_t kPositions = 5000;  // samples of a run that are used
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
  const double infinity = kInfinity;
  SketchPoint low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Sketch& s : sketches) {
    low = {std::min(low.x, s.tracer.x), std::min(low.y, s.tracer.y), std::min(low.z, s.tracer.z)};
    high = {std::max(high.x, s.tracer.x), std::max(high.y, s.tracer.y),
            std::max(high.z, s.tracer.z)};
  }
  return distance(low, high);
}

constexpr double kBent = 0.12;           // of the shaft's length, drawn at most
constexpr std::size_t kLookedAt = 2000;  // samples of a run
constexpr int kOrbitCorners = 72;        // of an orbit
constexpr double kNoMotion = 1.0e-15;    // of the shaft's length: no motion

Eigen::VectorXd sample(const std::vector<std::vector<double>>& values, std::size_t i) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k) {
    all[static_cast<Eigen::Index>(k)] = values[k][i];
  }
  return all;
}

double longestRadius(const std::vector<Station>& stations, const Eigen::VectorXd& q) {
  double longest = 0.0;
  for (const Station& station : stations) {
    longest = std::max(longest, std::hypot(station.along_x.dot(q), station.along_y.dot(q)));
  }
  return longest;
}

/// The samples that are used: those at which all of the motion is known.
std::vector<std::size_t> samplesOf(const PlotHistory& history) {
  std::vector<std::size_t> samples;
  const std::size_t stride = 1 + history.time.size() / kLookedAt;
  for (std::size_t i = 0; i < history.time.size() && std::isfinite(history.kinetic[i]);
       i += stride) {
    samples.push_back(i);
  }
  return samples;
}

/// "500", "0.02"
std::string roundNumber(double number) {
  return number >= 1.0 ? fmt::format("{:.0f}", number) : fmt::format("{:.3g}", number);
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
  for (std::size_t i = 0; i < sketches.size() && length < kMaxTrace * all; ++i) {
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

std::optional<SketchPicture> shaftPicture(const Dynamics& dynamics, const PlotHistory& history) {
  const std::vector<Station> stations = dynamics.stations();
  const std::vector<std::size_t> samples = samplesOf(history);
  if (!dynamics.isRotor() || stations.size() < 2 || samples.empty() ||
      history.coordinates.size() != static_cast<std::size_t>(dynamics.dof())) {
    return std::nullopt;
  }
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(dynamics.dof());
  double longest = 0.0;
  std::size_t widest = 0;
  for (const std::size_t i : samples) {
    const Eigen::VectorXd q = sample(history.coordinates, i);
    mean += q / static_cast<double>(samples.size());
    const double radius = longestRadius(stations, q);
    if (radius > longest) {
      longest = radius;
      widest = i;
    }
  }
  const Sketch still = dynamics.sketch(Eigen::VectorXd::Zero(dynamics.dof()), {});
  if (still.empty() || !(longest > kNoMotion * still.size)) {
    return std::nullopt;
  }
  const double factor = roundDown125(kBent * still.size / longest);
  const Eigen::VectorXd q = sample(history.coordinates, widest);
  const Eigen::VectorXd v = sample(history.rates, widest);
  const double speed = history.speed[widest];
  SketchPicture picture;
  picture.sketch = dynamics.sketch(factor * q, history.moments[widest]);
  picture.sketch.lines.push_back({{{still.centre.x - 0.5 * still.size, 0.0, 0.0},
                                   {still.centre.x + 0.5 * still.size, 0.0, 0.0}},
                                  SketchRole::kMark});
  // The orbit through this state if all of it went with the shaft, about the middle of the run.
  for (std::size_t i = 0; speed != 0.0 && i < stations.size(); ++i) {
    if (i > 0 && !stations[i].published) {
      continue;
    }
    std::vector<SketchPoint> orbit;
    for (int k = 0; k <= kOrbitCorners; ++k) {
      const double turn = kTwoPi * k / kOrbitCorners;
      const Eigen::VectorXd there = mean + std::cos(turn) * (q - mean) + std::sin(turn) / speed * v;
      orbit.push_back({stations[i].position, factor * stations[i].along_x.dot(there),
                       factor * stations[i].along_y.dot(there)});
    }
    picture.orbits.push_back(orbit);
  }
  picture.note =
      fmt::format("deflection x {}, at {:.4g} s", roundNumber(factor), history.time[widest]);
  if (speed != 0.0) {
    picture.note += fmt::format(" and {:.4g} rad/s", speed);
  }
  return picture;
}

}  // namespace whirl_twin
