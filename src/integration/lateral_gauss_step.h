// One step of a rotor of two coordinates by Gauss-Legendre nodes, which are evaluated together in
// SIMD vectors: one polynomial for all sines and cosines, and products of a small matrix with a
// vector for the other operations (lateral_run_up.h).
//
// While the acceleration a is constant, steps of one length h continue from e^(i theta) at the
// nodes of the last step, E, by two complex products (a chirp):
//
//   E <- E D,  D <- D e^(i a h^2),  D = e^(i (w h + a h^2 / 2)), w the speed at the node.
//
// After m such steps the rounding of the products is some m^1.5 units, and that of e^(i a h^2)
// contributes m^2 / 2: less than 1e-14 for NodePhasors::kSteps steps.
#pragma once

#include <array>
#include <cstddef>

#include "control/drive.h"
#include "integration/lateral_rotor.h"

namespace whirl_twin {

constexpr std::size_t kMaxGaussNodes = 12;

/// Of one axis, for one length of step and 4, 8 or 12 nodes. Columns: a unit force at each node,
/// then a deflection and a rate at the start.
struct LateralGaussWeights {
  static constexpr std::size_t kColumns = kMaxGaussNodes + 2;

  /// Columns of the rates at the nodes, then (increment of the deflection, of the rate, 0, 0).
  alignas(32) std::array<double, kColumns*(kMaxGaussNodes + 4)> rates;
  /// Columns of the deflections at the nodes.
  alignas(32) std::array<double, kColumns * kMaxGaussNodes> deflections;
};

/// e^(i theta) at the nodes of a step, and what turns it on to the next one.
struct NodePhasors {
  static constexpr int kSteps = 16;

  alignas(32) std::array<double, kMaxGaussNodes> cosine, sine;
  alignas(32) std::array<double, kMaxGaussNodes> turn_cosine, turn_sine;
  double growth_cosine, growth_sine;  ///< of a turn, from step to step
};

/// Use of the phasors in a step: none, compute them, or continue from those of the step before.
enum class PhasorUse { kNone, kBegin, kGoOn };

struct LateralGaussStep {
  const LateralRotor& rotor;
  const double* nodes;    ///< 0..1, aligned to 32 bytes
  const double* weights;  ///< sum 1, likewise
  std::array<const LateralGaussWeights*, 2> axes;
  double length;      ///< [s]
  ShaftMotion shaft;  ///< at its start
  int sweeps;         ///< for what couples the axes
  const std::array<double, 4>& y;
  PhasorUse use;
  NodePhasors& phasors;
};

/// The resulting motion.
struct LateralGaussResult {
  std::array<double, 4> increment;
  double work;  ///< [J]
};

using TakeLateralGaussStep = void (*)(const LateralGaussStep&, LateralGaussResult&) noexcept;
/// By so many nodes, for the processor this runs on.
TakeLateralGaussStep lateralGaussStep(std::size_t nodes) noexcept;

/// A step that continues with the phasors of the last, both axes with equal weights and uncoupled:
/// the most frequent step of a run-up.
struct LateralGaussContinuation {
  const LateralRotor& rotor;
  const double* nodes;    ///< as above
  const double* weights;  ///< likewise
  const LateralGaussWeights& axis;
  double length;        ///< [s]
  double speed;         ///< [rad/s], of the shaft at its start
  double acceleration;  ///< [rad/s^2], throughout
  NodePhasors& phasors;
};

/// Advances the motion; one that would not be finite stays as it was.
using GoOnLateralGauss = StepStatus (*)(const LateralGaussContinuation&, LateralMotion&) noexcept;
GoOnLateralGauss lateralGaussContinuation(std::size_t nodes) noexcept;

}  // namespace whirl_twin
