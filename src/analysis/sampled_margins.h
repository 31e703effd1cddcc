// Margins of a sampled loop at each of its sensors, all other loops closed (loop_margins.h).
#pragma once

#include <vector>

#include "analysis/loop_margins.h"
#include "analysis/sampled_stability.h"

namespace whirl_twin {

/// Of each measure of a controller in turn the loop opened where it is shown, in z = exp(i w T), T
/// its own period: 1 + L = 1 / S. With controllers faster than it the response is that of its
/// samples; with one whose rate is no whole multiple of its own, what goes round comes back at
/// other frequencies, too, and S is the part that keeps its own. Errors as loopTap().
std::vector<LoopResponse> sampledResponses(const LoopPlant& plant,
                                           const std::vector<LoopController>& controllers,
                                           std::size_t controller);

struct SampledMargins : LoopMargins {
  /// |integral of ln|S| - (pi / T) sum ln|p|| over pi / T, of what Bode's integral says: rounding.
  double bode_error = 0.0;
};

/// Of each measure of a controller in turn; `verdict` is that of sampledStability(). Not stable: no
/// margins, and a sensitivity without bound. The delay is the phase over the frequency: exact in
/// whole samples, for delays between them to the second order of the period. Where S is only the
/// part at the same frequency (sampledResponses) gain, phase and delay margin and Bode's integral
/// are NaN. Errors as loopMargins() and loopTap().
std::vector<SampledMargins> sampledMargins(const LoopPlant& plant,
                                           const std::vector<LoopController>& controllers,
                                           std::size_t controller, Verdict verdict);

/// The least of each margin, and the highest peak with its zone; of one at least.
LoopMargins leastMargins(const std::vector<SampledMargins>& margins);

}  // namespace whirl_twin
