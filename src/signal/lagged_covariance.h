// Covariances of a motion with itself some samples later,
//
//   R_k = sum over t: z(t + k) z(t)^H,   the same t for every lag k,
//
// so that growth and decay of a motion are identified as such. The record is stored as 10 to 19
// parts of equal length, whatever the length of the record: omitting them one by one gives the
// standard deviation of results from the sums (the jackknife; B. Efron, C. Stein, Ann. Stat. 9
// (1981)). Memory does not grow.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace whirl_twin {

// Fewer samples a second without folding: a low-pass of finite length, then every so-many-th
// sample. Of finite length because it adds no poles: covariances at lags beyond its length are
// those of the motion, and what it makes of white noise has ended by then.

class Decimator {
 public:
  /// Of samples `period` [s] apart; what is below `limit` [rad/s] stays. At least 4 samples a cycle
  /// of the limit come out where as many go in; where fewer than 8 do, all of them, not filtered.
  Decimator(double period, double limit);

  /// The next sample; is there one that comes out?
  bool take(const Eigen::VectorXcd& z);
  const Eigen::VectorXcd& out() const { return out_; }
  /// The next sample does not follow the last one.
  void interrupt() { kept_ = 0; }

  double spacing() const {
    return period_ * static_cast<double>(stride_);
  }  ///< [s], what comes out
  bool filters() const { return stride_ > 1; }

 private:
  double period_;
  std::size_t stride_;
  std::vector<double> taps_;
  std::vector<Eigen::VectorXcd> ring_;
  std::size_t newest_ = 0;
  std::size_t kept_ = 0;   // samples in the ring that follow one another
  std::size_t since_ = 0;  // that came in after the last that came out
  Eigen::VectorXcd out_;
};

class LaggedCovariance {
 public:
  using Sums = std::vector<Eigen::MatrixXcd>;  ///< a lag each

  /// For a number of stations and the lags first_lag, first_lag + 1, ...
  LaggedCovariance(Eigen::Index stations, int first_lag, int lags);

  void take(const Eigen::VectorXcd& z);
  /// The next sample does not follow the last one.
  void interrupt() { kept_ = 0; }

  std::int64_t samples() const { return samples_; }  ///< in the sums, as t
  double meanSquare() const;                         ///< E|z|^2, of all stations together
  std::size_t parts() const { return parts_.size(); }
  Sums all() const { return without(parts_.size()); }
  /// The sums without one part.
  Sums without(std::size_t part) const;

 private:
  struct Part {
    Sums sums;
    std::int64_t samples = 0;
  };

  void beginPart();

  int first_lag_;
  Sums nothing_;
  std::vector<Eigen::VectorXcd> ring_;  // the newest samples
  std::size_t newest_ = 0;
  std::size_t kept_ = 0;
  std::vector<Part> parts_;
  std::int64_t part_samples_;
  std::int64_t samples_ = 0;
  double squares_ = 0.0;
};

}  // namespace whirl_twin
