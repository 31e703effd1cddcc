// What acts on an input of a followed machine, as a sensor shows it: held from sample to sample, or
// the straight line between them.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

namespace whirl_twin {

/// A sample of an input.
struct InputSample {
  std::int64_t time = 0;  ///< [ns]
  double value = 0.0;     ///< in the input's unit
};

class FollowedInput {
 public:
  /// deviation: standard deviation of a sample, in the input's unit.
  FollowedInput(bool hold, double deviation) : hold_(hold), deviation_(deviation) {}

  /// The next sample; one that is not later than the last is left out.
  void take(const InputSample& sample);
  /// Instants before this one [ns] are asked for no more.
  void forgetBefore(std::int64_t instant);

  /// Before the first sample it is not.
  bool known() const { return !samples_.empty(); }
  /// An offset [s] after an instant [ns]; beyond the samples the nearest of them.
  double at(std::int64_t instant, double offset) const;
  /// Its samples between two instants [ns]: it has a corner there.
  void addCorners(std::int64_t from, std::int64_t to, std::vector<std::int64_t>& corners) const;
  /// Noise of its samples as white noise [unit^2/Hz]: each lasts to the next.
  double noiseDensity() const { return deviation_ * deviation_ * spacing_; }

 private:
  bool hold_;
  double deviation_;
  double spacing_ = 0.0;  // [s], of the last two samples
  std::deque<InputSample> samples_;
};

}  // namespace whirl_twin
