// Values of a balancing job with their units and conventions, and errors with their keys.
#pragma once

#include <yaml-cpp/yaml.h>

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "requests/balancing_job.h"
#include "scene/node_reader.h"

namespace whirl_twin {

/// A value with an error is recorded in the diagnostics, and read as 0.
class BalancingValues {
 public:
  static constexpr double kLargest = 1.0e12;   ///< amplitude, weight, mass times radius [kg m]
  static constexpr double kMinMass = 1.0e-12;  ///< kg m: a speck of dust at a centimetre

  BalancingValues(BalancingJob& job, Diagnostics& diagnostics)
      : job_(job), diagnostics_(diagnostics) {}

  /// Empty, with an error, where there is no list of `least` to `most` entries.
  std::vector<YAML::Node> list(const YAML::Node& node, const std::string& key,
                               const std::string& expected, std::size_t least, std::size_t most);
  /// `unit`: that of a number without one.
  double number(const YAML::Node& node, const std::string& key, double least, double largest,
                const std::string& what, const std::string& unit);
  double mass(const YAML::Node& node, const std::string& key, double least);  ///< [kg m]
  double angle(const YAML::Node& node, const std::string& key);  ///< [rad], with the rotation
  double deviation(const YAML::Node& node, const std::string& key);
  /// A list of [amplitude, phase in deg], one for each of `count` probes or planes. `per`: what the
  /// unit of influence coefficients has behind that of the amplitude.
  Eigen::VectorXcd phasors(const YAML::Node& node, const std::string& key, std::size_t count,
                           const std::string& of, const std::string& per);
  /// Amplitudes have a unit each, or none has one.
  void requireUnitsOfAll();

 private:
  std::string amplitudeUnit(const YAML::Node& node, const std::string& per);
  void noteUnit(const YAML::Node& node, const std::string& key);
  std::complex<double> phasor(const YAML::Node& node, const std::string& key,
                              const std::string& per);

  BalancingJob& job_;
  Diagnostics& diagnostics_;
  std::optional<std::string> with_unit_, without_unit_;  // keys of the first such amplitudes
};

}  // namespace whirl_twin
