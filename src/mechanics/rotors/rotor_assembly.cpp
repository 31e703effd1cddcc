#include "mechanics/rotors/rotor_assembly.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kNoEnergy = 1.0e-13;   // of what the parts of a sum of energies come to
constexpr double kUnresisted = 1.0e-9;  // of what the parts of a force come to

/// J q: the quarter turn from x to y of displacements and rotations.
MatrixXd quarterTurn(Index dof) {
  MatrixXd turn = MatrixXd::Zero(dof, dof);
  for (Index i = 0; i < dof; i += 2) {
    turn(i, i + 1) = -1.0;
    turn(i + 1, i) = 1.0;
  }
  return turn;
}

void requireNodes(const FlexibleShaft& shaft) {
  const auto require = [&](int node, const char* what) {
    if (node < 0 || node >= shaft.nodes()) {
      throw std::logic_error(std::string(what) + ": node must be 0 to " +
                             std::to_string(shaft.nodes() - 1) + ", found " + std::to_string(node));
    }
  };
  for (const RotorDisc& disc : shaft.discs) {
    require(disc.node, "disc");
  }
  for (const RotorBearing& bearing : shaft.bearings) {
    require(bearing.node, "bearing");
  }
  for (const SpeedBearing& bearing : shaft.speed_bearings) {
    require(bearing.node, "bearing");
  }
  for (const NodeUnbalance& unbalance : shaft.unbalances) {
    require(unbalance.node, "unbalance");
  }
  for (const RotorPedestal& pedestal : shaft.pedestals) {
    require(pedestal.node, "pedestal");
  }
  for (const RigidSupport& support : shaft.rigid_supports) {
    require(support.node, "rigid support");
  }
}

/// Of a rotor without bearings the shapes that bend nothing: what rounding leaves of their
/// stiffness is not one, and would make their zero eigenvalues real or imaginary by chance.
std::vector<Index> rigidShapes(const MatrixXd& stiffness, const MatrixXd& shapes) {
  std::vector<Index> rigid;
  for (Index i = 0; i < shapes.cols(); ++i) {
    const Eigen::VectorXd shape = shapes.col(i);
    const Eigen::VectorXd size = shape.cwiseAbs();
    if (std::fabs(shape.dot(stiffness * shape)) <=
        kNoEnergy * size.dot(stiffness.cwiseAbs() * size)) {
      rigid.push_back(i);
    }
  }
  return rigid;
}

}  // namespace

RotorAssembly::RotorAssembly(const FlexibleShaft& shaft) {
  assemble(shaft);
  reduce(shaft);
  if (!shaft.modal_damping.empty()) {
    const Linearization at_rest = matrices(0.0);
    constant_.damping += modalDamping(at_rest.mass, at_rest.stiffness, shaft.modal_damping);
  }
  makeBands();
}

RotorAssembly RotorAssembly::unsupported(const FlexibleShaft& shaft) {
  RotorAssembly all;
  all.assemble(shaft);
  all.makeBands();
  return all;
}

