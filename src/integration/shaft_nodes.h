// The motion of a shaft at the nodes of a quadrature over one step, piecewise between the
// breakpoints of the drive's profile, so that no breakpoint reduces the order of the quadrature.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

#include "control/drive.h"

namespace whirl_twin {

/// e^(i phase), quickly where the phase is small.
inline std::complex<double> smallTurn(double phase) noexcept {
  if (std::fabs(phase) > 0.01) {
    return {std::cos(phase), std::sin(phase)};
  }
  const double square = phase * phase;
  return {1.0 - 0.5 * square * (1.0 - square / 12.0 * (1.0 - square / 30.0)),
          phase * (1.0 - square / 6.0 * (1.0 - square / 20.0))};
}

struct ShaftNode {
  double tau;     ///< [-], 0..1 of the step
  double weight;  ///< [-], sum 1
  ShaftMotion shaft;
  double lead;                ///< [rad], theta - theta_0 - mean speed times time
  std::complex<double> turn;  ///< e^(i theta)
};

class ShaftNodes {
 public:
  /// Samples a step of h [s] from offset [s] after the drive's begin(). Real-time safe. Shaft: a
  /// Drive or a ShaftCourse.
  template <class Shaft>
  void sample(const Shaft& drive, double offset, double h) noexcept {
    const ShaftMotion start = drive.at(offset);
    const ShaftMotion end = drive.at(offset + h);
    start_turn_ = {std::cos(start.angle), std::sin(start.angle)};
    mean_speed_ = (end.angle - start.angle) / h;
    count_ = 0;
    mean_lead_ = 0.0;
    first_corner_ = 1.0;
    double from = 0.0;
    while (from < 1.0) {
      const double corner = (drive.nextCorner(offset + from * h) - offset) / h;
      const bool inside = corner < 1.0 - kSliver && count_ + 2 * kNodes.size() <= nodes_.size();
      const double to = inside ? std::fmax(corner, from + kSliver) : 1.0;
      if (inside && corner > kSliver && first_corner_ == 1.0) {
        first_corner_ = corner;
      }
      for (std::size_t i = 0; i < kNodes.size(); ++i) {
        ShaftNode& node = nodes_[count_++];
        node.tau = from + kNodes[i] * (to - from);
        node.weight = kWeights[i] * (to - from);
        node.shaft = drive.at(offset + node.tau * h);
        const double turned = node.shaft.angle - start.angle;
        node.lead = turned - mean_speed_ * node.tau * h;
        node.turn = start_turn_ * std::complex<double>(std::cos(turned), std::sin(turned));
        mean_lead_ += node.weight * node.lead;
      }
      from = to;
    }
  }

  const ShaftNode* begin() const noexcept { return nodes_.data(); }
  const ShaftNode* end() const noexcept { return nodes_.data() + count_; }
  double meanSpeed() const noexcept { return mean_speed_; }  ///< [rad/s]
  double meanLead() const noexcept { return mean_lead_; }    ///< [rad]
  std::complex<double> startTurn() const noexcept { return start_turn_; }
  /// Where in the step the acceleration or jerk first jumps; 1 if nowhere inside.
  double firstCorner() const noexcept { return first_corner_; }

  /// No breakpoint inside: the nodes are kNodes.
  bool plain() const noexcept { return count_ == kNodes.size(); }

  /// Of a step: a breakpoint this near its ends is rounding.
  static constexpr double kSliver = 1.0e-11;
  /// Gauss-Legendre, order 10.
  static constexpr std::array<double, 5> kNodes{0.046910077030668003601, 0.23076534494715845448,
                                                0.5, 0.76923465505284154552,
                                                0.95308992296933199640};

 private:
  static constexpr std::array<double, 5> kWeights{0.11846344252809454376, 0.23931433524968323402,
                                                  0.28444444444444444444, 0.23931433524968323402,
                                                  0.11846344252809454376};

  std::array<ShaftNode, 20> nodes_;
  std::size_t count_ = 0;
  double mean_speed_ = 0.0;
  double mean_lead_ = 0.0;
  double first_corner_ = 1.0;
  std::complex<double> start_turn_;
};

}  // namespace whirl_twin
