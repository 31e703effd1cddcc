#include "analysis/loop_margins.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "analysis/polynomial_roots.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;

constexpr int kPointsOfDecade = 60;
/// A continuous-time loop is evaluated this many decades above and below its poles.
constexpr double kDecadesBeyond = 4.0;
/// A pole nearer to the axis than this part of its size is not resolved any more.
constexpr double kMinPoleWidth = 1e-9;
constexpr double kSameFrequency = 1e-12;
/// Peaks of a loop without any effect are 1, to rounding.
constexpr double kRoundingOfPeak = 1e-9;

struct Point {
  double frequency;
  Complex loop;
  double sensitivity() const { return 1.0 / std::abs(1.0 + loop); }
};

/// Where to look: evenly on a logarithmic scale, and around each pole from a fraction of its width
/// outwards.
std::vector<double> frequencies(const LoopSpan& response) {
  double least = kInfinity;
  double largest = 0.0;
  for (const Complex& pole : response.poles) {
    if (pole != 0.0) {
      least = std::fmin(least, std::abs(pole));
      largest = std::fmax(largest, std::abs(pole));
    }
  }
  const double end = std::fmin(response.highest, largest * std::pow(10.0, kDecadesBeyond));
  const double begin = std::fmin(least, end) * std::pow(10.0, -kDecadesBeyond);
  std::vector<double> w{0.0, end};
  const double ratio = std::pow(10.0, 1.0 / kPointsOfDecade);
  for (double x = begin; x < end; x *= ratio) {
    w.push_back(x);
  }
  for (double x = response.spacing; x < end; x += response.spacing) {
    w.push_back(x);
  }
  for (const Complex& pole : response.poles) {
    const double place = std::fabs(pole.imag());
    const double width = std::fmax(std::fabs(pole.real()), kMinPoleWidth * std::abs(pole));
    w.push_back(place);
    for (double away = 0.25 * width; away < end && away > 0.0; away *= 1.5) {
      w.push_back(place - away);
      w.push_back(place + away);
    }
  }
  w.erase(std::remove_if(w.begin(), w.end(), [end](double x) { return !(x >= 0.0 && x <= end); }),
          w.end());
  std::sort(w.begin(), w.end());
  // The order of two nearly equal ones would depend on rounding.
  w.erase(std::unique(w.begin(), w.end(),
                      [](double a, double b) { return b - a <= kSameFrequency * b; }),
          w.end());
  return w;
}

void findPeak(const LoopResponse& response, const std::vector<Point>& points, LoopMargins& m) {
  const auto fall = [&](double w) { return std::abs(1.0 + response.open_loop(w)); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto take = [&m](double w, double sensitivity) {
      if (sensitivity > m.sensitivity_peak) {
        m.sensitivity_peak = sensitivity;
        m.peak_frequency = w;
      }
    };
    take(points[i].frequency, points[i].sensitivity());
    const bool inside = i > 0 && i + 1 < points.size();
    if (inside && points[i].sensitivity() >= points[i - 1].sensitivity() &&
        points[i].sensitivity() >= points[i + 1].sensitivity()) {
      const auto [w, nearest] = boost::math::tools::brent_find_minima(
          fall, points[i - 1].frequency, points[i + 1].frequency,
          std::numeric_limits<double>::digits);
      take(w, 1.0 / nearest);
    }
  }
}

/// L at w, |L| = 1.
void takeCrossover(double w, const Complex& loop, LoopMargins& m) {
  const double phase = std::arg(-loop);  // to be lost until -1; in front of it negative
  if (std::fabs(phase) < m.phase_margin) {
    m.phase_margin = std::fabs(phase);
    m.phase_crossover = w;
  }
  if (w > 0.0) {
    m.delay_margin = std::fmin(m.delay_margin, (phase < 0.0 ? phase + 2.0 * kPi : phase) / w);
  }
}

/// L real.
void takeGain(double loop, LoopMargins& m) {
  if (loop < -1.0) {
    m.gain_reduction = std::fmax(m.gain_reduction, -1.0 / loop);
  } else if (loop < 0.0) {
    m.gain_margin = std::fmin(m.gain_margin, -1.0 / loop);
  }
}

bool isReal(const Complex& loop) {
  return std::fabs(loop.imag()) <= 1e-9 * std::fabs(loop.real());
}

