#include "analysis/campbell.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "analysis/crossing_search.h"
#include "analysis/polynomial_roots.h"

namespace whirl_twin {

namespace {

constexpr double kAboveRest = 1.0e-3;  // of the next speed
constexpr double kMeets = 1.0e-6;      // of a frequency: as near as one comes that meets it
constexpr double kSameSpeed = 1.0e-8;  // of a critical speed

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
      if (!(std::fabs(excess(speed)) <= kMeets * harmonic * speed) || !isWhirl(*mode)) {
        continue;  // between them another mode was taken for it, or it is overdamped, or nearly
      }
      diagram.crossings.push_back({i, harmonic, speed, campbellPoint(mode), f_low >= 0.0});
    }
  }
}

/// Adds the crossings that following has missed, and the branches they are of from there on.
class MissedCrossings {
 public:
  MissedCrossings(const LinearRotor& rotor, const std::vector<Station>& stations,
                  const ModeTracker& tracker, double harmonic, CampbellDiagram& diagram)
      : search_(rotor, stations, harmonic),
        tracker_(tracker),
        harmonic_(harmonic),
        diagram_(diagram) {}

  void add() {
    const std::vector<double>& speeds = diagram_.speeds;
    std::vector<MetSpeed> followed;
    for (const CampbellCrossing& one : diagram_.crossings) {
      if (one.harmonic == harmonic_) {
        followed.push_back({one.speed, one.mode.decay_rate / one.mode.frequency, one.slows});
      }
    }
    const double first = speeds.front() > 0.0 ? (1.0 + kBeside) * speeds.front()
                                              : kAboveRest * speeds[1];  // at rest all are faster
    const double last = (1.0 - kBeside) * speeds.back();
    double low = first;
    for (int k = 1; k <= kSearches; ++k) {
      const double part = static_cast<double>(k) / kSearches;
      const double high = first + (last - first) * std::pow(part, kMoreAtLow);
      for (const FoundCrossing& one : search_.missing(followed, low, high)) {
        add(one);
      }
      low = high;
    }
  }

 private:
  static constexpr int kSearches = 32;
  static constexpr double kMoreAtLow = 1.877;  // more at low speeds, and none at a round one
  static constexpr double kBeside = 1.0e-9;    // of a speed at which a mode may meet it exactly

  void add(const FoundCrossing& one) {
    if (known(one)) {
      return;
    }
    const std::vector<double>& speeds = diagram_.speeds;
    const auto place = static_cast<std::size_t>(
        std::lower_bound(speeds.begin(), speeds.end(), one.at.speed) - speeds.begin());
    const std::size_t branch = lostBranch(one, place);
    diagram_.crossings.push_back(
        {branch, harmonic_, one.at.speed, campbellPoint(one.mode), one.at.slows});
    follow(one, branch, place);
  }
  bool known(const FoundCrossing& one) const {
    return std::any_of(diagram_.crossings.begin(), diagram_.crossings.end(),
                       [&](const CampbellCrossing& other) {
                         return other.harmonic == harmonic_ && other.mode.whirl == one.mode.whirl &&
                                std::fabs(other.speed - one.at.speed) <= kSameSpeed * one.at.speed;
                       });
  }
  /// The one whose frequency was nearest when it was last known; none: a new one.
  std::size_t lostBranch(const FoundCrossing& one, std::size_t place) {
    std::size_t nearest = diagram_.branches.size();
    double least = kInfinity;
    for (std::size_t i = 0; i < diagram_.branches.size(); ++i) {
      const std::vector<CampbellPoint>& branch = diagram_.branches[i];
      if (!std::isnan(branch[place].frequency)) {
        continue;
      }
      const auto last =
          std::find_if(branch.rend() - static_cast<std::ptrdiff_t>(place), branch.rend(),
                       [](const CampbellPoint& point) { return !std::isnan(point.frequency); });
      const double apart = last == branch.rend()
                               ? kInfinity
                               : std::fabs(last->frequency - one.mode.dampedFrequency());
      if (apart < least) {
        least = apart;
        nearest = i;
      }
    }
    if (nearest == diagram_.branches.size()) {
      diagram_.branches.emplace_back(diagram_.speeds.size(), campbellPoint(std::nullopt));
    }
    return nearest;
  }
  void follow(const FoundCrossing& one, std::size_t branch, std::size_t from) {
    ModeTracker::Modes modes{one.mode};
    double before = one.at.speed;
    for (std::size_t k = from; k < diagram_.speeds.size(); ++k) {
      modes = tracker_.follow(modes, before, diagram_.speeds[k]);
      diagram_.branches[branch][k] = campbellPoint(modes.front());
      before = diagram_.speeds[k];
    }
  }

  CrossingSearch search_;
  const ModeTracker& tracker_;
  double harmonic_;
  CampbellDiagram& diagram_;
};

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
  if (request.speeds.size() > 1) {
    for (const double harmonic : request.harmonics) {
      MissedCrossings(rotor, stations, tracker, harmonic, diagram).add();
    }
  }
  std::sort(diagram.crossings.begin(), diagram.crossings.end(),
            [](const CampbellCrossing& a, const CampbellCrossing& b) {
              return a.harmonic != b.harmonic ? a.harmonic < b.harmonic : a.speed < b.speed;
            });
  return diagram;
}

}  // namespace whirl_twin
