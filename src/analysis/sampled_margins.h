// Margins of a sampled loop: with all of its places changed at once, and at each alone, all other
// loops closed (loop_margins.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "analysis/loop_margins.h"
#include "analysis/sampled_stability.h"

namespace whirl_twin {

/// Where a controller's loop is opened, one place after another: at each of its sensors or, which
/// is at the input of the plant, at each of its outputs.
enum class LoopSide : std::uint8_t { kSensors, kOutputs };

/// For each place in turn the response of the loop opened there, all others closed, in z = exp(i w
/// T), T the period of the controller: 1 + L = 1 / S. With faster controllers the response is that
/// of its samples; with a controller whose rate is not an integer multiple the loop also returns
/// other frequencies (aliasing), and S is the component at the same frequency. Errors as loopTap().
std::vector<LoopResponse> sampledResponses(const LoopPlant& plant,
                                           const std::vector<LoopController>& controllers,
                                           std::size_t controller,
                                           LoopSide side = LoopSide::kSensors);

struct SampledMargins : LoopMargins {
  /// |integral of ln|S| - (pi / T) sum ln|p|| over pi / T, the deviation from Bode's integral:
  /// rounding. NaN for a loop with long delays, whose open-loop poles are not all computed.
  double bode_error = 0.0;
};

/// Of each place in turn; `verdict` is that of sampledStability(). Not stable: no margins, and a
/// sensitivity without bound. The delay is the phase over the frequency: exact in whole samples,
/// for delays between them to the second order of the period. Where S is only the part at the same
/// frequency (sampledResponses) gain, phase and delay margin and Bode's integral are NaN. Errors as
/// loopMargins() and loopTap().
std::vector<SampledMargins> sampledMargins(const LoopPlant& plant,
                                           const std::vector<LoopController>& controllers,
                                           std::size_t controller, Verdict verdict,
                                           LoopSide side = LoopSide::kSensors);

/// The margin of the loop when all sensors of all controllers change alike, or, which is the same,
/// all outputs (simultaneousMargins()): NaN where their rates differ.
LoopMargins sampledMarginsAtOnce(const LoopPlant& plant,
                                 const std::vector<LoopController>& controllers, Verdict verdict);

/// The minimum of each margin, and the highest peak with its zone; of `at_once` and all others.
LoopMargins leastMargins(const LoopMargins& at_once, const std::vector<SampledMargins>& margins);

}  // namespace whirl_twin