void RotorAssembly::assemble(const FlexibleShaft& shaft) {
  requireNodes(shaft);
  const Index n = shaft.coordinates();
  const MatrixXd zero = MatrixXd::Zero(n, n);
  constant_ = {zero, zero, zero, zero, zero};
  gyroscopic_per_speed_ = zero;
  turning_damping_ = addElements(shaft);
  const MatrixXd circulatory = -turning_damping_ * quarterTurn(n);
  circulatory_per_speed_ = 0.5 * (circulatory - circulatory.transpose());

  for (const RotorDisc& disc : shaft.discs) {
    const Index x = shaft.firstOf(disc.node);
    constant_.mass(x, x) += disc.mass;
    constant_.mass(x + 1, x + 1) += disc.mass;
    constant_.mass(x + 2, x + 2) += disc.transverse_inertia;
    constant_.mass(x + 3, x + 3) += disc.transverse_inertia;
    gyroscopic_per_speed_(x + 2, x + 3) += disc.polar_inertia;
    gyroscopic_per_speed_(x + 3, x + 2) -= disc.polar_inertia;
    if (disc.skew != 0.0) {
      // The slope of its axis is (beta, -alpha), as an unbalance lies along (x, y).
      ShaftForce force{Eigen::VectorXcd::Zero(n), 1, true};
      const std::complex<double> along_x =
          std::polar((disc.transverse_inertia - disc.polar_inertia) * disc.skew, disc.skew_angle);
      force.amplitude[x + 3] = along_x;
      force.amplitude[x + 2] = std::complex<double>(0.0, 1.0) * along_x;
      forces_.push_back(force);
    }
  }
  for (const NodeUnbalance& unbalance : shaft.unbalances) {
    ShaftForce force{Eigen::VectorXcd::Zero(n), 1, true};
    const std::complex<double> along_x = std::polar(unbalance.magnitude, unbalance.angle);
    force.amplitude[shaft.firstOf(unbalance.node)] = along_x;
    force.amplitude[shaft.firstOf(unbalance.node) + 1] = std::complex<double>(0.0, -1.0) * along_x;
    forces_.push_back(force);
  }
  // A shaft that moves along y without turning has the inertia of its weight. Pedestals stood under
  // theirs before it was aligned, and what a film moves along has none.
  Eigen::VectorXd along_y = Eigen::VectorXd::Zero(n);
  const std::vector<double> z = shaft.positions();
  for (int node = 0; node < shaft.nodes(); ++node) {
    const Index x = shaft.firstOf(node);
    along_y[x + 1] = 1.0;
    stations_.push_back({"node_" + std::to_string(node), z[static_cast<std::size_t>(node)],
                         Eigen::VectorXd::Unit(n, x), Eigen::VectorXd::Unit(n, x + 1)});
  }
  load_ = -shaft.gravity * (constant_.mass * along_y);
  addSupports(shaft);
}

void RotorAssembly::reduce(const FlexibleShaft& shaft) {
  const Index n = shaft.coordinates();
  moving_.resize(static_cast<std::size_t>(n));
  std::iota(moving_.begin(), moving_.end(), 0);
  const Eigen::VectorXd own = constant_.mass.diagonal();
  if (shaft.rigid_supports.empty() && (own.array() != 0.0).all()) {
    return;
  }
  std::vector<bool> acted(static_cast<std::size_t>(n), false);
  for (const ShaftForce& force : forces_) {
    for (Index i = 0; i < n; ++i) {
      acted[static_cast<std::size_t>(i)] =
          acted[static_cast<std::size_t>(i)] || force.amplitude[i] != 0.0;
    }
  }
  for (const PlacedBearing& placed : speed_bearings_) {
    for (Index i = 0; i < n; ++i) {
      acted[static_cast<std::size_t>(i)] =
          acted[static_cast<std::size_t>(i)] || !placed.place.row(i).isZero(0.0);
    }
  }
  for (const int node : shaft.pushed) {
    for (const Index axis : {0, 1}) {
      acted[static_cast<std::size_t>(shaft.firstOf(node) + axis)] = true;
    }
  }
  const MovingCoordinates kept =
      movingCoordinates(constant_.mass, constant_.stiffness,
                        {constant_.damping, constant_.gyroscopic, constant_.circulatory,
                         gyroscopic_per_speed_, circulatory_per_speed_},
                        acted, heldCoordinates(shaft));
  // The largest masses and inertias of nodes, which are in proportion to the rotor's.
  double mass = 0.0;
  for (Index i = 0; i < n; i += 2) {
    mass = std::max(mass, own[i]);
  }
  const double length = shaft.positions().back() / static_cast<double>(shaft.nodes());
  std::vector<bool> is_slope(static_cast<std::size_t>(n), false);
  for (int node = 0; node < shaft.nodes(); ++node) {
    for (const Index slope : {2, 3}) {
      is_slope[static_cast<std::size_t>(shaft.firstOf(node) + slope)] = true;
    }
  }
  for (const Index i : kept.massive) {
    const double arm = is_slope[static_cast<std::size_t>(i)] ? length : 1.0;
    constant_.mass(i, i) = kNegligible * mass * arm * arm;
  }
  *this = in(kept.shapes);
  moving_ = kept.moving;
  massive_ = kept.massive;
}

