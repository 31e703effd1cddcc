// A model of this program with the parameters of a note case, and the questions that the cases of
// every system ask: accelerations, energies, trajectories, small motion.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../integration/running_system.h"
#include "note_case.h"

namespace whirl_twin {

inline Eigen::VectorXd vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// State of a trajectory at the case's time, by Gauss-Legendre in steps of a millisecond.
inline double endOfMotion(const RunningSystem::Setup& setup, const NoteCase& c,
                          const std::vector<std::string>& states) {
  RunningSystem system(setup, "gauss_legendre_6", 1000000);
  system.run(std::lround(c.time * 1000.0));
  const auto place = std::find(states.begin(), states.end(), c.state) - states.begin();
  return system.state().at(static_cast<std::size_t>(place));
}

/// Squares of the natural frequencies of small motion about a position at rest, in rising order.
inline Eigen::VectorXd squaredFrequencies(const Linearization& l) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(l.stiffness, l.mass)
      .eigenvalues();
}

/// Where f passes through zero between two places where it has opposite signs.
template <class F>
double zeroBetween(double low, double high, const F& f) {
  const bool rising = f(high) > 0.0;
  for (double middle = 0.5 * (low + high); low < middle && middle < high;
       middle = 0.5 * (low + high)) {
    ((f(middle) > 0.0) == rising ? high : low) = middle;
  }
  return low;
}

/// The coordinates of the case bear the names of the model's.
class NoteSystem {
 public:
  NoteSystem(const NoteCase& c, const std::string& model, const ParameterValues& parameters)
      : case_(c) {
    setup_.model = model;
    setup_.parameters = completed(*findModel(model), parameters);
    setup_.gravity = c.at("g", 1.0);
    dynamics_ = findModel(model)->dynamics(setup_.parameters, setup_.gravity);
    for (const Coordinate& coordinate : findModel(model)->coordinates) {
      names_.emplace_back(coordinate.name);
      setup_.q.push_back(c.at("ic_" + names_.back(), 0.0));
      setup_.v.push_back(c.at("ic_" + names_.back() + "_d", 0.0));
    }
  }

  const Dynamics& dynamics() const { return *dynamics_; }
  Eigen::VectorXd holdingForce(const std::vector<double>& q) const {
    return dynamics_->holdingForce(vector(q), {});
  }
  /// About a steady motion with rates v, if given.
  Linearization linearAt(const std::vector<double>& q, std::vector<double> v = {}) const {
    v.resize(q.size());
    return dynamics_->linearization(vector(q), vector(v), Eigen::VectorXd::Zero(dynamics_->dof()),
                                    {});
  }

  bool asksCommonQuestion() const {
    return case_.startsWith("traj.") || case_.startsWith("acc.") || case_.startsWith("inv.h0.");
  }
  double commonAnswer() const {
    if (case_.startsWith("traj.")) {
      std::vector<std::string> states = names_;
      for (const std::string& name : names_) {
        states.push_back(name + "_d");
      }
      return endOfMotion(setup_, case_, states);
    }
    if (case_.startsWith("inv.h0.")) {
      return dynamics_->energies(vector(setup_.q), vector(setup_.v), {}).jacobi;
    }
    std::vector<double> q;
    std::vector<double> v;
    for (const std::string& name : names_) {
      q.push_back(case_.at("at_" + name));
      v.push_back(case_.at("at_" + name + "_d"));
    }
    const std::string asked = case_.id.substr(case_.id.rfind('.') + 1);
    const auto place = std::find(names_.begin(), names_.end(), asked) - names_.begin();
    return dynamics_->acceleration(vector(q), vector(v), {case_.at("t"), 0.0, 0.0, 0.0})(place);
  }

 private:
  NoteCase case_;
  std::vector<std::string> names_;
  RunningSystem::Setup setup_;
  std::shared_ptr<const Dynamics> dynamics_;
};

}  // namespace whirl_twin
