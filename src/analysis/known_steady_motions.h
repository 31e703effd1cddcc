// Cache of the steady motions of a rotor with free driven spin, or of a system with alternating
// loads, between evaluations: they depend on its parameters alone, so that the present operating
// point is selected from the known ones. A complete search takes hundreds of runs of Newton's
// method; it is done rarely, from the present rates, for motions not found before.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/equilibria.h"

namespace whirl_twin {

class KnownSteadyMotions {
 public:
  explicit KnownSteadyMotions(std::shared_ptr<const Dynamics> dynamics);

  /// Its steady motions are those of its parameters, and take long to find: rates are driven or
  /// loads alternate, no momentum is conserved, and no shaft's speed is prescribed.
  bool apply() const { return apply_; }
  /// As operatingPoint(), of the motion through q and v at time [s].
  std::optional<Equilibrium> operatingPoint(double time, const Eigen::VectorXd& q,
                                            const Eigen::VectorXd& v);

 private:
  void search(const Eigen::VectorXd& q, const Eigen::VectorXd& v);

  std::shared_ptr<const Dynamics> dynamics_;
  CyclicCoordinates cyclic_;
  bool apply_;
  std::vector<Equilibrium> known_;
  std::optional<double> searched_at_;  ///< [s]
  double wait_;                        ///< [s], until the next search
};

}  // namespace whirl_twin
