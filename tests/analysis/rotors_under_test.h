// Linear rotors for tests: those of the reference cases by their matrices, and a chain of discs.
#pragma once

#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/linear_rotor_dynamics.h"

namespace whirl_twin {

/// A case of the reference file by the first letters of its id.
inline nlohmann::json rotorCase(const std::string& id) {
  std::ifstream file(WHIRL_TWIN_REFERENCE "/rotor_cases.json");
  for (const auto& one : nlohmann::json::parse(file)) {
    if (one["id"].get<std::string>().compare(0, id.size(), id) == 0) {
      return one;
    }
  }
  throw std::invalid_argument("no reference case " + id);
}

inline nlohmann::json expectedOf(const nlohmann::json& reference, const std::string& name) {
  for (const auto& expected : reference["expected"]) {
    if (expected["name"] == name) {
      return expected["value"];
    }
  }
  throw std::invalid_argument("the reference case has no " + name);
}

inline Eigen::MatrixXd matrixOf(const nlohmann::json& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd m(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      m(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return m;
}

struct RotorUnderTest {
  LinearRotor rotor;
  std::vector<Station> stations;

  LinearRotorDynamics dynamics() const {
    std::vector<CoordinateInfo> coordinates;
    for (Eigen::Index i = 0; i < rotor.dof(); ++i) {
      coordinates.push_back({"q" + std::to_string(i + 1), "m"});
    }
    return {{"test_rotor", coordinates, stations}, rotor};
  }
};

/// Of x, y and two slopes, dx/dz and dy/dz, with the matrices M, C, G_times_Om and K.
inline RotorUnderTest matrixRotor(const nlohmann::json& reference) {
  const auto& p = reference["parameters"];
  const Eigen::MatrixXd mass = matrixOf(p["M"]), damping = matrixOf(p["C"]),
                        stiffness = matrixOf(p["K"]), gyroscopic = matrixOf(p["G_times_Om"]);
  RotorUnderTest r;
  r.rotor.matrices = [=](double speed) {
    return Linearization{mass, damping, speed * gyroscopic, stiffness, Eigen::MatrixXd::Zero(4, 4)};
  };
  r.rotor.speed_dependent = true;
  r.rotor.load = Eigen::VectorXd::Zero(4);
  r.stations = {{"disc", 0.0, Eigen::VectorXd::Unit(4, 0), Eigen::VectorXd::Unit(4, 1)}};
  return r;
}

/// Discs of 2 kg in a row on a shaft that acts as springs of 1e6 N/m between them, in bearings of
/// `bearing` N/m along x and `anisotropy` times that along y at both ends; damping [N s/m] of the
/// bearings, and of the shaft where it bends.
inline RotorUnderTest chainRotor(int discs, double bearing = 5.0e5, double anisotropy = 1.0,
                                 double damping = 60.0, double internal = 0.0) {
  const Eigen::Index n = 2 * discs;
  Eigen::MatrixXd spring = Eigen::MatrixXd::Zero(discs, discs);
  for (int i = 0; i + 1 < discs; ++i) {
    spring(i, i) += 1.0;
    spring(i + 1, i + 1) += 1.0;
    spring(i, i + 1) -= 1.0;
    spring(i + 1, i) -= 1.0;
  }
  Eigen::MatrixXd ends = Eigen::MatrixXd::Zero(discs, discs);
  ends(0, 0) = ends(discs - 1, discs - 1) = 1.0;
  Linearization l;
  for (Eigen::MatrixXd* m : {&l.mass, &l.damping, &l.gyroscopic, &l.stiffness, &l.circulatory}) {
    *m = Eigen::MatrixXd::Zero(n, n);
  }
  l.mass.diagonal().setConstant(2.0);
  Eigen::MatrixXd turning = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index plane : {0, 1}) {  // coordinates x1 ... xn, y1 ... yn
    l.stiffness.block(plane * discs, plane * discs, discs, discs) =
        1.0e6 * spring + bearing * (plane == 0 ? 1.0 : anisotropy) * ends;
    l.damping.block(plane * discs, plane * discs, discs, discs) =
        internal * spring + damping * ends;
  }
  turning.block(0, discs, discs, discs) = internal * spring;  // forces of the velocity w x r
  turning.block(discs, 0, discs, discs) = -internal * spring;
  RotorUnderTest r;
  r.rotor.matrices = [l, turning](double speed) {
    Linearization at = l;
    at.circulatory = speed * turning;
    return at;
  };
  r.rotor.speed_dependent = internal != 0.0;
  r.rotor.load = Eigen::VectorXd::Zero(n);
  for (int i = 0; i < discs; ++i) {
    r.stations.push_back({"disc_" + std::to_string(i + 1), 0.1 * i, Eigen::VectorXd::Unit(n, i),
                          Eigen::VectorXd::Unit(n, discs + i)});
  }
  return r;
}

/// An unbalance u e^(i angle) [kg m] at a station.
inline void addUnbalance(RotorUnderTest& r, std::size_t station, std::complex<double> unbalance) {
  const Station& s = r.stations[station];
  r.rotor.forces.push_back(
      {unbalance * (s.along_x.cast<std::complex<double>>() -
                    std::complex<double>(0.0, 1.0) * s.along_y.cast<std::complex<double>>()),
       1, true});
}

}  // namespace whirl_twin
