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
#include <cstdint>
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

// Whether a parameter that a filter estimates has become another, by how far its estimate x has
// gone from a reference x0, learned in a warm-up of n samples. Two statistics, each for both
// senses:
//
//   distance   |x_k - x0| / s0, with s0^2 = max(P, scatter of the warm-up) (1 + 1/n')
//   sum        a cumulative sum (cusum) of what is new in a sample,
//              w_k = ((x_k - x0) - r (x_(k-1) - x0)) / s
//              up_k = max(0, up_(k-1) + w_k - a),   down_k = max(0, down_(k-1) - w_k - a)
//
// Estimates of a filter are strongly correlated in time. One that lets a parameter walk (process
// noise q) forgets with the time P/q, P = deviation^2. Where the parameter in truth stands still,
// its estimate wanders about it as an autoregressive process of first order with the variance P/2
// (scalar filter at rest: gain K = P/R, error e' = -K e + K v, so E e^2 = K R/2), and samples a
// period T apart are correlated by r = e^(-T q/P). So
//
// - the limit of the distance is that of every sample for itself, which the rate of all of them
//   together cannot exceed, however they are correlated (Boole's inequality). P instead of P/2 is a
//   margin for filters that are too sure. n' = n (1 - r)/(1 + r) samples of the warm-up are
//   independent. It is what finds a drift soon where the filter remembers long.
// - the sum is of what is new only, which is white (Alwan & Roberts, J. Bus. Econ. Stat. 6, 1988,
//   "special-cause chart"): a sum of the estimates themselves would alarm by their correlation
//   alone. r and s are learned as upper ends of their 95 % intervals, s not below what P/2 gives.
//   Its limit is that of a run length (alarm_limits.h, Siegmund), for an allowance less 2/sqrt(n),
//   that x0 may be wrong by. It is what finds a small drift where the filter forgets soon.
//
// A change that matters, matters |x0|, is found; half of it is the least distance to be told and
// the allowance a, which is not below 1/2, as Page has it (Biometrika 41, 1954). The limit of the
// sum is not below a: what matters less has to last.
//
// The warm-up begins anew until the deviation has stopped falling. Where the deviation grows later
// (less is told), s grows with it, and r, for the time P/q grows; where it falls below 0.8 of that
// of the reference, this was no good one, and is learned anew.
//
// It assumes that errors are normal, that the deviation told is not too small by more than the
// scatter of the warm-up shows or a factor of sqrt(2), and that the parameter stood still in the
// warm-up. What has drifted is told until it returns, or a new reference is learned.

struct DriftWatchSettings {
  double period = 1.0;          ///< [s], from sample to sample that is looked at
  double warm_up = 120.0;       ///< [s], of samples that a reference is learned from
  double matters = 0.02;        ///< [-], of a parameter's reference: the change to be found
  double false_alarms = 0.005;  ///< [1/h], of all parameters together
};

class DriftWatch {
 public:
  explicit DriftWatch(std::size_t parameters, const DriftWatchSettings& settings = {});

  struct Drift {
    int parameter = -1;  ///< the furthest of those beyond their limits; -1: none is
    // Of that parameter; NaN: none.
    double from = std::numeric_limits<double>::quiet_NaN();   ///< its reference
    double to = std::numeric_limits<double>::quiet_NaN();     ///< where it is
    double since = std::numeric_limits<double>::quiet_NaN();  ///< [s], its sum last stood at 0
    // The statistic that is nearest to its limit, or furthest beyond; NaN: nothing is learned yet.
    double statistic = std::numeric_limits<double>::quiet_NaN();  ///< [-], distance or sum
    double limit = std::numeric_limits<double>::quiet_NaN();      ///< [-], of that
  };

  // Real-time safe:
  /// The estimates of an instant [s] and their standard deviations, one a parameter, at
  /// least once a period, of which one is looked at. A value or deviation that is not finite (or no
  /// deviation > 0) is none, and a parameter that is frozen is better not told than told. An
  /// instant before the last one breaks off what is under way; references stay. True where it was
  /// looked at.
  bool take(double time, const double* value, const double* deviation);
  /// Of the last instant.
  const Drift& drift() const { return drift_; }
  /// It has a reference.
  bool learned(std::size_t parameter) const { return watches_[parameter].learned; }

 private:
  /// Sums over a warm-up, of values less the first.
  struct WarmUp {
    std::int64_t count = 0;
    double first = 0.0, last = 0.0;
    double sum = 0.0, squares = 0.0, products = 0.0;
    double variances = 0.0;  // deviations squared
    double deviation = 0.0;  // when it began
  };
  struct Watch {
    WarmUp warm_up;
    bool learned = false;
    double reference = 0.0;    // x0
    double deviation = 0.0;    // of the warm-up
    double correlation = 0.0;  // r
    double scatter = 0.0;      // [-], of what is new, over s of P/2; >= 1
    double spread = 0.0;       // [-], of the distance, over the deviation; >= 1
    // As the deviation is now.
    double prepared_for = 0.0;                                   // that deviation
    double sigma = 0.0;                                          // s0
    double now_correlated = 0.0;                                 // r
    double news = 0.0;                                           // s
    double allowance = 0.0, sum_limit = 0.0;                     // [-], of a sum
    double distance_limit = 0.0;                                 // [-]
    double previous = std::numeric_limits<double>::quiet_NaN();  // x - x0, of the sample before
    double up = 0.0, down = 0.0;                                 // [-]
    double distance = 0.0;                                       // [-]
    double up_since = 0.0, down_since = 0.0;                     // [s]
    double newest = 0.0;                                         // x - x0
  };

  void warmUp(Watch& watch, double value, double deviation) const;
  void learn(Watch& watch) const;
  void prepare(Watch& watch, double deviation) const;
  void compare(Watch& watch, double time, double value, double deviation) const;
  void tell(double time);

  DriftWatchSettings settings_;
  std::int64_t samples_;  // of a warm-up
  double run_length_;     // of a sum
  double z_;              // normal limit of a distance
  std::vector<Watch> watches_;
  double looked_at_;  // [s]; NaN: never
  Drift drift_;
};

}  // namespace whirl_twin
