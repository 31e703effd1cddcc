#include "requests/balancing_values.h"

#include <fmt/format.h>

#include <cmath>

#include "algebra/constants.h"
#include "messages/units.h"
#include "scene/written_quantity.h"

namespace whirl_twin {

namespace {

constexpr double kMaxAngle = 360.0e3;  // deg, either way

std::string unitOf(const YAML::Node& node) {
  const auto written =
      node.IsDefined() && node.IsScalar() ? writtenQuantity(node.Scalar()) : std::nullopt;
  return written ? written->unit : "";
}

}  // namespace

std::vector<YAML::Node> BalancingValues::list(const YAML::Node& node, const std::string& key,
                                              const std::string& expected, std::size_t least,
                                              std::size_t most) {
  if (!node.IsDefined() || !node.IsSequence() || node.size() < least || node.size() > most) {
    const bool other_size = node.IsDefined() && node.IsSequence();
    diagnostics_.add(
        key, fmt::format("must be {}, found {}", expected,
                         other_size ? fmt::format("{} entries", node.size()) : shown(node)));
    return {};
  }
  return {node.begin(), node.end()};
}

double BalancingValues::number(const YAML::Node& node, const std::string& key, double least,
                               double largest, const std::string& what, const std::string& unit) {
  const auto value = node.IsDefined() && node.IsScalar() ? parseQuantity(node.Scalar(), unit)
                                                         : std::optional<double>();
  if (!value || !(*value >= least && *value <= largest)) {
    diagnostics_.add(key,
                     fmt::format("must be {} from {:g} to {:g}, found {}{}", what, least, largest,
                                 shown(node), node.IsDefined() ? unitDiagnostic(node, unit) : ""));
    return 0.0;
  }
  return *value;
}

/// Amplitudes have any unit, all the same, and then none; or a unit each. `per`: what the unit of
/// influence coefficients has behind that of the amplitude.
std::string BalancingValues::amplitudeUnit(const YAML::Node& node, const std::string& per) {
  const std::string written = unitOf(node);
  if (job_.unit.empty() && !written.empty()) {
    job_.unit = "m";
    for (const char* unit : {"m/s", "m/s^2"}) {
      job_.unit = unitScale(written, unit + per) != 0.0 ? unit : job_.unit;
    }
  }
  if (job_.shown_unit.empty() && per.empty()) {
    job_.shown_unit = written;
  }
  return (job_.unit.empty() ? "m" : job_.unit) + per;
}

void BalancingValues::noteUnit(const YAML::Node& node, const std::string& key) {
  std::optional<std::string>& first = unitOf(node).empty() ? without_unit_ : with_unit_;
  first = first.value_or(key);
}

double BalancingValues::mass(const YAML::Node& node, const std::string& key, double least) {
  const std::string written = unitOf(node);
  if (!written.empty() && job_.shown_mass_unit == "kg m" && unitScale(written, "kg m") != 0.0) {
    job_.shown_mass_unit = written;
  }
  return number(node, key, least, kLargest, "mass times radius in kg m,", "kg m");
}
double BalancingValues::angle(const YAML::Node& node, const std::string& key) {
  return (job_.against ? -kDegree : kDegree) *
         number(node, key, -kMaxAngle, kMaxAngle, "an angle in deg", "deg");
}

/// [amplitude, phase in deg]
std::complex<double> BalancingValues::phasor(const YAML::Node& node, const std::string& key,
                                             const std::string& per) {
  const char* phase = job_.lead ? "phase lead" : "phase lag";
  if (!node.IsSequence() || node.size() != 2) {
    diagnostics_.add(key,
                     fmt::format("must be [amplitude, {} in deg], found {}", phase, shown(node)));
    return 0.0;
  }
  const double amplitude = number(node[0], key + "[0]", -kLargest, kLargest, "an amplitude",
                                  amplitudeUnit(node[0], per));
  noteUnit(node[0], key + "[0]");
  const double degrees =
      number(node[1], key + "[1]", -kMaxAngle, kMaxAngle, fmt::format("a {} in deg", phase), "deg");
  return amplitude * std::polar(1.0, (job_.lead ? kDegree : -kDegree) * degrees);
}

Eigen::VectorXcd BalancingValues::phasors(const YAML::Node& node, const std::string& key,
                                          std::size_t count, const std::string& of,
                                          const std::string& per) {
  Eigen::VectorXcd all = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(count));
  if (count == 0) {
    return all;  // already reported
  }
  const auto nodes =
      list(node, key, fmt::format("a list of {}, one per {}", count, of), count, count);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    all[static_cast<Eigen::Index>(i)] = phasor(nodes[i], fmt::format("{}[{}]", key, i), per);
  }
  return all;
}
double BalancingValues::deviation(const YAML::Node& node, const std::string& key) {
  noteUnit(node, key);
  return number(node, key, kMinMass, kLargest, "a standard deviation", amplitudeUnit(node, ""));
}

void BalancingValues::requireUnitsOfAll() {
  if (with_unit_ && without_unit_ && diagnostics_.all().empty()) {
    diagnostics_.add(*without_unit_, fmt::format("must have a unit, as {} has", *with_unit_));
  }
}

}  // namespace whirl_twin