MatrixXd RotorAssembly::addElements(const FlexibleShaft& shaft) {
  const Index n = shaft.coordinates();
  MatrixXd of_loads = MatrixXd::Zero(n, n);
  MatrixXd turning = MatrixXd::Zero(n, n);
  MatrixXd of_couplings = MatrixXd::Zero(n, n);
  for (int i = 0; i + 1 < shaft.nodes(); ++i) {
    const ShaftSection& section = shaft.elements[static_cast<std::size_t>(i)];
    const ShaftElement element =
        section.coupling ? couplingElement(*section.coupling, section.length, section.axial_force,
                                           section.torque)
                         : shaftElement(shaft.layers(i), section.axial_force, section.torque);
    const auto put = [&](const ShaftElement::Matrix& from, MatrixXd& to) {
      constexpr Index kOne = kNodeCoordinates;
      const Index ends[] = {shaft.firstOf(i), shaft.firstOf(i + 1)};
      for (Index a = 0; a < 2; ++a) {
        for (Index b = 0; b < 2; ++b) {
          to.block<kOne, kOne>(ends[a], ends[b]) += from.block<kOne, kOne>(a * kOne, b * kOne);
        }
      }
    };
    put(element.mass, constant_.mass);
    put(element.stiffness, section.coupling ? of_couplings : constant_.stiffness);
    put(element.gyroscopic, gyroscopic_per_speed_);
    put(element.of_loads, of_loads);
    put(element.circulatory, constant_.circulatory);
    put(element.damping, turning);
  }
  turning += shaft.internal_damping * constant_.stiffness;
  constant_.damping =
      turning + shaft.mass_damping * constant_.mass + shaft.stiffness_damping * constant_.stiffness;
  constant_.stiffness += of_couplings + of_loads;
  return turning;
}

void RotorAssembly::addSupports(const FlexibleShaft& shaft) {
  const Index n = shaft.coordinates();
  const auto across = [n](Index first) {
    return MatrixXd(MatrixXd::Identity(n, n).middleCols(first, 2));
  };
  /// Of what moves at `first` beside a pedestal that follows `above` others of its node.
  const auto place = [&](Index first, int node, int above) {
    MatrixXd relative = across(first);
    if (above < shaft.pedestalsOf(node)) {
      relative -= across(shaft.firstOf(node) + kNodeCoordinates + 2 * above);
    }
    return relative;
  };
  for (const RotorBearing& bearing : shaft.bearings) {
    add(bearing.coefficients, place(shaft.firstOf(bearing.node), bearing.node, 0), constant_);
  }
  for (const SpeedBearing& bearing : shaft.speed_bearings) {
    speed_bearings_.push_back({bearing, place(shaft.firstOf(bearing.node), bearing.node, 0)});
  }
  const std::vector<double> z = shaft.positions();
  std::vector<int> above(z.size(), 0);
  for (const RotorPedestal& pedestal : shaft.pedestals) {
    const auto node = static_cast<std::size_t>(pedestal.node);
    const Index x = shaft.firstOf(pedestal.node) + kNodeCoordinates + 2 * above[node]++;
    constant_.mass(x, x) += pedestal.mass_x;
    constant_.mass(x + 1, x + 1) += pedestal.mass_y;
    const MatrixXd below = place(x, pedestal.node, above[node]);
    add(pedestal.coefficients, below, constant_);
    if (pedestal.over_speed) {
      speed_bearings_.push_back(
          {{pedestal.node, pedestal.over_speed, pedestal.knots, pedestal.data}, below});
    }
    const std::string chained = above[node] == 1 ? "" : "_" + std::to_string(above[node]);
    pedestals_.push_back({"pedestal_" + std::to_string(node) + chained, z[node],
                          Eigen::VectorXd::Unit(n, x), Eigen::VectorXd::Unit(n, x + 1)});
  }
}

void RotorAssembly::makeBands() {
  banded_ = banded(constant_);
  banded_gyroscopic_ = BandedMatrix<double>::of(gyroscopic_per_speed_);
  banded_circulatory_ = BandedMatrix<double>::of(circulatory_per_speed_);
}

Linearization RotorAssembly::matrices(double speed) const {
  Linearization l = constant_;
  l.gyroscopic += speed * gyroscopic_per_speed_;
  l.circulatory += speed * circulatory_per_speed_;
  for (const PlacedBearing& placed : speed_bearings_) {
    add(placed.bearing.coefficients(speed), placed.place, l);
  }
  return l;
}

