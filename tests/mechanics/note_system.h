// A model of this program with the parameters of a note case, and the quantities common to the
// cases of all systems: accelerations, energies, trajectories, linearized motion.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "../integration/running_system.h"
#include "algebra/dense.h"
#include "note_case.h"

namespace whirl_twin {

inline Eigen::VectorXd vector(const std::vector<double>& values) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), x.data());
  return x;
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
  return generalizedModes(l.stiffness, l.mass).values;
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

/// A text value among a model's settings.
inline Settings choice(const std::string& setting, const std::string& value) {
  Settings settings;
  settings.choices[setting] = value;
  return settings;
}

/// The coordinates of the case bear the names of the model's.
class NoteSystem {
 public:
  NoteSystem(const NoteCase& c, const std::string& model, const ParameterValues& parameters,
             const Settings& settings = {})
      : case_(c) {
    setup_.model = model;
    setup_.parameters = completed(*findModel(model), parameters);
    setup_.gravity = c.at("g", 1.0);
    setup_.settings = settings;
    dynamics_ = findModel(model)->setUp(setup_.parameters, settings, setup_.gravity).dynamics;
    for (const CoordinateInfo& coordinate : dynamics_->coordinates()) {
      names_.emplace_back(coordinate.name);
      setup_.q.push_back(c.at("ic_" + names_.back(), 0.0));
      setup_.v.push_back(c.at("ic_" + names_.back() + "_d", 0.0));
    }
  }

  const Dynamics& dynamics() const { return *dynamics_; }
  Eigen::VectorXd holdingForce(const std::vector<double>& q) const {
    const std::vector<double> rest(q.size());
    return dynamics_->residualForce(vector(q), vector(rest), {});
  }
  /// About a steady motion with rates v, if given.
  Linearization linearAt(const std::vector<double>& q, std::vector<double> v = {}) const {
    v.resize(q.size());
    return dynamics_->linearization(vector(q), vector(v), Eigen::VectorXd::Zero(dynamics_->dof()),
                                    {});
  }
  /// A constraint force in the motion through q, v.
  double reaction(const std::string& name, const std::vector<double>& q,
                  const std::vector<double>& v) const {
    for (const Reaction& r : dynamics_->reactions(vector(q), vector(v), freely(q, v), {})) {
      if (r.name == name) {
        return r.value;
      }
    }
    throw std::invalid_argument("no reaction " + name);
  }
  /// Margin of a condition before it is violated.
  double margin(const std::string& name, const std::vector<double>& q,
                const std::vector<double>& v) const {
    for (const Condition& c : dynamics_->conditions(vector(q), vector(v), freely(q, v), {})) {
      if (c.name == name) {
        return c.margin;
      }
    }
    throw std::invalid_argument("no condition " + name);
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
  Eigen::VectorXd freely(const std::vector<double>& q, const std::vector<double>& v) const {
    return dynamics_->acceleration(vector(q), vector(v), {});
  }

  NoteCase case_;
  std::vector<std::string> names_;
  RunningSystem::Setup setup_;
  std::shared_ptr<const Dynamics> dynamics_;
};

}  // namespace whirl_twin
