// The latest of a motion, with the angle of the shaft: as many samples a turn as orders need, as
// far back as a few turns take.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace whirl_twin {

/// What two probes and a keyphasor know of one instant.
struct OrbitSample {
  std::int64_t index = 0;  ///< increases by one from sample to sample; a gap is a lost sample
  double time = 0.0;       ///< [s]
  std::int64_t turns = 0;  ///< of the shaft, whole, from its phase mark
  double remainder = 0.0;  ///< [rad], and the rest of a turn
  double speed = 0.0;      ///< [rad/s]
  double x = 0.0;          ///< [m]
  double y = 0.0;          ///< [m]
};

/// Part of a motion, at equal distances but for holes.
struct OrbitPart {
  double centre = 0.0;              ///< [s]
  double half = 0.0;                ///< [s], to either end
  double speed = 0.0;               ///< [rad/s], at the centre
  double period = 0.0;              ///< [s], from sample to sample
  Eigen::ArrayXd tau;               ///< of the samples, -1..1
  Eigen::ArrayXd angle;             ///< [rad], of the shaft, from the first whole turn on
  std::int64_t turns = 0;           ///< whole turns before
  Eigen::ArrayXd x, y;              ///< [m]
  std::vector<std::int64_t> place;  ///< of each sample, in periods from the first
};

class OrbitWindow {
 public:
  /// Adds the next sample. An index or a time that decreases restarts the window; a sample that is
  /// not finite, or a duplicate of the last one, is ignored.
  void take(const OrbitSample& sample);
  void clear();

  bool empty() const { return kept_.empty(); }
  const OrbitSample& newest() const { return kept_.back(); }

  /// Time [s] since the shaft was `turns` turns back; 0 where it has not, where the samples do not
  /// reach, or where it was slower than half its highest speed meanwhile.
  double since(double turns) const;
  /// The samples of the last so many seconds, at most `most`, evenly.
  OrbitPart last(double seconds, std::size_t most) const;
  /// The larger of the peak-to-peak values [m] along x and y in the last so many seconds.
  double peakToPeak(double seconds) const;
  /// The largest distance [m] of the motion in the last so many seconds, and of `least` samples at
  /// least, from its middle, halfway between its extremes along x and y. Of an ellipse it is the
  /// semi-major axis, wherever the centre lies. NaN where there are fewer samples.
  double amplitude(double seconds, std::size_t least) const;

 private:
  struct Kept : OrbitSample {
    std::int64_t stride = 1;  // a power of two: of these indices samples were kept then
  };

  struct Box {
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
  };

  std::size_t firstOf(double seconds) const;
  /// Around the samples from this one on.
  Box boxFrom(std::size_t first) const;

  std::vector<Kept> kept_;
  std::int64_t stride_ = 1;
  std::int64_t last_ = 0;   // index of the last sample, kept or not
  double last_time_ = 0.0;  // [s]
  double sampling_ = 0.0;   // [s], from index to index
};

}  // namespace whirl_twin
