#include "analysis/campbell.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "analysis/bracketed_root.h"
#include "analysis/crossing_search.h"

namespace whirl_twin {

namespace {

constexpr double kAboveRest = 1.0e-3;  // of the next speed
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
      excess(speed);
      diagram.crossings.push_back({i, harmonic, speed, campbellPoint(mode), f_low >= 0.0});
    }
  }
}

/// Adds the crossings that following has missed, between speeds that are neighbours where `last` is
/// `first` + 1, and the branches they are of from there on.
class MissedCrossings {
 public:
  MissedCrossings(const LinearRotor& rotor, const std::vector<Station>& stations,
                  const ModeTracker& tracker, CampbellDiagram& diagram)
      : search_(rotor.matrices, stations), tracker_(tracker), diagram_(diagram) {}

  void add(double harmonic, std::size_t first, std::size_t last) {
    const double low = speedOf(first);
    const double high = speedOf(last);
    const auto net = search_.net(harmonic, low, high);
    if (!net || *net == followed(harmonic, low, high)) {
      return;
    }
    if (last > first + 1) {
      const std::size_t middle = first + (last - first) / 2;
      add(harmonic, first, middle);
      add(harmonic, middle, last);
      return;
    }
    for (const FoundCrossing& one : search_.between(harmonic, low, high)) {
      if (one.rank < diagram_.branches.size() && !known(harmonic, one)) {
        const std::size_t branch = lostBranch(one, last);
        diagram_.crossings.push_back(
            {branch, harmonic, one.speed, campbellPoint(one.mode), *net > 0});
        follow(one, branch, last);
      }
    }
  }

 private:
  /// At rest no mode is slower than it turns: a little above.
  double speedOf(std::size_t place) const {
    const std::vector<double>& speeds = diagram_.speeds;
    return speeds[place] > 0.0 ? speeds[place] : kAboveRest * speeds[place + 1];
  }
  int followed(double harmonic, double low, double high) const {
    int net = 0;
    for (const CampbellCrossing& one : diagram_.crossings) {
      if (one.harmonic == harmonic && one.speed >= low && one.speed < high) {
        net += one.slows ? 1 : -1;
      }
    }
    return net;
  }
  bool known(double harmonic, const FoundCrossing& one) const {
    return std::any_of(diagram_.crossings.begin(), diagram_.crossings.end(),
                       [&](const CampbellCrossing& other) {
                         return other.harmonic == harmonic && other.mode.whirl == one.mode.whirl &&
                                std::fabs(other.speed - one.speed) <= kSameSpeed * one.speed;
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
    double before = one.speed;
    for (std::size_t k = from; k < diagram_.speeds.size(); ++k) {
      modes = tracker_.follow(modes, before, diagram_.speeds[k]);
      diagram_.branches[branch][k] = campbellPoint(modes.front());
      before = diagram_.speeds[k];
    }
  }

  CrossingSearch search_;
  const ModeTracker& tracker_;
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
    MissedCrossings missed(rotor, stations, tracker, diagram);
    for (const double harmonic : request.harmonics) {
      missed.add(harmonic, 0, request.speeds.size() - 1);
    }
  }
  std::sort(diagram.crossings.begin(), diagram.crossings.end(),
            [](const CampbellCrossing& a, const CampbellCrossing& b) {
              return a.harmonic != b.harmonic ? a.harmonic < b.harmonic : a.speed < b.speed;
            });
  return diagram;
}

}  // namespace whirl_twin
