// A matrix that is smooth in the speed of a shaft, dear to work out, and wanted at very many
// speeds: from few of them by Chebyshev interpolation in parts of the range (Trefethen,
// Approximation Theory and Approximation Practice, 2013). Not real-time safe.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace whirl_twin {

class MapOverSpeed {
 public:
  using Sample = std::function<Eigen::MatrixXd(double speed)>;
  /// How much an error is of a matrix.
  using Size = std::function<double(const Eigen::MatrixXd& error, const Eigen::MatrixXd& exact)>;

  /// Between two speeds [rad/s] to `tolerance`, seen between the nodes; where rounding leaves more
  /// (up to `rounding`) to that. Throws RunFailure where no part is narrow enough.
  MapOverSpeed(const Sample& sample, double low, double high, const Size& size, double tolerance,
               double rounding);

  Eigen::MatrixXd at(double speed) const;

 private:
  struct Part {
    double low, high;  ///< [rad/s]
    std::vector<Eigen::MatrixXd> values;
    Eigen::MatrixXd at(double speed) const;
  };
  void add(const Sample& sample, double low, double high, const Size& size, double tolerance,
           double rounding, double before);

  std::vector<Part> parts_;  ///< ascending
};

}  // namespace whirl_twin
