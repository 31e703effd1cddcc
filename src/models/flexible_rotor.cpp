// A rotor of shaft elements, discs and bearings, in the coordinates of its nodes or reduced to the
// amplitudes of a few shapes (mechanics/rotors/rotor_assembly.h, analysis/modal_reduction.h).
//
// Whirl is published at the probe: the first unbalance's node, else the first disc's, else the
// middle one. A rotor without bearings floats: its rigid-body modes are motions like any other.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "algebra/constants.h"
#include "analysis/modal_reduction.h"
#include "analysis/rotor_statics.h"
#include "integration/exponential.h"
#include "mechanics/linear_rotor_dynamics.h"
#include "mechanics/rotors/full_order_rotor.h"
#include "messages/input_error.h"
#include "models/flexible_rotor_elements.h"
#include "models/flexible_rotor_picture.h"
#include "models/flexible_shaft_settings.h"
#include "models/linear_rotor_setup.h"
#include "models/local_element_settings.h"
#include "models/models.h"
#include "models/shaft_materials.h"
#include "models/shaft_supports.h"

namespace whirl_twin {

namespace {

using Eigen::Index;

bool isHeld(const FlexibleShaft& shaft, int node) {
  return shaft.pedestalsOf(node) == 0 &&
         std::any_of(shaft.rigid_supports.begin(), shaft.rigid_supports.end(),
                     [node](const RigidSupport& support) { return support.node == node; });
}

int probeNode(const Settings& settings, const FlexibleShaft& shaft) {
  const std::string& given = settings.choices.at("probe_node");
  const int last = shaft.nodes() - 1;
  if (given == "auto") {
    std::vector<int> choice;
    for (const NodeUnbalance& unbalance : shaft.unbalances) {
      choice.push_back(unbalance.node);
    }
    for (const RotorDisc& disc : shaft.discs) {
      choice.push_back(disc.node);
    }
    choice.push_back(last / 2);
    for (int node = last; node >= 0; --node) {
      choice.push_back(node);
    }
    const auto moves =
        std::find_if(choice.begin(), choice.end(), [&](int node) { return !isHeld(shaft, node); });
    if (moves == choice.end()) {
      throw SetupError("bearings", "must leave a free node, found every node rigidly supported");
    }
    return *moves;
  }
  const int node = std::stoi(given);
  if (node > last) {
    throw SetupError(
        "probe_node",
        fmt::format("must be auto or a whole number from 0 to {}, found {}", last, node));
  }
  if (isHeld(shaft, node)) {
    throw SetupError("probe_node",
                     fmt::format("must be a free node; node {} has a pin or clamp", node));
  }
  return node;
}

/// The stations with the one of `node` first, and those of `further` marked.
std::vector<Station> publishedFirst(std::vector<Station> stations, int node,
                                    const std::vector<int>& further = {}) {
  for (const int i : further) {
    stations[static_cast<std::size_t>(i)].published = i != node;
  }
  std::rotate(stations.begin(), stations.begin() + node, stations.begin() + node + 1);
  return stations;
}

/// The nodes whose displacements are coordinates. A force on another one would have to bend the
/// shaft there at once, or does nothing.
std::vector<std::size_t> pushableNodes(const FlexibleShaft& shaft, const RotorAssembly& assembly) {
  std::vector<std::size_t> nodes;
  const std::vector<Index>& moving = assembly.moving();
  for (int node = 0; node < shaft.nodes(); ++node) {
    if (std::binary_search(moving.begin(), moving.end(), shaft.firstOf(node))) {
      nodes.push_back(static_cast<std::size_t>(node));
    }
  }
  return nodes;
}

/// Forces along x and y at these nodes, and the control currents of magnets.
std::vector<InputInfo> inputsAt(const std::vector<std::size_t>& nodes,
                                const std::vector<Station>& stations,
                                const std::vector<PlacedMagnet>& magnets) {
  std::vector<InputInfo> all;
  for (const std::size_t node : nodes) {
    all.push_back({fmt::format("force_x_{}", node), "N", stations[node].along_x,
                   fmt::format("on node {}, along x", node)});
    all.push_back({fmt::format("force_y_{}", node), "N", stations[node].along_y,
                   fmt::format("on node {}, along y", node)});
  }
  for (const PlacedMagnet& magnet : magnets) {
    for (const InputInfo& current : currentsOf(magnet)) {
      all.push_back(current);
    }
  }
  return all;
}

/// Named by their nodes.
std::vector<PlacedMagnet> placed(const std::vector<NodeMagnet>& magnets,
                                 const std::vector<Station>& stations) {
  std::vector<PlacedMagnet> all;
  for (const NodeMagnet& at : magnets) {
    const Station& station = stations[static_cast<std::size_t>(at.node)];
    all.push_back({at.magnet, std::to_string(at.node), station.along_x, station.along_y});
  }
  return all;
}

/// In the order of RotorAssembly, those that are left in it.
std::vector<CoordinateInfo> nodeCoordinates(const FlexibleShaft& shaft,
                                            const RotorAssembly& assembly) {
  std::vector<CoordinateInfo> all;
  for (int i = 0; i < shaft.nodes(); ++i) {
    all.push_back({fmt::format("x_{}", i), "m"});
    all.push_back({fmt::format("y_{}", i), "m"});
    all.push_back({fmt::format("alpha_{}", i), "rad"});
    all.push_back({fmt::format("beta_{}", i), "rad"});
    for (int below = 1; below <= shaft.pedestalsOf(i); ++below) {
      const std::string which = below == 1 ? std::to_string(i) : fmt::format("{}_{}", i, below);
      all.push_back({"pedestal_x_" + which, "m"});
      all.push_back({"pedestal_y_" + which, "m"});
    }
  }
  std::vector<CoordinateInfo> left;
  for (const Index i : assembly.moving()) {
    left.push_back(all[static_cast<std::size_t>(i)]);
  }
  return left;
}

std::vector<CoordinateInfo> shapeCoordinates(Index count) {
  std::vector<CoordinateInfo> all;
  for (Index i = 1; i <= count; ++i) {
    all.push_back({fmt::format("q{}", i), "m"});
  }
  return all;
}

/// [m]: the mass centre's distance from the shaft if all unbalance were in one place.
double whirlLength(const FlexibleShaft& shaft, double mass) {
  double sum = 0.0;
  for (const NodeUnbalance& unbalance : shaft.unbalances) {
    sum += unbalance.magnitude;
  }
  return sum > 0.0 ? sum / mass : 1.0;
}

/// The stations that shapes are scaled by: every place that moves.
std::vector<Station> everywhere(std::vector<Station> stations,
                                const std::vector<Station>& pedestals) {
  stations.insert(stations.end(), pedestals.begin(), pedestals.end());
  return stations;
}

RotorReduction reduction(const LinearRotor& rotor, const std::vector<Station>& stations,
                         const Eigen::MatrixXd& pushed, const ParameterValues& values,
                         const std::string& modes, const char* coordinates) {
  const double given = values.at("highest_speed");
  const double highest = given > 0.0 ? given : usualHighestSpeed(rotor);
  if (modes == "auto") {
    return reduceRotorTo(rotor, stations, highest, values.at("tolerance"), pushed);
  }
  const int count = std::stoi(modes);
  if (count > rotor.dof()) {
    throw SetupError("modes",
                     fmt::format("must be auto or a whole number from 0 to {}, {}, found {}",
                                 rotor.dof(), coordinates, count));
  }
  return reduceRotor(rotor, stations, highest, count, pushed);
}

/// Of all that the motor turns.
SpinCoupling spinOf(const FlexibleShaft& shaft, const RotorAssembly& assembly,
                    const ParameterValues& values, const Motor& motor) {
  return {rotorBody(shaft).polar_inertia + values.at("driven_inertia"), motor,
          assembly.circulatoryPerSpeed(), assembly.turningDamping()};
}

void requireFinite(const LinearRotor& rotor) {
  const Linearization l = rotor.matrices(0.0);
  if (!l.mass.allFinite() || !l.stiffness.allFinite() || !l.damping.allFinite() ||
      !(l.mass.diagonal().array() > 0.0).all()) {
    throw SetupError("elements",
                     "must give masses and stiffnesses within the range of doubles; those of this "
                     "shaft and material exceed it");
  }
}

std::shared_ptr<const Dynamics> dynamicsOf(RotorDescription description, LinearRotor rotor) {
  try {
    return std::make_shared<const LinearRotorDynamics>(std::move(description), std::move(rotor));
  } catch (const InputError&) {
    throw SetupError("elements",
                     "must give every motion a mass above the rounding error of the others");
  }
}

/// Of magnets, whose currents are the inputs behind those of `pushable` nodes, and of elements.
std::vector<LocalForce> allForcesOf(const std::vector<PlacedMagnet>& magnets, std::size_t pushable,
                                    const std::vector<NodeElement>& elements,
                                    const FlexibleShaft& shaft, const RotorAssembly& assembly) {
  std::vector<LocalForce> forces = localForcesOf(magnets, 2 * pushable);
  for (LocalForce& force : forcesOf(elements, shaft, assembly)) {
    forces.push_back(std::move(force));
  }
  return forces;
}

RotorAssembly assembled(const FlexibleShaft& shaft) {
  try {
    return RotorAssembly(shaft);
  } catch (const InputError& inputError) {
    throw SetupError("elements", inputError.what());
  }
}

const char* coordinatesInWords(const FlexibleShaft& shaft, const RotorAssembly& assembly) {
  return static_cast<Index>(assembly.moving().size()) < shaft.coordinates()
             ? "those with mass and without a rigid support"
         : shaft.pedestals.empty() ? "four per node"
                                   : "four per node and two per pedestal";
}

std::shared_ptr<const FullOrderRotor> unreducedRotor(const RotorAssembly& assembly,
                                                     const Eigen::MatrixXd& shapes,
                                                     const FlexibleShaft& shaft,
                                                     const Settings& settings,
                                                     const std::vector<NodeElement>& elements) {
  const auto magnets = placed(nodeMagnets(settings, shaft.nodes()), assembly.stations());
  return std::make_shared<const FullOrderRotor>(FullOrderRotor{
      std::make_shared<const RotorAssembly>(assembly), shapes,
      allForcesOf(magnets, pushableNodes(shaft, assembly).size(), elements, shaft, assembly)});
}

ModelSetup setUpFlexibleRotor(const ParameterValues& values, const Settings& settings,
                              const ModelContext& around) {
  FlexibleShaft shaft = flexibleShaft(values, settings, around.gravity);
  const int probe = probeNode(settings, shaft);
  shaft.pushed.push_back(probe);  // analyses put a cross-coupling there
  const std::vector<NodeElement> elements = nodeElements(settings, shaft.nodes());
  RotorAssembly assembly = assembled(withDamping(shaft, elements));
  const std::vector<std::size_t> pushable = pushableNodes(shaft, assembly);
  requireFinite(assembly.linearRotor());

  RotorDescription description;
  description.model = "flexible_rotor";
  description.natural_length = whirlLength(shaft, rotorBody(shaft).mass);
  description.phase_mark = values.at("phase_mark");
  std::vector<std::string> notes = shaftNotes(values, settings, shaft);
  if (!assembly.massive().empty()) {
    notes.push_back(
        fmt::format("{} coordinates of the shaft have no mass and are not determined by the "
                    "others; each gets {:g} of the heaviest node's",
                    assembly.massive().size(), kNegligible));
  }
  double highest_speed = kInfinity;
  std::shared_ptr<const FullOrderRotor> unreduced;
  const std::string& modes = settings.choices.at("modes");
  if (modes == "0") {
    description.coordinates = nodeCoordinates(shaft, assembly);
  } else {
    const RotorReduction kept =
        reduction(inItsFilms(shaft, elements),
                  everywhere(publishedFirst(assembly.stations(), probe), assembly.pedestals()),
                  directionsOf(forcesOf(elements, shaft, assembly), assembly.dof()), values, modes,
                  coordinatesInWords(shaft, assembly));
    if (kept.shapes.cols() < assembly.dof()) {
      unreduced = unreducedRotor(assembly, kept.shapes, shaft, settings, elements);
    }
    assembly = assembly.in(kept.shapes);
    description.coordinates = shapeCoordinates(kept.shapes.cols());
    notes.insert(notes.begin(), kept.note);
    highest_speed = kept.highest_speed;
  }
  description.stations =
      publishedFirst(assembly.stations(), probe, publishedNodes(settings, shaft));
  description.casing = assembly.pedestals();
  const std::vector<PlacedMagnet> magnets =
      placed(nodeMagnets(settings, shaft.nodes()), assembly.stations());
  description.inputs = inputsAt(pushable, assembly.stations(), magnets);
  description.sketch =
      FlexibleRotorPicture(shaft, assembly.stations(), assembly.pedestals(), probe);
  LinearRotor rotor = assembly.linearRotor(std::move(unreduced));
  rotor.highest_speed = highest_speed;
  std::vector<LocalForce> forces = allForcesOf(magnets, pushable.size(), elements, shaft, assembly);
  const double fastest = std::isfinite(highest_speed)       ? highest_speed
                         : values.at("highest_speed") > 0.0 ? values.at("highest_speed")
                         : around.motor                     ? usualHighestSpeed(rotor)
                                                            : 0.0;
  const std::shared_ptr<const Dynamics> linear =
      dynamicsOf(std::move(description), std::move(rotor));
  ModelSetup setup;
  if (around.motor) {
    try {
      setup = spinningRotorSetup(linear, std::move(forces),
                                 spinOf(shaft, assembly, values, *around.motor), fastest);
    } catch (const InputError&) {
      throw SetupError("unbalances",
                       "with a motor, each eccentricity must be less than the radius of gyration "
                       "of the rotating parts");
    }
  } else {
    setup = linearRotorSetup(linear, std::move(forces));
  }
  setup.note = fmt::format("{}", fmt::join(notes, "; "));
  return setup;
}

}  // namespace

ModelInfo flexibleRotorInfo() {
  ModelInfo info;
  info.name = "flexible_rotor";
  info.summary = "shaft of finite elements with discs, bearings and unbalances";
  info.coordinates_meaning =
      "x_N, y_N (m): of node N from the bearings' line, y up; alpha_N, beta_N (rad): its tilts "
      "about x and y, right-handed; with modes: q1, q2 ... (m), modal";
  info.parameters = materialParameters();
  const std::vector<ParameterInfo> further{
      {"internal_damping", "s", Range::kNotNegative,
       "of the shaft's material: stress = E (strain + this * strain rate)", 0.0, ""},
      {"mass_damping", "1/s", Range::kNotNegative,
       "of the elements, non-rotating: C = this * M (alpha)", 0.0, ""},
      {"stiffness_damping", "s", Range::kNotNegative,
       "of the elements, non-rotating: C = this * K (beta)", 0.0, ""},
      {"highest_speed", "rad/s", Range::kNotNegative,
       "up to which the reduced-order model must be valid; 0: twice the fourth natural frequency",
       0.0, ""},
      {"tolerance", "-", Range::kPositive, "of the unbalance response, for modes: auto", 1.0e-6,
       ""},
      {"driven_inertia", "kg m^2", Range::kNotNegative,
       "with a motor: polar inertia driven besides the shaft and its discs", 0.0, ""},
      {"phase_mark", "rad", Range::kAny,
       "reference of the whirl's phase, from the shaft's phase mark", 0.0, ""}};
  info.parameters.insert(info.parameters.end(), further.begin(), further.end());
  info.settings = flexibleShaftSettings();
  for (SettingInfo& setting : localElementSettings()) {
    info.settings.push_back(std::move(setting));
  }
  info.settings.push_back({"modes",
                           SettingKind::kWordOrCount,
                           "",
                           "number of retained modes; 0: x, y, alpha, beta of every node; auto: as "
                           "many as tolerance requires",
                           {"auto"}});
  info.settings.push_back({"probe_node",
                           SettingKind::kWordOrCount,
                           "",
                           "where whirl is published; auto: at the first unbalance, else the first "
                           "disc, else in the middle",
                           {"auto"}});
  info.variants = {{"", {}, true, true, {Exponential<1>::kName}}};
  info.variants[0].inputs = {{"force_x_NODE", "N", {}, "on a node, along x"},
                             {"force_y_NODE", "N", {}, "on a node, along y"},
                             {"current_x_NODE", "A", {}, "of a magnet, along x"},
                             {"current_y_NODE", "A", {}, "of a magnet, along y"}};
  info.has_shaft = true;
  info.takes_motor = true;
  ModelVariant on_motor = info.variants[0];
  on_motor.when = "a motor";
  on_motor.linear = false;
  on_motor.motor = true;
  on_motor.inputs.push_back({"torque", "N m", {}, "on the shaft, besides the motor's"});
  info.variants.push_back(on_motor);
  info.setUp = setUpFlexibleRotor;
  return info;
}

}  // namespace whirl_twin
