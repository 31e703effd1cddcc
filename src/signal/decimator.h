// Fewer samples a second without folding: a low-pass of finite length, then every so-many-th
// sample. Of finite length because it adds no poles: covariances at lags beyond its length are
// those of the motion, and what it makes of white noise has ended by then.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace whirl_twin {

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

}  // namespace whirl_twin
