#include "tools/system_analysis.h"

namespace whirl_twin {

namespace {

/// Negative zeros, of skew matrices and undamped modes, are zeros.
Json array(const std::vector<double>& x) {
  Json json = Json::array();
  for (const double value : x) {
    json.push_back(value + 0.0);
  }
  return json;
}
Json array(const Eigen::VectorXd& x) {
  return array(std::vector<double>(x.data(), x.data() + x.size()));
}

/// Row by row.
Json matrix(const Eigen::MatrixXd& m) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    rows.push_back(array(m.row(i)));
  }
  return rows;
}

/// {coordinate: value}.
Json byCoordinate(const ModelInfo& model, const Eigen::VectorXd& x) {
  Json json;
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    json[model.coordinates[i].name] = x[static_cast<Eigen::Index>(i)];
  }
  return json;
}

/// {coordinate: value, ..., coordinate_rate: value, ...}.
Json stateJson(const ModelInfo& model, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  Json json = byCoordinate(model, q);
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    json[std::string(model.coordinates[i].name) + "_rate"] = v[static_cast<Eigen::Index>(i)];
  }
  return json;
}

Json linearizationJson(const SystemAnalysis& a) {
  Json json;
  json["about"] = stateJson(*a.model, a.about, a.about_v);
  json["mass"] = matrix(a.linearization.mass);
  json["damping"] = matrix(a.linearization.damping);
  json["gyroscopic"] = matrix(a.linearization.gyroscopic);
  json["stiffness"] = matrix(a.linearization.stiffness);
  json["circulatory"] = matrix(a.linearization.circulatory);
  return json;
}

Json routhJson(const RouthResult& routh) {
  Json json;
  json["verdict"] = name(routh.verdict);
  json["right"] = routh.right;
  json["imaginary"] = routh.imaginary;
  json["left"] = routh.left;
  json["first_column"] = routh.first_column;
  return json;
}

Json criticalSpeedJson(const state::CriticalSpeedMargin& critical) {
  Json json;
  json["speed"] = critical.speed;
  json["direction"] = critical.direction;
  json["amplification_factor"] = critical.amplification_factor;
  json["separation_margin"] = critical.separation_margin;
  json["required_separation_margin"] = critical.required_separation_margin;
  return json;
}

}  // namespace

Json json(const SystemAnalysis& a) {
  Json json;
  json["model"] = a.model->name;
  json["coordinates"] = Json::array();
  for (const Coordinate& c : a.model->coordinates) {
    json["coordinates"].push_back(c.name);
  }
  json["time"] = a.moment.time;
  json["speed"] = a.speed ? Json(*a.speed) : Json();
  json["state"] = stateJson(*a.model, a.q, a.v);
  json["acceleration"] = byCoordinate(*a.model, a.acceleration);
  json["energy"] = {{"kinetic", a.energies.kinetic},
                    {"potential", a.energies.potential},
                    {"jacobi", a.energies.jacobi},
                    {"dissipated_power", a.energies.dissipated_power},
                    {"input_power", a.energies.input_power}};
  json["equilibria"] = Json::array();
  for (const Equilibrium& e : a.equilibria) {
    json["equilibria"].push_back(
        {{"state", byCoordinate(*a.model, e.q)}, {"verdict", name(e.stability.routh.verdict)}});
  }
  json["linearization"] = linearizationJson(a);
  json["eigenvalues"] = Json::array();
  for (const auto& root : a.stability.eigenvalues) {
    json["eigenvalues"].push_back({root.real() + 0.0, root.imag() + 0.0});
  }
  json["natural_frequencies"] = array(a.stability.natural_frequencies);
  json["damping_ratios"] = array(a.stability.damping_ratios);
  json["characteristic_polynomial"] = array(a.stability.polynomial);
  json["routh"] = routhJson(a.stability.routh);
  json["margins"] = {
      {"decay_rate", a.stability.decay_rate},
      {"damping_ratio", a.stability.damping_ratio},
      {"log_decrement", a.stability.log_decrement},
      {"instability_speed", a.instability_speed ? Json(*a.instability_speed) : Json()}};
  json["critical_speeds"] = Json::array();
  for (const auto& critical : a.critical_speeds) {
    json["critical_speeds"].push_back(criticalSpeedJson(critical));
  }
  return json;
}

}  // namespace whirl_twin
