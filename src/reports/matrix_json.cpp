#include "reports/matrix_json.h"

namespace whirl_twin {

Json arrayJson(const std::vector<double>& x) {
  Json json = Json::array();
  for (const double value : x) {
    json.push_back(value + 0.0);
  }
  return json;
}

Json arrayJson(const Eigen::VectorXd& x) {
  return arrayJson(std::vector<double>(x.data(), x.data() + x.size()));
}

Json matrixJson(const Eigen::MatrixXd& m) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    rows.push_back(arrayJson(Eigen::VectorXd(m.row(i))));
  }
  return rows;
}

}  // namespace whirl_twin
