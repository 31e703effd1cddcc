// Rotors of tests/reference/rotor_cases.json as flexible shafts.
#pragma once

#include <algorithm>
#include <complex>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {

inline nlohmann::json rotorCase(const std::string& id) {
  std::ifstream file(WHIRL_TWIN_REFERENCE "/rotor_cases.json");
  const auto cases = nlohmann::json::parse(file);
  for (const auto& one : cases) {
    if (one["id"].get<std::string>().rfind(id + "_", 0) == 0) {
      return one;
    }
  }
  throw std::runtime_error("no case " + id);
}

inline nlohmann::json expected(const nlohmann::json& reference, const std::string& name) {
  for (const auto& one : reference["expected"]) {
    if (one["name"] == name) {
      return one;
    }
  }
  throw std::runtime_error("nothing expected of the name " + name);
}

inline BearingCoefficients coefficients(const nlohmann::json& k, const nlohmann::json& c) {
  return {k[0][0], k[0][1], k[1][0], k[1][1], c[0][0], c[0][1], c[1][0], c[1][1]};
}

/// The two-disc rotor of Friswell et al. (2010), as a case of D01's form gives it.
inline FlexibleShaft twoDiscRotor(const nlohmann::json& p) {
  FlexibleShaft shaft;
  shaft.material = {p["E"], p["G"], p["rho"], true};
  const int elements = p["n_elements"];
  const double length = p["shaft_L"].get<double>() / elements;
  shaft.elements.assign(static_cast<std::size_t>(elements), {length, p["shaft_od"], 0.0});
  const auto node = [&](double z) { return static_cast<int>(z / length + 0.5); };
  for (const auto& disc : p["discs"]) {
    const auto& inertia = disc["m_Id_Ip"];
    shaft.discs.push_back({node(disc["z"]), inertia[0], inertia[2], inertia[1]});
  }
  for (const auto& z : p["bearings"]["z"]) {
    shaft.bearings.push_back({node(z), coefficients(p["bearings"]["K"], p["bearings"]["C"])});
  }
  return shaft;
}

/// Of M q'' + (C + G) q' + (K + N) q = 0 with Im > 0, by rising |s|.
inline std::vector<std::complex<double>> whirlEigenvalues(const Linearization& l) {
  const Eigen::Index n = l.mass.rows();
  // Velocities in a unit that makes the entries of the state matrix alike.
  const double scale = std::sqrt(l.stiffness.norm() / l.mass.norm());
  const Cholesky mass(l.mass);
  Eigen::MatrixXd state = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  state.topRightCorner(n, n).diagonal().setConstant(scale);
  state.bottomLeftCorner(n, n) = -mass.solve(l.stiffness + l.circulatory) / scale;
  state.bottomRightCorner(n, n) = -mass.solve(l.damping + l.gyroscopic);
  const Eigen::VectorXcd all = eigenvalues(state).values;
  std::vector<std::complex<double>> whirl;
  std::copy_if(all.begin(), all.end(), std::back_inserter(whirl),
               [](const std::complex<double>& s) { return s.imag() > 0.0; });
  std::sort(whirl.begin(), whirl.end(),
            [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
  return whirl;
}

}  // namespace whirl_twin
