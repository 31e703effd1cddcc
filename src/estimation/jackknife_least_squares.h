// Linear least squares over records of any length, with residuals that need not be white: the
// normal equations are kept for parts of the record, at most 240 of equal length. Twenty groups of
// them, left out one at a time, give the standard deviations of the unknowns (the jackknife; B.
// Efron, C. Stein, Ann. Stat. 9 (1981)), at least those of white noise. Residuals correlated for
// longer than a twentieth of the record make them too small.
//
// Unidentifiable combinations of the unknowns are reported as directions: those at the level of
// rounding, and those whose standard deviation exceeds a fraction of all that is explained.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace whirl_twin {

struct JackknifeSolution {
  Eigen::VectorXd x;               ///< 0 in the directions at the level of rounding
  Eigen::VectorXd deviation;       ///< standard deviations
  std::vector<bool> identifiable;  ///< whether each unknown is identifiable
  Eigen::MatrixXd unidentifiable;  ///< unidentifiable directions, one per column
  double variance = 0.0;           ///< of the residuals
  double explained = 0.0;  ///< sum of squares explained by the unknowns but the last `constants`
  std::int64_t values = 0;
};

class JackknifeLeastSquares {
 public:
  /// `constants`: this many of the last unknowns each have a column that is constant in its own
  /// rows.
  JackknifeLeastSquares(Eigen::Index unknowns, Eigen::Index constants)
      : unknowns_(unknowns), constants_(constants) {}

  /// A row with nonzero entries at these places only, and its right-hand side.
  void add(const std::vector<Eigen::Index>& places, const std::vector<double>& row, double value);
  /// Throws std::logic_error if there is no row.
  JackknifeSolution solve() const;

 private:
  struct Part {
    Eigen::MatrixXd normal;  // its lower triangle
    Eigen::VectorXd right;
    double squares = 0.0;
    std::int64_t values = 0;

    void add(const Part& other);
  };

  struct Directions;

  static Directions directionsOf(const Eigen::MatrixXd& normal);
  Eigen::MatrixXd withoutParts(const Directions& directions, const Eigen::VectorXd& x) const;
  Part nothing() const;
  Part& current();

  Eigen::Index unknowns_, constants_;
  std::int64_t part_values_ = 64;
  std::vector<Part> parts_;
};

}  // namespace whirl_twin
