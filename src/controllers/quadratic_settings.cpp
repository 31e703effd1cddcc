#include "controllers/quadratic_settings.h"

#include <fmt/format.h>

#include "analysis/riccati.h"
#include "controllers/controller_settings.h"

namespace whirl_twin {

using Eigen::Index;
using Eigen::MatrixXd;

std::vector<SettingInfo> regulatorSettings() {
  SettingInfo q{"q", SettingKind::kMatrix, "1/state^2",
                "what states cost: a row, a number a state, coordinates before their rates, or a "
                "symmetric matrix"};
  SettingInfo r{"r", SettingKind::kMatrix, "1/output^2", "what outputs cost, likewise"};
  q.required = true;
  r.required = true;
  SettingInfo cost{"cost", SettingKind::kChoice, "",
                   "of outputs held from sample to sample, or of outputs that follow at once"};
  cost.choices = {"sampled", "continuous"};
  return {q, r, cost};
}

const LinearPlant& plantOf(const ControllerPlan& plan) {
  if (!plan.plant) {
    throw SetupError("q",
                     "weighs the states of a linear plant, and there is none here: what it acts "
                     "on has no small motions about where it starts; state_feedback takes a gain "
                     "as it is");
  }
  return *plan.plant;
}

MatrixXd weightOf(const Settings& settings, const std::string& name, Index n,
                  const std::string& of) {
  const MatrixXd& given = settings.matrices.at(name);
  const bool diagonal = given.rows() == 1;
  if (!diagonal || given.cols() != n) {
    requireSize(name, given, diagonal ? 1 : n, n, of);
  }
  const MatrixXd weight = diagonal ? MatrixXd(given.row(0).asDiagonal()) : given;
  if (!weight.isApprox(weight.transpose(), 1e-12)) {
    throw SetupError(name, "must be symmetric");
  }
  Index i = 0;
  if (const double least = weight.diagonal().minCoeff(&i); !(least >= 0.0)) {
    throw SetupError(name,
                     fmt::format("must be >= 0 in its diagonal, found {} in place {}", least, i));
  }
  return 0.5 * (weight + weight.transpose());
}

MatrixXd foundFor(const std::string& setting, const std::function<MatrixXd()>& find) {
  try {
    return find();
  } catch (const std::runtime_error& error) {
    throw SetupError(setting, error.what());
  }
}

MatrixXd regulatorGain(const Settings& settings, const LinearPlant& plant, double rate) {
  const QuadraticCost cost{
      weightOf(settings, "q", plant.a.rows(), "a number a state, or a row and a column a state"),
      weightOf(settings, "r", plant.b.cols(),
               "a number an output, or a row and a column an output")};
  return foundFor("q", [&] {
    return settings.choices.at("cost") == "sampled"
               ? sampledRegulator(plant.a, plant.b, cost, 1.0 / rate).gain
               : continuousRegulator(plant.a, plant.b, cost).gain;
  });
}

}  // namespace whirl_twin
