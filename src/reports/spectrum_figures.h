// The full spectra of a recorded whirl as pictures: one with its lines named, and many as a
// cascade. Forward, in the direction of rotation, is to the right, backward to the left.
#pragma once

#include <string>
#include <vector>

#include "reports/figure.h"
#include "signal/spectrum_cascade.h"

namespace whirl_twin {

/// "1X", "2X", else the ratio to the speed, "0.28X"; at standstill "".
std::string lineName(const SpectrumLine& line);
/// "1X forward 0.52 mm", "0.28X forward (40.0 rad/s) 12 um".
std::string lineText(const SpectrumLine& line);

/// Class of the subsynchronous components, as far as the change of speed identifies it;
/// "" where there are none, or it does not.
std::string subsynchronousText(const std::vector<WindowSpectrum>& spectra);

/// One spectrum, amplitudes on a logarithmic axis.
Chart spectrumChart(const WindowSpectrum& spectrum);
/// Over the speed where that went up or down for most of the time, else over time; spectra are at
/// least two.
Chart cascadeChart(const std::vector<WindowSpectrum>& spectra);

}  // namespace whirl_twin
