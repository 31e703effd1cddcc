#include "analysis/cross_coupling_margin.h"

#include <utility>

#include "analysis/bracketed_root.h"
#include "analysis/mode_tracking.h"

namespace whirl_twin {

namespace {

constexpr double kFirst = 1.0e-6;  // of the largest stiffness
constexpr double kLast = 1.0e6;
constexpr double kStiffnessStride = 1.5;

ModeTracker trackerOf(const LinearRotor& rotor, const std::vector<Station>& stations,
                      std::size_t station, double speed) {
  return {[matrices = rotor.matrices(speed), place = stations.at(station)](double q) {
            return withCrossCoupling(matrices, place, q);
          },
          stations};
}

ModeTracker::Modes firstForward(const ModeTracker& tracker, const LinearRotor& rotor) {
  constexpr std::size_t kFew = 12;  // of a long shaft all of them cost much more
  for (const std::size_t count : {kFew, static_cast<std::size_t>(rotor.dof())}) {
    for (const auto& mode : tracker.lowest(0.0, count)) {
      if (mode->whirl != Whirl::kBackward) {
        return {mode};
      }
    }
  }
  return {std::nullopt};
}

}  // namespace

Linearization withCrossCoupling(Linearization matrices, const Station& station,
                                double cross_coupling) {
  const Eigen::MatrixXd forward = station.along_x * station.along_y.transpose();
  matrices.circulatory += cross_coupling * (forward - forward.transpose());
  return matrices;
}

std::vector<CrossCouplingRow> firstForwardMode(const LinearRotor& rotor,
                                               const std::vector<Station>& stations,
                                               std::size_t station, double speed,
                                               const std::vector<double>& cross_couplings) {
  const ModeTracker tracker = trackerOf(rotor, stations, station, speed);
  ModeTracker::Modes mode = firstForward(tracker, rotor);
  double before = 0.0;
  std::vector<CrossCouplingRow> rows;
  for (const double q : cross_couplings) {
    mode = tracker.follow(mode, before, q);
    before = q;
    if (!mode.front()) {
      break;
    }
    rows.push_back({q, *mode.front()});
  }
  return rows;
}

std::optional<double> crossCouplingMargin(const LinearRotor& rotor,
                                          const std::vector<Station>& stations, std::size_t station,
                                          double speed) {
  const ModeTracker tracker = trackerOf(rotor, stations, station, speed);
  ModeTracker::Modes mode = firstForward(tracker, rotor);
  if (!mode.front()) {
    return std::nullopt;
  }
  if (mode.front()->eigenvalue.real() >= 0.0) {
    return 0.0;
  }
  const double stiffness = rotor.matrices(speed).stiffness.cwiseAbs().maxCoeff();
  double low = 0.0;
  for (double high = kFirst * stiffness; high < kLast * stiffness; high *= kStiffnessStride) {
    const ModeTracker::Modes next = tracker.follow(mode, low, high);
    if (!next.front()) {
      return std::nullopt;
    }
    if (next.front()->eigenvalue.real() >= 0.0) {
      const auto growth = [&](double q) {
        const auto there = tracker.follow(mode, low, q).front();
        return (there ? there : next.front())->eigenvalue.real();
      };
      return bracketedRoot(growth, low, high, mode.front()->eigenvalue.real(),
                           next.front()->eigenvalue.real());
    }
    low = high;
    mode = next;
  }
  return std::nullopt;
}

std::optional<CrossCouplingMargin> crossCouplingMarginOf(const Dynamics& dynamics, double speed) {
  if (!dynamics.linear() || !dynamics.hasShaft() || dynamics.stations().empty() ||
      dynamics.dof() > kMostCoupledCoordinates) {
    return std::nullopt;
  }
  const std::vector<Station> stations = dynamics.stations();
  return CrossCouplingMargin{stations.front().name,
                             crossCouplingMargin(dynamics.linearRotor(), stations, 0, speed)};
}

}  // namespace whirl_twin
