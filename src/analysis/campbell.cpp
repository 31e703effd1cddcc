#include "analysis/campbell.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "analysis/bracketed_root.h"

namespace whirl_twin {

namespace {

/// Where between two neighbouring speeds a branch meets h w, if it does.
void addCrossings(const ModeTracker& tracker, const CampbellRequest& request, std::size_t place,
                  const ModeTracker::Modes& before, const ModeTracker::Modes& after,
                  CampbellDiagram& diagram) {
  const double low = request.speeds[place];
  const double high = request.speeds[place + 1];
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!before[i] || !after[i]) {
      continue;
    }
    for (const double harmonic : request.harmonics) {
      const double f_low = before[i]->dampedFrequency() - harmonic * low;
      const double f_high = after[i]->dampedFrequency() - harmonic * high;
      if ((f_low < 0.0) == (f_high < 0.0)) {
        continue;
      }
      std::optional<WhirlMode> mode = before[i];
      const auto excess = [&](double speed) {
        const auto there = tracker.follow({before[i]}, low, speed).front();
        mode = there ? there : mode;
        return mode->dampedFrequency() - harmonic * speed;
      };
      const double speed = bracketedRoot(excess, low, high, f_low, f_high);
      excess(speed);
      diagram.crossings.push_back({i, harmonic, speed, campbellPoint(mode)});
    }
  }
}

}  // namespace

CampbellPoint campbellPoint(const std::optional<WhirlMode>& mode) {
  if (!mode) {
    return {kNaN, kNaN, kNaN, kNaN, kNaN, Whirl::kStraight};
  }
  return {mode->dampedFrequency(), mode->naturalFrequency(), 0.0 - mode->eigenvalue.real(),
          mode->dampingRatio(),    mode->logDecrement(),     mode->whirl};
}

CampbellDiagram campbell(const LinearRotor& rotor, const std::vector<Station>& stations,
                         const CampbellRequest& request) {
  CampbellDiagram diagram;
  diagram.speeds = request.speeds;
  if (request.speeds.empty()) {
    return diagram;
  }
  const ModeTracker tracker(rotor.matrices, stations);
  ModeTracker::Modes modes = tracker.lowest(request.speeds.front(), request.branches);
  diagram.branches.resize(modes.size());
  for (std::size_t k = 0; k < request.speeds.size(); ++k) {
    if (k > 0) {
      const auto next = tracker.follow(modes, request.speeds[k - 1], request.speeds[k]);
      addCrossings(tracker, request, k - 1, modes, next, diagram);
      modes = next;
    }
    for (std::size_t i = 0; i < modes.size(); ++i) {
      diagram.branches[i].push_back(campbellPoint(modes[i]));
    }
    if (request.progress) {
      request.progress(k + 1);
    }
  }
  std::sort(diagram.crossings.begin(), diagram.crossings.end(),
            [](const CampbellCrossing& a, const CampbellCrossing& b) {
              return a.harmonic != b.harmonic ? a.harmonic < b.harmonic : a.speed < b.speed;
            });
  return diagram;
}

}  // namespace whirl_twin
