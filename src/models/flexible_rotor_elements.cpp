#include "models/flexible_rotor_elements.h"

#include <algorithm>

#include "analysis/rotor_statics.h"
#include "mechanics/rotors/bearing_laws.h"

namespace whirl_twin {

namespace {

constexpr double kUsualGravity = 9.80665;  // [m/s^2]

/// What a row of the shaft and its pedestals sees of a node's element: x and y of the one body less
/// those of the other.
Station between(const NodeElement& element, const FlexibleShaft& shaft,
                const RotorAssembly& assembly) {
  std::vector<Station> pedestals;
  for (std::size_t i = 0; i < shaft.pedestals.size(); ++i) {
    if (shaft.pedestals[i].node == element.node) {
      pedestals.push_back(assembly.pedestals()[i]);
    }
  }
  Station seen = assembly.stations()[static_cast<std::size_t>(element.node)];
  if (pedestals.empty() || element.between == NodeElement::Between::kShaftAndGround) {
    return seen;
  }
  if (element.between == NodeElement::Between::kPedestalAndGround) {
    return pedestals.back();
  }
  seen.along_x -= pedestals.front().along_x;
  seen.along_y -= pedestals.front().along_y;
  return seen;
}

void addDamping(const NodeElement& element, FlexibleShaft& shaft) {
  if (element.between == NodeElement::Between::kPedestalAndGround) {
    const auto last =
        std::find_if(shaft.pedestals.rbegin(), shaft.pedestals.rend(),
                     [&](const RotorPedestal& pedestal) { return pedestal.node == element.node; });
    if (last != shaft.pedestals.rend()) {
      last->coefficients.cxx += element.damping;
      last->coefficients.cyy += element.damping;
      return;
    }
  }
  BearingCoefficients coefficients;
  coefficients.cxx = coefficients.cyy = element.damping;
  shaft.bearings.push_back({element.node, coefficients});
}

}  // namespace

std::vector<LocalForce> forcesOf(const std::vector<NodeElement>& elements,
                                 const FlexibleShaft& shaft, const RotorAssembly& assembly) {
  std::vector<LocalForce> forces;
  for (const NodeElement& element : elements) {
    const Station seen = between(element, shaft, assembly);
    forces.push_back({element.name,
                      seen.along_x,
                      seen.along_y,
                      {LocalForce::kNoInput, LocalForce::kNoInput},
                      element.law});
  }
  return forces;
}

Eigen::MatrixXd directionsOf(const std::vector<LocalForce>& forces, Eigen::Index dof) {
  Eigen::MatrixXd all(dof, 0);
  for (const LocalForce& force : forces) {
    all.conservativeResize(Eigen::NoChange, all.cols() + 2);
    all.rightCols(2) << force.along_x, force.along_y;
  }
  return all;
}

FlexibleShaft withDamping(FlexibleShaft shaft, const std::vector<NodeElement>& elements) {
  for (const NodeElement& element : elements) {
    if (element.damping > 0.0) {
      addDamping(element, shaft);
    }
  }
  return shaft;
}

LinearRotor inItsFilms(FlexibleShaft shaft, const std::vector<NodeElement>& elements) {
  const auto films = std::count_if(elements.begin(), elements.end(),
                                   [](const NodeElement& e) { return e.journal.has_value(); });
  const double load = rotorBody(shaft).mass * kUsualGravity / static_cast<double>(films);
  for (const NodeElement& element : elements) {
    if (element.journal) {
      shaft.speed_bearings.push_back(journalBearing(element.node, *element.journal, load));
    } else if (element.damping > 0.0) {
      addDamping(element, shaft);
    }
  }
  return RotorAssembly(shaft).linearRotor();
}

}  // namespace whirl_twin
