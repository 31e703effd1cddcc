// Consistency test of a filter's innovations: normalized by their predicted standard deviation they
// are independent standard normal numbers if the model matches the machine. Tested over consecutive
// windows:
//
//   mismatch   normalized innovation squared (NIS): the mean of their squares; for n numbers
//              chi-squared over n, about 1
//   whiteness  sum e_k e_(k-1) / sum e_k^2, channel by channel along time; about 0 with a standard
//              deviation of 1/sqrt(n) for n pairs, tails lighter than normal
//
// The limits follow from a rate of false alarms: half of it for each of the two, and half of that
// for each end. Too large: forces or noise that are not in the model. Too small: less noise than
// specified. Not white: persistent errors of the prediction.
//
// A part of the predicted deviation may be an allowance, such as for an uncertain shaft angle that
// is off for a while: residuals that are smaller by no more than the allowance count as consistent.
// The mean of the squares is then 1, or as far below 1 as without the allowance.
//
// Assumes that a window's numbers are independent, also among the channels of one instant: from
// sequential updates of several channels, or from the square root of nu' S^-1 nu.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace whirl_twin {

struct InnovationTestSettings {
  double window = 1.0;          ///< [s]; longer if it has too few numbers
  double false_alarms = 0.005;  ///< [1/h], of all limits together
};

class InnovationTest {
 public:
  /// Maximum number of channels (a complex innovation counts as two).
  explicit InnovationTest(std::size_t channels, const InnovationTestSettings& settings = {});

  struct Verdict {
    double time = std::numeric_limits<double>::quiet_NaN();  ///< [s], end of its window
    // [-]; NaN before the end of the first window
    double mismatch = std::numeric_limits<double>::quiet_NaN();
    double mismatch_least = std::numeric_limits<double>::quiet_NaN();
    double mismatch_limit = std::numeric_limits<double>::quiet_NaN();
    double whiteness = std::numeric_limits<double>::quiet_NaN();
    double whiteness_limit = std::numeric_limits<double>::quiet_NaN();  ///< of its magnitude

    bool mismatched() const { return mismatch > mismatch_limit || mismatch < mismatch_least; }
    bool coloured() const { return whiteness > whiteness_limit || whiteness < -whiteness_limit; }
  };

  // Real-time safe:
  /// The normalized innovations of an instant [s], one per channel, not more than the number of
  /// channels; NaN: the channel had none. An instant before the last one restarts the test. True at
  /// the end of a window. surest: the innovations normalized without the allowance; none: the same.
  bool take(double time, const double* innovation, std::size_t channels,
            const double* surest = nullptr);
  /// Restarts the current window and forgets its last instant; the verdict is kept.
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

// Detects a changed parameter from the distance of its estimate x to a reference x0, the mean of n
// samples of a warm-up. Two statistics, both two-sided:
//
//   distance   |x_k - x0| / s0, with s0^2 = max(P, scatter of the warm-up) (1 + 1/n')
//   sum        cumulative sum (CUSUM) of the innovation of each sample,
//              w_k = ((x_k - x0) - r (x_(k-1) - x0)) / s
//              up_k = max(0, up_(k-1) + w_k - a),   down_k = max(0, down_(k-1) - w_k - a)
//
// Estimates of a filter are strongly correlated in time. A filter with a random walk of the
// parameter (process noise q) has the memory P/q, P = deviation^2. If the true parameter is
// constant, its estimate is an autoregressive process of first order about it with the variance P/2
// (scalar filter in steady state: gain K = P/R, error e' = -K e + K v, so E e^2 = K R/2), and
// samples a period T apart have the correlation r = e^(-T q/P). Therefore:
//
// - The limit of the distance is that of each sample by itself, which bounds the rate of all
//   samples for any correlation (Boole's inequality). P instead of P/2 is a margin for
//   overconfident filters. n' = n (1 - r)/(1 + r) samples of the warm-up are independent. The
//   distance detects a drift soon if the memory of the filter is long.
// - The sum uses the innovations only, which are white (Alwan & Roberts, J. Bus. Econ. Stat. 6,
//   1988, "special-cause chart"): a sum of the estimates themselves would alarm because of their
//   correlation. r and s are learned as upper ends of their 95 % intervals, s not below the value
//   for P/2. The limit follows from a run length (alarm_limits.h, Siegmund) for an allowance
//   reduced by 2/sqrt(n), the uncertainty of x0. The sum detects a small drift if the memory is
//   short.
//
// A relevant change, matters |x0|, is detected; half of it is the smallest reported distance and
// the allowance a, which is not below 1/2 (Page, Biometrika 41, 1954). The limit of the sum is not
// below a: smaller changes must last.
//
// The warm-up restarts until the deviation has stopped falling. If the deviation grows later (less
// information), s grows with it, and r, since P/q grows; if it falls below 0.8 of that of the
// reference, a new reference is learned.
//
// Assumes normal errors, a filter deviation that is not too small by more than the scatter of the
// warm-up shows or a factor of sqrt(2), and a constant parameter during the warm-up. A drift is
// reported until the parameter returns or a new reference is learned.

struct CusumDetectorSettings {
  double period = 1.0;          ///< [s], between evaluated samples
  double warm_up = 120.0;       ///< [s], of samples to learn a reference from
  double matters = 0.02;        ///< [-], relative to the reference: the change to be detected
  double false_alarms = 0.005;  ///< [1/h], of all parameters together
};

class CusumDetector {
 public:
  explicit CusumDetector(std::size_t parameters, const CusumDetectorSettings& settings = {});

