// The inputs of a linear system that act, as columns of what steps it (control/inputs.h).
//
// Each is a pair of columns: (u, u' unit) of a straight line in time, or amplitude times (cos, sin)
// of a harmonic's own phase. Both follow a linear law of their own, z' = G z, so that with them the
// states form one linear system and e^(A h) steps it exactly, at resonance or not.
//
// Where a step's matrices are not constant anyway (rotor_step.h, run-ups), a course over the step
// is wanted instead: harmonics as they are, straight lines as cubics of the time in it. A corner
// inside such a step is projected (Legendre), the impulse and three further moments of it exact: (w
// h)^4 / 1e3 of the jump is left at a frequency w.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "control/inputs.h"

namespace whirl_twin {

class ActingInputs {
 public:
  static constexpr int kDegree = 3;  ///< of a course

  ActingInputs() = default;
  /// `directions`: a column for each of `inputs`, which outlive this; nullptr: there are none.
  ActingInputs(const Inputs* inputs, const Eigen::MatrixXd& directions);

  Eigen::Index count() const { return directions_.cols(); }
  const Eigen::MatrixXd& directions() const { return directions_; }  ///< [n x count]
  bool isHarmonic(Eigen::Index k) const { return channel(k).harmonic; }
  /// G of a pair, whose second number of a straight line is u' unit. [1/s]
  Eigen::Matrix2d generator(Eigen::Index k, double unit) const;
  /// May a step have a corner inside?
  bool haveTables() const { return tables_; }

  // Real-time safe.

  /// See Inputs; kNever where nothing acts.
  std::int64_t nextCorner(std::int64_t offset) const noexcept {
    return inputs_ == nullptr ? Inputs::kNever : inputs_->nextCorner(offset);
  }
  /// The pairs at an offset [s] after begin(), in the piece that starts at or before `piece` [ns].
  void writePairs(double offset, std::int64_t piece, double unit, double* out) const noexcept;

  /// Takes up a step of h [s] from an offset [s].
  void follow(double offset, double h) noexcept;
  /// Of that step: the pair of each harmonic at its start, the coefficients of 1, tau, tau^2, tau^3
  /// of any other, tau the time in parts of h.
  void writeCourses(double* out) const noexcept;
  Eigen::Index courseSize(Eigen::Index k) const { return isHarmonic(k) ? 2 : kDegree + 1; }
  /// u and u' [1/s] at tau.
  double value(Eigen::Index k, double tau) const noexcept;
  double rate(Eigen::Index k, double tau) const noexcept;

 private:
  struct Channel {
    std::size_t input;
    bool harmonic;
    double amplitude, frequency;  // [rad/s]
    // Over the step taken up.
    double phase;  // [rad], at its start
    std::array<double, kDegree + 1> course;
  };
  const Channel& channel(Eigen::Index k) const { return channels_[static_cast<std::size_t>(k)]; }
  void project(Channel& channel, double offset) const noexcept;

  const Inputs* inputs_ = nullptr;
  std::vector<Channel> channels_;
  Eigen::MatrixXd directions_;
  bool tables_ = false;
  double h_ = 1.0;  ///< [s], of the step taken up
};

}  // namespace whirl_twin
