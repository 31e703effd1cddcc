#include "signal/spectrum_cascade.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>

#include "algebra/constants.h"
#include "signal/full_spectrum.h"

namespace whirl_twin {

namespace {

constexpr double kShortest = 0.25;          // [s], of a window, however fast the speed changes
constexpr double kMaxSpectrumWindow = 4.0;  // [s]
constexpr std::size_t kMaxSpectrumSamples = 8192;  // of a window
constexpr std::size_t kMinSpectrumSamples = 64;    // likewise
constexpr double kFirst = 1.0;                     // [s], until the first spectrum
constexpr double kOften = 0.25;                    // [s], from one to the next at first
constexpr std::size_t kMaxSpectra = 96;            // then every second one goes
constexpr double kSamplesATurn = 2.5;         // at least: below two the shaft is not seen to turn
constexpr std::size_t kMaxSpectrumLines = 8;  // of a spectrum
constexpr double kMinSpectrumLine = 0.01;     // of the largest: side lobes are below
constexpr double kAboveNoise = 4.0;           // times the median: noise hardly reaches it

double medianOf(const FullSpectrum& spectrum) {
  std::vector<double> all(spectrum.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = spectrum.amplitude(i);
  }
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2),
                   all.end());
  return all[all.size() / 2];
}

SpectrumLine named(const FullSpectrum::Peak& peak, const WindowSpectrum& window) {
  SpectrumLine line;
  line.frequency = peak.frequency;
  line.amplitude = peak.amplitude;
  line.ratio = std::fabs(peak.frequency / window.speed);
  const double order = std::round(line.ratio);
  const double off = std::fabs(line.ratio - order) * std::fabs(window.speed);
  if (order >= 1.0 && off < window.resolution + 0.5 * order * window.smear) {
    line.order = static_cast<int>(order);
  }
  return line;
}

std::vector<SpectrumLine> linesOf(const FullSpectrum& spectrum, const WindowSpectrum& window) {
  const double noise = kAboveNoise * medianOf(spectrum);
  std::vector<SpectrumLine> lines;
  const auto apart = [&](double frequency) {
    return std::fabs(frequency) > window.resolution &&
           std::all_of(lines.begin(), lines.end(), [&](const SpectrumLine& line) {
             const double smear = window.smear * std::max(1.0, line.ratio);
             const double near = 2.0 * window.resolution + (std::isfinite(smear) ? smear : 0.0);
             return std::fabs(frequency - line.frequency) > near;
           });
  };
  while (lines.size() < kMaxSpectrumLines) {
    const auto peak = spectrum.highest(apart);
    if (!peak || peak->amplitude < noise ||
        (!lines.empty() && peak->amplitude < kMinSpectrumLine * lines.front().amplitude)) {
      break;
    }
    lines.push_back(named(*peak, window));
  }
  return lines;
}

/// Two bins in one, the higher of them: a line is some eight bins wide.
void keepHalf(const FullSpectrum& spectrum, WindowSpectrum& window) {
  window.first = 0.5 * (spectrum.frequency(0) + spectrum.frequency(1));
  window.step = 2.0 * (spectrum.frequency(1) - spectrum.frequency(0));
  for (std::size_t i = 0; i + 1 < spectrum.size(); i += 2) {
    window.amplitude.push_back(
        static_cast<float>(std::max(spectrum.amplitude(i), spectrum.amplitude(i + 1))));
  }
}

bool finite(const OrbitSample& sample) {
  return std::isfinite(sample.time) && std::isfinite(sample.speed) && std::isfinite(sample.x) &&
         std::isfinite(sample.y);
}

}  // namespace

void SpectrumCascade::take(const OrbitSample& sample) {
  if (!finite(sample)) {
    return;
  }
  if (!kept_.empty()) {
    const std::int64_t stride = sample.index - kept_.back().index;
    if (stride == 0) {
      return;
    }
    if (stride < 0) {
      *this = {};
    } else if (kept_.size() > 1 && stride != stride_) {
      kept_.clear();
    }
    stride_ = stride;
  }
  if (kept_.empty() && spectra_.empty()) {
    due_ = sample.time + kFirst;
    every_ = kOften;
  }
  kept_.push_back(sample);
  while (kept_.size() > kMaxSpectrumSamples ||
         sample.time - kept_.front().time > kMaxSpectrumWindow) {
    kept_.pop_front();
  }
  if (sample.time < due_) {
    return;
  }
  if (std::optional<WindowSpectrum> spectrum = latest()) {
    spectra_.push_back(std::move(*spectrum));
  }
  if (spectra_.size() == kMaxSpectra) {
    for (std::size_t i = 0; 2 * i + 1 < kMaxSpectra; ++i) {
      spectra_[i] = std::move(spectra_[2 * i + 1]);
    }
    spectra_.resize(kMaxSpectra / 2);
    every_ *= 2.0;
  }
  due_ = sample.time + every_;
}

std::optional<WindowSpectrum> SpectrumCascade::latest() const {
  if (kept_.size() < kMinSpectrumSamples) {
    return std::nullopt;
  }
  const double whole = kept_.back().time - kept_.front().time;
  if (!(whole > 0.0)) {
    return std::nullopt;  // time stamps may be invalid
  }
  const double period = whole / static_cast<double>(kept_.size() - 1);
  const double rate = std::fabs(kept_.back().speed - kept_.front().speed) / whole;
  const double sharp = std::max(kShortest, std::sqrt(4.0 * kPi / rate));
  const double reach = std::min(sharp, whole + period);
  const auto count =
      std::max(kMinSpectrumSamples, static_cast<std::size_t>(std::lround(reach / period)));
  const std::size_t begin = kept_.size() - std::min(count, kept_.size());
  const auto samples = static_cast<Eigen::Index>(kept_.size() - begin);

  Eigen::ArrayXcd z(samples);
  std::complex<double> mean = 0.0;  // with the weights of the spectrum: it leaves nothing at 0
  for (Eigen::Index i = 0; i < samples; ++i) {
    const OrbitSample& sample = kept_[begin + static_cast<std::size_t>(i)];
    const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(samples);
    z[i] = {sample.x, sample.y};
    mean += (1.0 - std::cos(2.0 * kPi * at)) * z[i] / static_cast<double>(samples);
  }
  z -= mean;

  WindowSpectrum window;
  window.begin = kept_[begin].time;
  window.end = kept_.back().time;
  window.speed = kept_[begin + static_cast<std::size_t>(samples) / 2].speed;
  window.smear = std::fabs(kept_.back().speed - kept_[begin].speed);
  if (kSamplesATurn * std::fabs(window.speed) * period > 2.0 * kPi) {
    return std::nullopt;
  }
  if (window.speed < 0.0) {
    z = z.conjugate().eval();
  }
  const FullSpectrum spectrum(z, period);
  window.resolution = spectrum.resolution();
  window.lines = linesOf(spectrum, window);
  keepHalf(spectrum, window);
  return window;
}

}  // namespace whirl_twin
