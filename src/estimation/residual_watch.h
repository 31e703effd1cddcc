// Whether what is measured is what the model predicts, no better and no worse: the innovations of a
// filter, each over the deviation that the filter expects of it, are independent standard normal
// numbers if the model is the machine. Over windows one after the other this looks at
//
//   mismatch   the mean of their squares; of n numbers it is chi-squared over n about 1
//   whiteness  sum e_k e_(k-1) / sum e_k^2, channel by channel along time; about 0 with a deviation
//              of 1/sqrt(n) of n pairs, tails lighter than normal
//
// with limits from a rate of false alarms: half of it to each of the two, and of a half again half
// to each end. What is too large has forces or noise that the model has not, what is too small has
// less noise than it was told, and what is not white is predicted wrongly in a way that lasts.
//
// A part of what is expected may be an allowance, as for a shaft whose angle is off by as much for
// a while: residuals that are smaller by no more than the allowance are no mismatch. The mean of
// the squares is then 1, or as far below as without it.
//
// It assumes that a window's numbers are independent, among channels of one instant, too: those of
// several channels come one after the other (sequential updates), or from nu' S^-1 nu's root.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace whirl_twin {

struct ResidualWatchSettings {
  double window = 1.0;          ///< [s]; longer where a window has too few numbers
  double false_alarms = 0.005;  ///< [1/h], of all its limits together
};

class ResidualWatch {
 public:
  /// Of at most so many channels (a complex innovation is two).
  explicit ResidualWatch(std::size_t channels, const ResidualWatchSettings& settings = {});

  struct Verdict {
    double time = std::numeric_limits<double>::quiet_NaN();  ///< [s], where its window ended
    // [-]; NaN before the first window has ended
    double mismatch = std::numeric_limits<double>::quiet_NaN();
    double mismatch_least = std::numeric_limits<double>::quiet_NaN();
    double mismatch_limit = std::numeric_limits<double>::quiet_NaN();
    double whiteness = std::numeric_limits<double>::quiet_NaN();
    double whiteness_limit = std::numeric_limits<double>::quiet_NaN();  ///< of its magnitude

    bool mismatched() const { return mismatch > mismatch_limit || mismatch < mismatch_least; }
    bool coloured() const { return whiteness > whiteness_limit || whiteness < -whiteness_limit; }
  };

  // Real-time safe:
  /// The normalised innovations of an instant [s], one a channel, at most as many as there are;
  /// NaN: the channel had none. An instant before the last one begins anew. True where it has ended
  /// a window.
  /// surest: likewise, over the deviations without the allowance in them; none: the same.
  bool take(double time, const double* innovation, std::size_t channels,
            const double* surest = nullptr);
  /// The present window begins anew, and its last instant is forgotten; the verdict stays.
  void restart();
  /// Of the last window.
  const Verdict& verdict() const { return verdict_; }

 private:
  void judge(double time);

  double window_;
  double z_;                  // normal limit of each end
  std::vector<double> last_;  // of each channel; NaN: none
  double begin_;              // [s], of the window; NaN: none has begun
  double newest_;             // [s]
  std::size_t numbers_ = 0;
  std::size_t pairs_ = 0;
  double squares_ = 0.0;
  double surest_ = 0.0;  // likewise without the allowance: as large or larger
  double products_ = 0.0;
  Verdict verdict_;
};

}  // namespace whirl_twin