void findCrossings(const LoopResponse& response, const std::vector<Point>& points, LoopMargins& m) {
  const auto size = [&](double w) { return std::log(std::abs(response.open_loop(w))); };
  const auto imaginary = [&](double w) { return response.open_loop(w).imag(); };
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point& a = points[i - 1];
    const Point& b = points[i];
    const double size_a = std::log(std::abs(a.loop));
    const double size_b = std::log(std::abs(b.loop));
    if ((size_a > 0.0) != (size_b > 0.0) && std::isfinite(size_a) && std::isfinite(size_b)) {
      const double w = bracketedRoot(size, a.frequency, b.frequency, size_a, size_b);
      takeCrossover(w, response.open_loop(w), m);
    }
    if ((a.loop.imag() > 0.0) != (b.loop.imag() > 0.0) &&
        (a.loop.real() < 0.0 || b.loop.real() < 0.0)) {
      const double w =
          bracketedRoot(imaginary, a.frequency, b.frequency, a.loop.imag(), b.loop.imag());
      takeGain(response.open_loop(w).real(), m);
    }
  }
  // At both ends L is real without a change of sign.
  for (const Point& end : {points.front(), points.back()}) {
    if (isReal(end.loop)) {
      takeGain(end.loop.real(), m);
    }
  }
}

/// The eigenvalues of L at a frequency.
struct Loci {
  double frequency;
  std::vector<Complex> values;
};

Loci lociAt(const LoopMatrixResponse& response, double w) {
  const Eigen::VectorXcd values = eigenvalues(response.open_loop(w)).values;
  return {w, {values.data(), values.data() + values.size()}};
}

bool isFiniteAt(const Loci& loci) {
  return std::all_of(loci.values.begin(), loci.values.end(), [](const Complex& value) {
    return std::isfinite(value.real()) && std::isfinite(value.imag());
  });
}

/// On Riemann's sphere: at an undamped pole of the loop an eigenvalue passes through infinity.
const Complex& nearestTo(const Complex& place, const std::vector<Complex>& values) {
  const auto distance = [&](const Complex& x) {
    return std::norm(x - place) / (1.0 + std::norm(x));
  };
  return *std::min_element(values.begin(), values.end(), [&](const Complex& x, const Complex& y) {
    return distance(x) < distance(y);
  });
}

/// The values of b in the order of those of a that they continue.
void continueLoci(const Loci& a, Loci& b) {
  std::vector<Complex> left = b.values;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const Complex found = nearestTo(a.values[i], left);
    left.erase(std::find(left.begin(), left.end(), found));
    b.values[i] = found;
  }
}

/// Where a function of an eigenvalue, of different signs at a and b, passes through 0; nothing
/// where it changes its sign otherwise.
template <class Function>
std::optional<std::pair<double, Complex>> passage(const LoopMatrixResponse& response, const Loci& a,
                                                  const Loci& b, std::size_t i,
                                                  const Function& of) {
  constexpr int kBisections = 60;
  constexpr double kZero = 1e-6;  // of the eigenvalue, or of 1
  std::pair<double, Complex> low{a.frequency, a.values[i]};
  std::pair<double, Complex> high{b.frequency, b.values[i]};
  const bool sign = of(low.second) > 0.0;
  for (int k = 0; k < kBisections; ++k) {
    const double w = 0.5 * (low.first + high.first);
    const Complex value = nearestTo(0.5 * (low.second + high.second), lociAt(response, w).values);
    ((of(value) > 0.0) == sign ? low : high) = {w, value};
  }
  if (!(std::fabs(of(high.second)) <= kZero * std::fmax(1.0, std::abs(high.second)))) {
    return std::nullopt;
  }
  return high;
}

}  // namespace

const char* name(SensitivityZone zone) {
  switch (zone) {
    case SensitivityZone::kA:
      return "A";
    case SensitivityZone::kB:
      return "B";
    case SensitivityZone::kC:
      return "C";
    case SensitivityZone::kD:
      return "D";
    case SensitivityZone::kUnbounded:
      break;
  }
  return "unbounded";
}

SensitivityZone zoneOf(double peak) {
  return peak < 3.0            ? SensitivityZone::kA
         : peak < 4.0          ? SensitivityZone::kB
         : peak <= 5.0         ? SensitivityZone::kC
         : std::isfinite(peak) ? SensitivityZone::kD
                               : SensitivityZone::kUnbounded;
}