BandedLinearization RotorAssembly::bandedMatrices(double speed) const {
  BandedLinearization l = banded_;
  l.gyroscopic.add(speed, banded_gyroscopic_);
  l.circulatory.add(speed, banded_circulatory_);
  for (const PlacedBearing& placed : speed_bearings_) {
    addBearing(placed.bearing.coefficients(speed), placed.place, l);
  }
  return l;
}

DataSpeeds RotorAssembly::dataSpeeds() const {
  DataSpeeds all;
  for (const PlacedBearing& placed : speed_bearings_) {
    all.from = std::max(all.from, placed.bearing.data.from);
    all.to = std::min(all.to, placed.bearing.data.to);
  }
  return all;
}

DataSpeeds dataSpeeds(const LinearRotor& rotor) {
  const auto* assembled = rotor.matrices.target<AssembledMatrices>();
  return assembled ? assembled->assembly->dataSpeeds() : DataSpeeds{};
}

Station RotorAssembly::station(int node) const {
  return stations_.at(static_cast<std::size_t>(node));
}

RotorAssembly RotorAssembly::in(const MatrixXd& shapes) const {
  const std::vector<Index> rigid = rigidShapes(constant_.stiffness, shapes);
  const auto in_shapes = [&](const MatrixXd& m) {
    MatrixXd r = shapes.transpose() * m * shapes;
    for (const Index i : rigid) {
      if ((m * shapes.col(i)).norm() <=
          kUnresisted * (m.cwiseAbs() * shapes.col(i).cwiseAbs()).norm()) {
        r.row(i).setZero();
        r.col(i).setZero();
      }
    }
    return r;
  };
  const auto symmetric = [&](const MatrixXd& m) -> MatrixXd {
    const MatrixXd r = in_shapes(m);
    return 0.5 * (r + r.transpose());
  };
  const auto skew = [&](const MatrixXd& m) -> MatrixXd {
    const MatrixXd r = in_shapes(m);
    return 0.5 * (r - r.transpose());
  };
  RotorAssembly r = *this;
  r.constant_ = {symmetric(constant_.mass), symmetric(constant_.damping),
                 skew(constant_.gyroscopic), symmetric(constant_.stiffness),
                 skew(constant_.circulatory)};
  r.gyroscopic_per_speed_ = skew(gyroscopic_per_speed_);
  r.circulatory_per_speed_ = skew(circulatory_per_speed_);
  r.turning_damping_ = symmetric(turning_damping_);
  for (PlacedBearing& placed : r.speed_bearings_) {
    placed.place = shapes.transpose() * placed.place;
  }
  for (ShaftForce& force : r.forces_) {
    force.amplitude = shapes.transpose().cast<std::complex<double>>() * force.amplitude;
  }
  r.load_ = shapes.transpose() * load_;
  for (std::vector<Station>* stations : {&r.stations_, &r.pedestals_}) {
    for (Station& station : *stations) {
      station.along_x = shapes.transpose() * station.along_x;
      station.along_y = shapes.transpose() * station.along_y;
    }
  }
  r.makeBands();
  return r;
}

LinearRotor RotorAssembly::linearRotor(std::shared_ptr<const FullOrderRotor> unreduced) const {
  LinearRotor rotor;
  rotor.matrices =
      AssembledMatrices{std::make_shared<const RotorAssembly>(*this), std::move(unreduced)};
  rotor.speed_dependent = !speed_bearings_.empty() ||
                          (gyroscopic_per_speed_.array() != 0.0).any() ||
                          (circulatory_per_speed_.array() != 0.0).any();
  for (const PlacedBearing& placed : speed_bearings_) {
    rotor.knots.insert(rotor.knots.end(), placed.bearing.knots.begin(), placed.bearing.knots.end());
  }
  std::sort(rotor.knots.begin(), rotor.knots.end());
  rotor.knots.erase(std::unique(rotor.knots.begin(), rotor.knots.end()), rotor.knots.end());
  rotor.forces = forces_;
  rotor.load = load_;
  return rotor;
}

}  // namespace whirl_twin
