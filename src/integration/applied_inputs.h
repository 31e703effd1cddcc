// The active inputs of a linear system, as columns of its step matrix (control/inputs.h).
//
// Each is a pair of columns: (u, u' unit) of a linear function of time, or of one whose slope
// decays as e^(-t / lag), behind an actuator; or amplitude times (cos, sin) of a harmonic's phase.
// All satisfy a linear equation z' = G z, so that states and inputs form one linear system that
// e^(A h) steps exactly, at resonance or not.
//
// Where a step's matrices are not constant anyway (rotor_step.h, run-ups), a function of time over
// the step is used instead: harmonics and lags unchanged, linear functions as cubics of the time in
// the step. A breakpoint inside such a step is projected (Legendre) with exact impulse and three
// further moments: the residual error is (w h)^4 / 1e3 of the jump at a frequency w.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "control/inputs.h"

namespace whirl_twin {

class AppliedInputs {
 public:
  static constexpr int kDegree = 3;  ///< of a course

  AppliedInputs() = default;
  /// `directions`: a column for each of `inputs`, which outlive this; nullptr: there are none.
  /// `pushes`: columns of forces that are no inputs, whose courses are set for every step; with
  /// any, all but pairs are courses at constant speed too, so that a breakpoint may be inside any
  /// step.
  AppliedInputs(const Inputs* inputs, const Eigen::MatrixXd& directions,
                const Eigen::MatrixXd& pushes = {});

  Eigen::Index count() const { return directions_.cols(); }
  const Eigen::MatrixXd& directions() const { return directions_; }  ///< [n x count]
  bool isHarmonic(Eigen::Index k) const { return channel(k).harmonic; }
  /// Does it keep its pair in a course?
  bool isPair(Eigen::Index k) const { return channel(k).harmonic || channel(k).pole > 0.0; }
  /// G of a pair, whose second number, but of a harmonic, is u' unit. [1/s]
  Eigen::Matrix2d generator(Eigen::Index k, double unit) const;
  /// Whether a step may contain a breakpoint at which it must be divided.
  bool haveTables() const { return tables_ && pushes_ == 0; }
  /// Are there forces that are no inputs?
  bool arePushed() const { return pushes_ > 0; }

  // Real-time safe.

  /// See Inputs; kNever where nothing acts.
  std::int64_t nextCorner(std::int64_t offset) const noexcept {
    return inputs_ == nullptr ? Inputs::kNever : inputs_->nextCorner(offset);
  }
  /// The pairs at an offset [s] after begin(), in the piece that starts at or before `piece` [ns].
  void writePairs(double offset, std::int64_t piece, double unit, double* out) const noexcept;

  /// The course of one of the forces that are no inputs, over the next step: the coefficients of 1,
  /// tau, tau^2, tau^3.
  void push(std::size_t force, const std::array<double, kDegree + 1>& course) noexcept {
    channels_[channels_.size() - pushes_ + force].course = course;
  }
  /// Takes up a step of h [s] from an offset [s].
  void follow(double offset, double h) noexcept;
  /// Of that step: the pair at its start of each that isPair(), in units of h, the coefficients of
  /// 1, tau, tau^2, tau^3 of any other, tau the time in parts of h.
  void writeCourses(double* out) const noexcept;
  Eigen::Index courseSize(Eigen::Index k) const { return isPair(k) ? 2 : kDegree + 1; }
  /// Columns of a step whose forcing is a polynomial of this degree: 0 at constant speed.
  Eigen::Index columns(Eigen::Index k, int degree) const {
    return degree == 0 && pushes_ == 0 ? 2 : courseSize(k);
  }
  /// u and u' [1/s] at tau.
  double value(Eigen::Index k, double tau) const noexcept;
  double rate(Eigen::Index k, double tau) const noexcept;

 private:
  static constexpr std::size_t kPush = static_cast<std::size_t>(-1);
  struct Channel {
    std::size_t input;  // kPush: none
    bool harmonic;
    double amplitude, frequency;  // [rad/s]
    double pole;                  // [1/s]; 0: no lag
    // Over the step taken up.
    double phase;  // [rad], at its start
    std::array<double, kDegree + 1> course;
    SignalPiece lag;
  };
  const Channel& channel(Eigen::Index k) const { return channels_[static_cast<std::size_t>(k)]; }
  void takeInputs(const Inputs& inputs, const Eigen::MatrixXd& directions);
  void project(Channel& channel, double offset) const noexcept;

  const Inputs* inputs_ = nullptr;
  std::vector<Channel> channels_;
  Eigen::MatrixXd directions_;
  bool tables_ = false;
  std::size_t pushes_ = 0;
  double h_ = 1.0;       ///< [s], of the step taken up
  double offset_ = 0.0;  ///< [s], at which it starts
};

}  // namespace whirl_twin
