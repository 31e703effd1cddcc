#include "controllers/quadratic_settings.h"

#include <fmt/format.h>

#include "analysis/riccati.h"
#include "controllers/controller_settings.h"

namespace whirl_twin {

using Eigen::Index;
using Eigen::MatrixXd;

std::vector<SettingInfo> regulatorSettings() {
  SettingInfo q{"q", SettingKind::kMatrix, "1/state^2",
                "weights of the states: a row with a number per state, coordinates before their "
                "rates, or a symmetric matrix"};
  SettingInfo r{"r", SettingKind::kMatrix, "1/output^2", "weights of the outputs, likewise"};
  q.required = true;
  r.required = true;
  SettingInfo cost{"cost", SettingKind::kChoice, "",
                   "design for zero-order-hold outputs, or for continuous outputs"};
  cost.choices = {"sampled", "continuous"};
  return {q, r, cost};
}

const LinearPlant& plantOf(const ControllerPlan& plan) {
  if (!plan.plant) {
    throw SetupError("q",
                     "needs a linear plant: the systems it acts on cannot be linearized about "
                     "their start; use state_feedback with a given gain");
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
    throw SetupError(name, fmt::format("diagonal must be >= 0, found {} at index {}", least, i));
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
  const QuadraticCost cost{weightOf(settings, "q", plant.a.rows(),
                                    "a number per state, or a row and a column per state"),
                           weightOf(settings, "r", plant.b.cols(),
                                    "a number per output, or a row and a column per output")};
  return foundFor("q", [&] {
    return settings.choices.at("cost") == "sampled"
               ? sampledRegulator(plant.a, plant.b, cost, 1.0 / rate).gain
               : continuousRegulator(plant.a, plant.b, cost).gain;
  });
}

}  // namespace whirl_twin
