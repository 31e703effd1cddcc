// One step of a rotor of two coordinates by Gauss-Legendre nodes, which lie side by side in
// vectors: one polynomial for all sines and cosines, and for all else a product of a small matrix
// with a vector (lateral_run_up.h).
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

struct LateralGaussStep {
  const LateralRotor& rotor;
  const double* nodes;    ///< 0..1, aligned to 32 bytes
  const double* weights;  ///< sum 1, likewise
  const std::array<LateralGaussWeights, 2>& axes;
  double length;      ///< [s]
  ShaftMotion shaft;  ///< at its start
  int sweeps;         ///< for what couples the axes
  const std::array<double, 4>& y;
};

/// What it makes of the motion.
struct LateralGaussResult {
  std::array<double, 4> increment;
  double work;  ///< [J]
};

using TakeLateralGaussStep = void (*)(const LateralGaussStep&, LateralGaussResult&) noexcept;
/// By so many nodes, for the processor this runs on.
TakeLateralGaussStep lateralGaussStep(std::size_t nodes) noexcept;

}  // namespace whirl_twin
