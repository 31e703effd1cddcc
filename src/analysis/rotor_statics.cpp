#include "analysis/rotor_statics.h"

#include "algebra/banded_matrix.h"
#include "algebra/dense.h"

namespace whirl_twin {

namespace {

constexpr double kFreePivot = 1.0e-9;  // a pivot of the stiffness scaled to unit diagonal

Across add(const Across& a, const Across& b) {
  return {a.x + b.x, a.y + b.y};
}

/// Force of a bearing on a shaft with the given deflection relative to the bearing's pedestal.
BearingLoad forceOf(const FlexibleShaft& shaft, int node, const BearingCoefficients& b,
                    const Eigen::VectorXd& q) {
  const Eigen::Index first = shaft.firstOf(node);
  double x = q[first];
  double y = q[first + 1];
  if (shaft.pedestalsOf(node) > 0) {
    x -= q[first + kNodeCoordinates];
    y -= q[first + kNodeCoordinates + 1];
  }
  return {node, {-b.kxx * x - b.kxy * y, -b.kyx * x - b.kyy * y}};
}

/// [n], of all coordinates; nothing where some motion is free.
std::optional<Eigen::VectorXd> deflection(const FlexibleShaft& shaft, const RotorAssembly& assembly,
                                          double speed) {
  const auto holds = [](const BandedMatrix<double>& stiffness) {
    const Eigen::ArrayXd own = stiffness.diagonal().array();
    return (own > 0.0).all() && hasCholesky(stiffness.scaled(own.rsqrt()), kFreePivot);
  };
  if (shaft.rigid_supports.empty()) {
    const BandedLinearization l = assembly.bandedMatrices(speed);
    if (!holds(l.stiffness)) {
      return std::nullopt;
    }
    return BandedLU<double>(l.byPlace()).solve(assembly.load());
  }
  const Linearization all = assembly.matrices(speed);
  const Eigen::MatrixXd shapes = supportedShapes(all.mass.rows(), heldCoordinates(shaft));
  const Eigen::MatrixXd stiffness = shapes.transpose() * all.stiffness * shapes;
  const Eigen::MatrixXd circulatory = shapes.transpose() * all.circulatory * shapes;
  if (!holds(BandedMatrix<double>::of(stiffness))) {
    return std::nullopt;
  }
  return shapes * Lu(stiffness + circulatory).solve(shapes.transpose() * assembly.load());
}

/// [n], what rigid supports push the rotor with.
Eigen::VectorXd heldBy(const FlexibleShaft& shaft, const RotorAssembly& assembly, double speed,
                       const Eigen::VectorXd& q) {
  if (shaft.rigid_supports.empty()) {
    return Eigen::VectorXd::Zero(q.size());
  }
  const Linearization all = assembly.matrices(speed);
  return (all.stiffness + all.circulatory) * q - assembly.load();
}

}  // namespace

RotorBody rotorBody(const FlexibleShaft& shaft) {
  const std::vector<double> z = shaft.positions();
  RotorBody body;
  double moment = 0.0;
  const auto each = [&](const auto& take) {  // mass, place, transverse and polar inertia
    for (std::size_t i = 0; i < shaft.elements.size(); ++i) {
      const ElementBody element = elementBody(shaft.layers(static_cast<int>(i)));
      take(element.mass, z[i] + element.centre, element.transverse_inertia, element.polar_inertia);
    }
    for (const RotorDisc& disc : shaft.discs) {
      take(disc.mass, z[static_cast<std::size_t>(disc.node)], disc.transverse_inertia,
           disc.polar_inertia);
    }
  };
  each([&](double mass, double place, double, double polar) {
    body.mass += mass;
    moment += mass * place;
    body.polar_inertia += polar;
  });
  body.centre = moment / body.mass;
  each([&](double mass, double place, double transverse, double) {
    body.transverse_inertia += transverse + mass * (place - body.centre) * (place - body.centre);
  });
  return body;
}

std::optional<RotorStatics> rotorStatics(const FlexibleShaft& shaft, double gravity, double speed) {
  FlexibleShaft heavy = shaft;
  heavy.gravity = gravity;
  const RotorAssembly assembly = RotorAssembly::unsupported(heavy);
  const auto deflected = deflection(shaft, assembly, speed);
  if (!deflected) {
    return std::nullopt;
  }
  const Eigen::VectorXd& q = *deflected;
  const Eigen::VectorXd held = heldBy(shaft, assembly, speed, q);

  RotorStatics statics;
  for (const RotorBearing& bearing : shaft.bearings) {
    statics.bearings.push_back(forceOf(shaft, bearing.node, bearing.coefficients, q));
  }
  for (const SpeedBearing& bearing : shaft.speed_bearings) {
    statics.bearings.push_back(forceOf(shaft, bearing.node, bearing.coefficients(speed), q));
  }
  std::vector<Across> at_nodes(static_cast<std::size_t>(shaft.nodes()));
  std::vector<Across> moments(at_nodes.size());  // of clamps
  for (const RigidSupport& support : shaft.rigid_supports) {
    const Eigen::Index x = shaft.firstOf(support.node);
    statics.bearings.push_back({support.node, {held[x], held[x + 1]}});
    if (support.clamps) {  // alpha is minus the slope along y, beta that along x
      moments[static_cast<std::size_t>(support.node)] = {-held[x + 3], held[x + 2]};
    }
  }
  for (const BearingLoad& bearing : statics.bearings) {
    Across& there = at_nodes[static_cast<std::size_t>(bearing.node)];
    there = add(there, bearing.force);
  }
  for (const RotorDisc& disc : shaft.discs) {
    at_nodes[static_cast<std::size_t>(disc.node)].y -= disc.mass * gravity;
  }
  const std::vector<double> z = shaft.positions();
  Across shear;
  Across moment;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const auto first = shaft.firstOf(static_cast<int>(i));
    moment = add(moment, moments[i]);
    SagAtNode node{z[i], {q[first], q[first + 1]}, shear, add(shear, at_nodes[i]), moment};
    statics.nodes.push_back(node);
    if (i < shaft.elements.size()) {
      const double length = shaft.elements[i].length;
      const ElementBody element = elementBody(shaft.layers(static_cast<int>(i)));
      const double weight = element.mass * gravity;
      shear = {node.shear_after.x, node.shear_after.y - weight};
      moment = {moment.x + node.shear_after.x * length,
                moment.y + node.shear_after.y * length - weight * (length - element.centre)};
    }
  }
  return statics;
}

}  // namespace whirl_twin
