// Linear least squares over records of any length, whose rest need not be white: the normal
// equations are kept for parts of the record, at most 240 of one length. Twenty groups of them left
// out one by one say how far the unknowns may be off (the jackknife; B. Efron, C. Stein, Ann. Stat.
// 9 (1981)), never less than by white noise. A rest that rings for longer than a twentieth of the
// record makes deviations too small.
//
// What the equations do not tell stands apart as directions in which the unknowns can change
// together: those of rounding, and those whose deviation is beyond a part of all that is explained.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace whirl_twin {

struct PartedSolution {
  Eigen::VectorXd x;          ///< least in the directions of rounding
  Eigen::VectorXd deviation;  ///< standard deviations
  std::vector<bool> told;     ///< of each unknown
  Eigen::MatrixXd untold;     ///< a direction each column
  double variance = 0.0;      ///< of the rest
  double explained = 0.0;     ///< squares that the unknowns explain beside the last `constants`
  std::int64_t values = 0;
};

class PartedLeastSquares {
 public:
  /// `constants`: the last unknowns so many, each a column of its own rows that is constant.
  PartedLeastSquares(Eigen::Index unknowns, Eigen::Index constants)
      : unknowns_(unknowns), constants_(constants) {}

  /// A row that is not zero at some places only, and what it is to explain.
  void add(const std::vector<Eigen::Index>& places, const std::vector<double>& row, double value);
  /// Throws std::logic_error without any row.
  PartedSolution solve() const;

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
