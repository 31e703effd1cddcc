// The work done on a linear rotor during a step of a run-up,
//
//   dh/dt = q'^T (f - C q' - N q) + a q^T (dK/dw) q / 2,
//
// by five-point Gauss quadrature (order 10). Only the deflections z = L^T q at which forces and
// dampers act do work, often a few of many; in the step they are the Hermite interpolant of degree
// seven through their values and first three derivatives at both ends. The relative error of the
// work is (w h)^8 / 1e7 at a frequency w.
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "control/drive.h"
#include "integration/applied_inputs.h"
#include "integration/packed_matrix.h"
#include "integration/rotor_map.h"
#include "integration/shaft_nodes.h"
#include "mechanics/linear_rotor.h"
#include "realtime/state_image.h"

namespace whirl_twin {

/// The matrices of a cell of speeds as polynomials of s = (w - centre) / half_width.
struct RotorWorkCell {
  double centre = 0.0;      ///< [rad/s]
  double half_width = 1.0;  ///< [rad/s]
  /// From the inputs x, s x, s^2 x, a x, 2 s a x of the state x = (q, v), a = acceleration /
  /// half_width, then p, s p, s^2 p of the phasors, 1 and the inputs p, then p' to z, h z', h^2
  /// z'', h^3 z'''.
  PackedMatrix end;
  /// From z', s z', s^2 z', z, s z, s^2 z to L^T (C z' + N z) and L^T (dK/dw) z.
  PackedMatrix forces;
};

class RotorWork {
 public:
  RotorWork() = default;
  /// driven: the forces that turn with the shaft do work, which a shaft that moves by itself has of
  /// its own.
  RotorWork(const LinearRotor& rotor, const std::vector<ForceChannel>& channels,
            const AppliedInputs& acting, double h, const std::pair<double, double>& speeds,
            bool driven = true);

  RotorWorkCell cell(const LinearRotor& rotor, double low, double high) const;

  // Real-time safe. Shaft: a Drive or a ShaftCourse.

  /// The state no longer follows from the last step.
  void restart() noexcept { continued_ = false; }
  void exchange(StateImage& image) noexcept {
    image(from_, to_, continued_, last_acceleration_, last_jerk_);
  }
  /// The state (q, v) before the step that starts at offset [s], which the inputs have taken up.
  template <class Shaft>
  void start(RotorWorkCell& cell, const Shaft& drive, double offset, const AppliedInputs& acting,
             const Eigen::Ref<const Eigen::VectorXd>& state) noexcept;
  /// [J], with the state after it; `nodes` of the same step.
  template <class Shaft>
  double work(RotorWorkCell& cell, const Shaft& drive, double offset, const ShaftNodes& nodes,
              const AppliedInputs& acting, const Eigen::Ref<const Eigen::VectorXd>& state) noexcept;

 private:
  using Weights = Eigen::Matrix<double, 8, 2>;

  void evaluate(RotorWorkCell& cell, const ShaftMotion& shaft, const AppliedInputs& acting,
                double tau, const Eigen::Ref<const Eigen::VectorXd>& state,
                Eigen::VectorXd& end) noexcept;
  template <class Shaft>
  void takeJump(const Shaft& drive, double offset, double corner) noexcept;
  Weights weightsAt(double tau) const noexcept;
  void deflectionAt(double tau, const Weights& weights, double corner) noexcept;
  void takeNode(const RotorWorkCell& cell, const ShaftNode& node, const Weights& weights,
                double corner, std::size_t place) noexcept;
  double power(const ShaftNode& node, const AppliedInputs& acting, std::size_t place) noexcept;
  Eigen::Index phasorCount() const noexcept;
  void setPhasors(const ShaftMotion& shaft, double* phasors, double* rates) const noexcept;

  double h_ = 0.0;
  bool driven_ = true;
  std::vector<ForceChannel> channels_;
  Eigen::MatrixXd basis_;       ///< L [n x size], orthonormal columns
  Eigen::MatrixXd directions_;  ///< of the inputs [n x .]
  Eigen::MatrixXd
      force_;  ///< L^T F of every channel, real and minus imaginary, then of every input
  Eigen::MatrixXd acceleration_by_force_;  ///< L^T M^-1 F of channels, load and inputs
  Eigen::Matrix<double, 8, 8> hermite_;    ///< powers of tau as weights of the data at the ends
  std::array<Weights, ShaftNodes::kNodes.size()> weights_;  ///< at the nodes of a plain step
  // Work space of a step.
  Eigen::VectorXd from_, to_;  ///< z and its derivatives at the ends
  bool continued_ = false;     ///< from_ may be taken from the last step
  double last_acceleration_ = 0.0, last_jerk_ = 0.0;
  Eigen::VectorXd jump_;  ///< h^2 z'' and h^3 z''', at a breakpoint
  Eigen::VectorXd inputs_, phasors_, rates_;
  Eigen::VectorXd z_, z_rate_, pull_;
  Eigen::VectorXd moved_, pulled_;  ///< of RotorWorkCell::forces, for PackedMatrix::kTogether nodes
};

}  // namespace whirl_twin
