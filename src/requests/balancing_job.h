// A job of field balancing: vibration readings, trial masses or known influence coefficients, where
// masses can be set, and the tolerance.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/balancing.h"

namespace whirl_twin {

/// Of ISO 21940-11: the permitted unbalance of the rotor is grade * mass / speed.
struct BalanceTolerance {
  double grade = 0.0;      ///< [mm/s], the product of eccentricity and speed
  double mass = 0.0;       ///< [kg], of the rotor
  double speed = 0.0;      ///< [rad/s], of service
  Eigen::VectorXd shares;  ///< [-], of each plane; together 1

  double permitted(Eigen::Index plane) const {
    return 1.0e-3 * grade * mass / speed * shares[plane];
  }
};

/// Angles are with the rotation and phases are lags, whatever the file has.
struct BalancingJob {
  std::vector<std::string> probes, planes;  ///< each name once
  Eigen::VectorXcd initial;                 ///< of each probe: amplitude e^(-i lag), any unit
  Eigen::VectorXd weights;                  ///< of each probe, >= 0 and not all 0
  std::vector<TrialRun> trials;             ///< that separate the planes; none with `known`
  Eigen::VectorXcd left_in;                 ///< [kg m], a plane each: trial masses still in
  Eigen::MatrixXcd known;                   ///< influence coefficients of an earlier job
  std::optional<Reflection> reflection;     ///< of a symmetric rotor
  /// Standard deviation of either component of a reading, in its unit; 0: not specified.
  double deviation = 0.0;
  Eigen::VectorXd limits;                   ///< [kg m], of each plane; infinity for none
  std::vector<std::vector<double>> places;  ///< [rad], of each plane; empty: any angle
  std::optional<BalanceTolerance> tolerance;

  /// SI unit of all amplitudes: m, m/s or m/s^2; "": they have none.
  std::string unit;
  /// Units of the text, as the file has them; "" for amplitudes without one.
  std::string shown_unit, shown_mass_unit = "kg m";
  bool lead = false;     ///< phases of the file are leads
  bool against = false;  ///< angles of the file are against the rotation
};

/// Reads a job from a YAML file. Throws InputError with all its errors. The limits on the values
/// exclude overflow in the computations that follow.
BalancingJob readBalancingJob(const std::string& path);
/// Likewise from a tree; errors begin with `source`.
BalancingJob readBalancingJob(const YAML::Node& tree, const std::string& source);

}  // namespace whirl_twin
