// Crossings of whirl modes with a multiple of the speed, without mode tracking. An eigenvalue s of
// decay rate d crosses h w where
//
//   det D(i h w - d; w) = 0,   D(s; w) = s^2 M + s (C + G) + K + N:
//
// two real equations for d and w. Along the border of a rectangle of the plane of d / (h w) and w
// the phase of the determinant makes +1 turn for each enclosed mode that rises above h w and -1 for
// each that falls below it (the degree of a map of the plane). A rectangle whose number of turns
// differs from that of the known crossings is bisected until a missing crossing is isolated, and
// Newton's method finds it. Heavily damped pairs, which begin or cease to vibrate and are no
// whirls, are outside of the rectangles; inaccurate roots of light nodes do not affect the count.
#pragma once

#include <array>
#include <complex>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/banded_rotor.h"
#include "analysis/whirl_modes.h"

namespace whirl_twin {

struct MetSpeed {
  double speed = 0.0;  ///< [rad/s]
  double decay = 0.0;  ///< [-], -Re s / (h w)
  bool slows = true;   ///< slower than h w beyond; false: it outruns h w
};

struct FoundCrossing {
  MetSpeed at;
  WhirlMode mode;  ///< there
};

class CrossingSearch {
 public:
  CrossingSearch(const LinearRotor& rotor, std::vector<Station> stations, double harmonic)
      : rotor_(rotor), stations_(std::move(stations)), harmonic_(harmonic) {}

  /// The crossings between two speeds [rad/s] that `known` lacks, of whirls (isWhirl) that grow by
  /// less than 30 h w. Two that are not known, of about one speed and damping, one of them slowing
  /// and the other not, are not noticed.
  std::vector<FoundCrossing> missing(const std::vector<MetSpeed>& known, double low,
                                     double high) const;

 private:
  /// In asinh(d / (h w)) and w.
  struct Rectangle {
    double left, right, low, high;
  };
  using Edge = std::array<double, 4>;  // from (x, w) to (x, w)
  struct Search;

  std::complex<double> phase(const BandedLinearization& l, double x, double speed) const;
  double turn(const Edge& edge) const;
  double turnOnce(const Edge& edge) const;
  std::optional<int> slowed(const Rectangle& r) const;
  void look(const Rectangle& r, int halvings, Search& search) const;
  std::optional<FoundCrossing> refined(const Rectangle& r, bool slows) const;
  void addRepeated(const Rectangle& r, bool slows, Search& search) const;
  WhirlModes modesBelow(double frequency, double speed) const;

  BandedRotor rotor_;
  std::vector<Station> stations_;
  double harmonic_;
  mutable std::map<Edge, double> turns_;
};

}  // namespace whirl_twin
