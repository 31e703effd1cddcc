// One step of a rotor of two coordinates by Gauss-Legendre nodes, which lie side by side in
// vectors: one polynomial for all sines and cosines, and for all else a product of a small matrix
// with a vector (lateral_run_up.h).
//
// While the acceleration a is constant, steps of one length h go on with e^(i theta) at the nodes
// where the last one had it, E, by two complex products (a chirp):
//
//   E <- E D,  D <- D e^(i a h^2),  D = e^(i (w h + a h^2 / 2)), w the speed at the node.
//
// Of so many such steps m the products leave some m^1.5 of rounding, and what the double of
// e^(i a h^2) leaves out m^2 / 2 of it: NodePhasors::kSteps of them less than 1e-14.
#pragma once

#include <array>
#include <cstddef>

#include "control/drive.h"
#include "integration/lateral_rotor.h"

namespace whirl_twin {

constexpr std::size_t kMostGaussNodes = 12;

/// Of one axis, for one length of step and 4, 8 or 12 nodes. Columns: a unit force at each node,
/// then a deflection and a rate at the start.
struct LateralGaussWeights {
  static constexpr std::size_t kColumns = kMostGaussNodes + 2;

  /// Columns of the rates at the nodes, then (increment of the deflection, of the rate, 0, 0).
  alignas(32) std::array<double, kColumns*(kMostGaussNodes + 4)> rates;
  /// Columns of the deflections at the nodes.
  alignas(32) std::array<double, kColumns * kMostGaussNodes> deflections;
};

/// e^(i theta) at the nodes of a step, and what turns it on to the next one.
struct NodePhasors {
  static constexpr int kSteps = 16;

  alignas(32) std::array<double, kMostGaussNodes> cosine, sine;
  alignas(32) std::array<double, kMostGaussNodes> turn_cosine, turn_sine;
  double growth_cosine, growth_sine;  ///< of a turn, from step to step
};

/// What a step does with them: nothing, makes them, or goes on with those of the step before.
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

/// What it makes of the motion.
struct LateralGaussResult {
  std::array<double, 4> increment;
  double work;  ///< [J]
};

using TakeLateralGaussStep = void (*)(const LateralGaussStep&, LateralGaussResult&) noexcept;
/// By so many nodes, for the processor this runs on.
TakeLateralGaussStep lateralGaussStep(std::size_t nodes) noexcept;

/// A step that goes on with the phasors of the last, both axes by the same weights and nothing
/// between them: what most steps of a run-up are.
struct LateralGaussGoOn {
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
using GoOnLateralGauss = StepStatus (*)(const LateralGaussGoOn&, LateralMotion&) noexcept;
GoOnLateralGauss lateralGaussGoOn(std::size_t nodes) noexcept;

}  // namespace whirl_twin
