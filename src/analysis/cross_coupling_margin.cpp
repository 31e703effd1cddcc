#include "analysis/cross_coupling_margin.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/dense.h"
#include "analysis/cyclic_coordinates.h"
#include "analysis/mode_tracking.h"
#include "analysis/polynomial_roots.h"

namespace whirl_twin {

namespace {

constexpr double kFirst = 1.0e-6;  // of the stiffness that the station has at rest
constexpr double kLast = 1.0e6;
constexpr double kStiffnessStride = 2.0;

/// The modes of lowest frequency that whirl, with Q [N/m] at a station.
class CoupledModes {
 public:
  CoupledModes(const LinearRotor& rotor, const std::vector<Station>& stations, std::size_t station,
               double speed)
      : all_(static_cast<std::size_t>(rotor.dof())),
        modes_([matrices = rotor.matrices(speed), place = stations.at(station)](
                   double q) { return withCrossCoupling(matrices, place, q); },
               stations) {}

  std::vector<WhirlMode> at(double cross_coupling) const {
    constexpr std::size_t kEnough = 6;  // forward and backward, of three bending shapes
    std::vector<WhirlMode> whirls;
    // Of a long shaft all of them cost much more; bearings may damp the lowest of them too much.
    for (std::size_t count = 12; whirls.size() < kEnough; count *= 4) {
      whirls.clear();
      for (auto& mode : modes_.lowest(cross_coupling, count)) {
        if (isWhirl(*mode) || mode->eigenvalue.real() > 0.0) {
          whirls.push_back(std::move(*mode));
        }
      }
      if (count >= all_) {
        break;
      }
    }
    return whirls;
  }
  /// [1/s], of the slowest decaying mode; none where nothing whirls.
  std::optional<double> growth(double cross_coupling) const {
    std::optional<double> fastest;
    for (const WhirlMode& mode : at(cross_coupling)) {
      fastest = std::max(fastest.value_or(mode.eigenvalue.real()), mode.eigenvalue.real());
    }
    return fastest;
  }

 private:
  std::size_t all_;
  ModeTracker modes_;
};

/// [N/m], of the rotor at a station, both directions in series: what Q is compared with. The
/// largest element of the matrix would be that of a stiff support far away. Of a rotor that moves
/// there without stiffness, or that springs push, that largest element.
double stiffnessAt(const Linearization& matrices, const Station& station) {
  if (!rigidBodyMotions(matrices).any()) {
    const Lu stiffness(matrices.stiffness);
    const double flexibility = station.along_x.dot(stiffness.solve(station.along_x)) +
                               station.along_y.dot(stiffness.solve(station.along_y));
    if (flexibility > 0.0) {
      return 2.0 / flexibility;
    }
  }
  return matrices.stiffness.cwiseAbs().maxCoeff();
}

}  // namespace

Linearization withCrossCoupling(Linearization matrices, const Station& station,
                                double cross_coupling) {
  const Eigen::MatrixXd forward = station.along_x * station.along_y.transpose();
  matrices.circulatory += cross_coupling * (forward - forward.transpose());
  return matrices;
}

std::vector<CrossCouplingRow> slowestForwardMode(const LinearRotor& rotor,
                                                 const std::vector<Station>& stations,
                                                 std::size_t station, double speed,
                                                 const std::vector<double>& cross_couplings) {
  const CoupledModes coupled(rotor, stations, station, speed);
  std::vector<CrossCouplingRow> rows;
  for (const double q : cross_couplings) {
    std::optional<WhirlMode> least;
    for (WhirlMode& mode : coupled.at(q)) {
      if (mode.whirl != Whirl::kBackward &&
          (!least || mode.eigenvalue.real() > least->eigenvalue.real())) {
        least = std::move(mode);
      }
    }
    if (least) {
      rows.push_back({q, std::move(*least)});
    }
  }
  return rows;
}

std::optional<double> crossCouplingMargin(const LinearRotor& rotor,
                                          const std::vector<Station>& stations, std::size_t station,
                                          double speed) {
  const CoupledModes coupled(rotor, stations, station, speed);
  std::optional<double> before = coupled.growth(0.0);
  if (before && *before >= 0.0) {
    return 0.0;
  }
  const double stiffness = stiffnessAt(rotor.matrices(speed), stations.at(station));
  double low = 0.0;
  for (double high = kFirst * stiffness; high < kLast * stiffness; high *= kStiffnessStride) {
    const std::optional<double> growth = coupled.growth(high);
    if (growth && *growth >= 0.0) {
      // A mode that is backward gains nothing from Q: what ceases to decay is forward.
      return bracketedRoot([&](double q) { return coupled.growth(q).value_or(*growth); }, low, high,
                           before.value_or(-*growth), *growth);
    }
    low = high;
    before = growth;
  }
  return std::nullopt;
}

std::optional<CrossCouplingMargin> crossCouplingMarginOf(const Dynamics& dynamics, double speed) {
  if (!dynamics.linear() || !dynamics.hasShaft() || dynamics.stations().empty() ||
      dynamics.dof() > kMaxCoupledCoordinates) {
    return std::nullopt;
  }
  const std::vector<Station> stations = dynamics.stations();
  return CrossCouplingMargin{stations.front().name,
                             crossCouplingMargin(dynamics.linearRotor(), stations, 0, speed)};
}

}  // namespace whirl_twin
