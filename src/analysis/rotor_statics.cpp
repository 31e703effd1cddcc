#include "analysis/rotor_statics.h"

#include "algebra/banded_matrix.h"

namespace whirl_twin {

namespace {

constexpr double kFreePivot = 1.0e-9;  // a pivot of the stiffness scaled to unit diagonal

Across add(const Across& a, const Across& b) {
  return {a.x + b.x, a.y + b.y};
}

/// What a bearing puts on a shaft that is deflected there, beside the pedestal that it stands on.
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
  const RotorAssembly assembly(heavy);
  const BandedLinearization l = assembly.bandedMatrices(speed);
  const Eigen::ArrayXd stiffness = l.stiffness.diagonal().array();
  if (!(stiffness > 0.0).all() || !hasCholesky(l.stiffness.scaled(stiffness.rsqrt()), kFreePivot)) {
    return std::nullopt;
  }
  const Eigen::VectorXd q = BandedLU<double>(l.byPlace()).solve(assembly.linearRotor().load);

  RotorStatics statics;
  for (const RotorBearing& bearing : shaft.bearings) {
    statics.bearings.push_back(forceOf(shaft, bearing.node, bearing.coefficients, q));
  }
  for (const SpeedBearing& bearing : shaft.speed_bearings) {
    statics.bearings.push_back(forceOf(shaft, bearing.node, bearing.coefficients(speed), q));
  }
  std::vector<Across> at_nodes(static_cast<std::size_t>(shaft.nodes()));
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