LoopMargins loopMargins(const LoopResponse& response) {
  std::vector<Point> points;
  for (const double w : frequencies(response)) {
    const Complex loop = response.open_loop(w);
    if (std::isfinite(loop.real()) && std::isfinite(loop.imag())) {  // not at a pole of it
      points.push_back({w, loop});
    }
  }
  LoopMargins m;
  m.gain_margin = m.phase_margin = m.delay_margin = kInfinity;
  findPeak(response, points, m);
  if (m.sensitivity_peak < 1.0 - kRoundingOfPeak) {
    throw RunFailure(
        fmt::format("sensitivity: expected a peak of at least 1, as of every loop, found {}",
                    m.sensitivity_peak));
  }
  m.zone = zoneOf(m.sensitivity_peak);
  findCrossings(response, points, m);
  return m;
}

LoopMargins simultaneousMargins(const LoopMatrixResponse& response) {
  LoopMargins m;
  m.gain_margin = m.phase_margin = m.delay_margin = kInfinity;
  const auto size = [](const Complex& value) { return std::log(std::abs(value)); };
  const auto imaginary = [](const Complex& value) { return value.imag(); };
  const auto takeEnd = [&](const Loci& loci) {
    for (const Complex& value : loci.values) {
      if (isReal(value)) {
        takeGain(value.real(), m);
      }
    }
  };
  Loci before;
  for (const double w : frequencies(response)) {
    Loci now = lociAt(response, w);
    if (!isFiniteAt(now)) {
      continue;  // a pole
    }
    if (before.values.empty()) {
      takeEnd(now);
      before = now;
      continue;
    }
    continueLoci(before, now);
    for (std::size_t i = 0; i < now.values.size(); ++i) {
      const Complex& a = before.values[i];
      const Complex& b = now.values[i];
      if ((size(a) > 0.0) != (size(b) > 0.0)) {
        if (const auto found = passage(response, before, now, i, size)) {
          takeCrossover(found->first, found->second, m);
        }
      }
      if ((a.imag() > 0.0) != (b.imag() > 0.0) && (a.real() < 0.0 || b.real() < 0.0)) {
        if (const auto found = passage(response, before, now, i, imaginary)) {
          takeGain(found->second.real(), m);
        }
      }
    }
    before = now;
  }
  if (!before.values.empty()) {
    takeEnd(before);
  }
  return m;
}

double logSensitivityIntegral(const LoopResponse& response) {
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 15>;
  constexpr unsigned kDeepest = 10;
  constexpr double kTolerance = 1e-10;  // of the integral of |ln|S||
  constexpr double kNothing = 1e-13;    // likewise
  const auto logarithm = [&](double w) {
    // Of 1 + L, where L is small, to the digits of L.
    const Complex loop = response.open_loop(w);
    return -0.5 * std::log1p(2.0 * loop.real() + std::norm(loop));
  };
  std::vector<double> ends{0.0};
  for (const Complex& pole : response.poles) {
    ends.push_back(std::fabs(pole.imag()));
    ends.push_back(std::abs(pole));
  }
  ends.erase(
      std::remove_if(ends.begin(), ends.end(), [&](double w) { return !(w < response.highest); }),
      ends.end());
  ends.push_back(response.highest);
  std::sort(ends.begin(), ends.end());
  struct Piece {
    double begin, end;
    double value = 0.0, size = 0.0;
  };
  std::vector<Piece> pieces;
  double all = 0.0;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    if (ends[i] > ends[i - 1]) {
      Piece piece{ends[i - 1], ends[i]};
      piece.value =
          Quadrature::integrate(logarithm, piece.begin, piece.end, 0, 0.0, nullptr, &piece.size);
      all += piece.size;
      pieces.push_back(piece);
    }
  }
  double sum = 0.0;
  for (const Piece& piece : pieces) {
    // Between poles as good as the same, or before the first, there is nothing to be gained.
    sum += piece.size <= kNothing * all
               ? piece.value
               : Quadrature::integrate(logarithm, piece.begin, piece.end, kDeepest,
                                       kTolerance * all / std::fabs(piece.value));
  }
  return sum;
}

}  // namespace whirl_twin