  struct Drift {
    int parameter = -1;  ///< the one furthest beyond its limits; -1: none
    // Of that parameter; NaN: none.
    double from = std::numeric_limits<double>::quiet_NaN();   ///< its reference
    double to = std::numeric_limits<double>::quiet_NaN();     ///< its current value
    double since = std::numeric_limits<double>::quiet_NaN();  ///< [s], when its sum was last 0
    // The statistic nearest to its limit, or furthest beyond; NaN: nothing has been learned yet.
    double statistic = std::numeric_limits<double>::quiet_NaN();  ///< [-], distance or sum
    double limit = std::numeric_limits<double>::quiet_NaN();      ///< [-], of that statistic
  };

  // Real-time safe:
  /// The estimates at an instant [s] and their standard deviations, one per parameter, at least
  /// once a period; one sample a period is evaluated. A value or deviation that is not finite (or a
  /// deviation <= 0) counts as missing; for a frozen parameter pass none. An instant before the
  /// last one aborts a warm-up under way; references are kept. True if the sample was evaluated.
  bool take(double time, const double* value, const double* deviation);
  /// At the last instant.
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
    double deviation = 0.0;  // at its start
  };
  struct Watch {
    WarmUp warm_up;
    bool learned = false;
    double reference = 0.0;    // x0
    double deviation = 0.0;    // standard deviation of the warm-up
    double correlation = 0.0;  // r
    double scatter = 0.0;      // [-], of the innovations, over s of P/2; >= 1
    double spread = 0.0;       // [-], of the distance, over the deviation; >= 1
    // For the current deviation.
    double prepared_for = 0.0;                                   // this deviation
    double sigma = 0.0;                                          // s0
    double now_correlated = 0.0;                                 // r
    double news = 0.0;                                           // s
    double allowance = 0.0, sum_limit = 0.0;                     // [-], of a sum
    double distance_limit = 0.0;                                 // [-]
    double previous = std::numeric_limits<double>::quiet_NaN();  // x - x0, previous sample
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

  CusumDetectorSettings settings_;
  std::int64_t samples_;  // of a warm-up
  double run_length_;     // of a sum
  double z_;              // normal limit of a distance
  std::vector<Watch> watches_;
  double looked_at_;  // [s]; NaN: never
  Drift drift_;
};

}  // namespace whirl_twin
