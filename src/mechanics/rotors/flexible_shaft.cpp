// What a shaft is made of, node by node, and what its bearings do there.
#include <algorithm>
#include <vector>

#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Adds a bearing at `place` [dof x 2]; what is not symmetric does not store or dissipate.
void add(const BearingCoefficients& b, const MatrixXd& place, Linearization& l) {
  Eigen::Matrix2d k;
  Eigen::Matrix2d c;
  Eigen::Matrix2d m;
  k << b.kxx, b.kxy, b.kyx, b.kyy;
  c << b.cxx, b.cxy, b.cyx, b.cyy;
  m << b.mxx, b.mxy, b.mxy, b.myy;
  const auto part = [&place](const Eigen::Matrix2d& of, MatrixXd& even, MatrixXd& odd) {
    const MatrixXd whole = (place * of) * place.transpose();
    even += 0.5 * (whole + whole.transpose());
    odd += 0.5 * (whole - whole.transpose());
  };
  part(k, l.stiffness, l.circulatory);
  part(c, l.damping, l.gyroscopic);
  if (!m.isZero(0.0)) {
    l.mass += place * m * place.transpose();
  }
}

}  // namespace

void addBearing(const BearingCoefficients& b, const MatrixXd& place, BandedLinearization& l) {
  std::vector<Index> coordinates;
  for (Index i = 0; i < place.rows(); ++i) {
    if (!place.row(i).isZero(0.0)) {
      coordinates.push_back(i);
    }
  }
  const auto at = static_cast<Index>(coordinates.size());
  MatrixXd there(at, 2);
  for (Index i = 0; i < at; ++i) {
    there.row(i) = place.row(coordinates[static_cast<std::size_t>(i)]);
  }
  const MatrixXd zero = MatrixXd::Zero(at, at);
  Linearization own{zero, zero, zero, zero, zero};
  add(b, there, own);
  const auto put = [&](const MatrixXd& from, BandedMatrix<double>& to) {
    to.widen(coordinates.back() - coordinates.front());
    for (Index i = 0; i < at; ++i) {
      for (Index j = 0; j < at; ++j) {
        to(coordinates[static_cast<std::size_t>(i)], coordinates[static_cast<std::size_t>(j)]) +=
            from(i, j);
      }
    }
  };
  put(own.mass, l.mass);
  put(own.stiffness, l.stiffness);
  put(own.circulatory, l.circulatory);
  put(own.damping, l.damping);
  put(own.gyroscopic, l.gyroscopic);
}

std::vector<double> FlexibleShaft::positions() const {
  std::vector<double> z{0.0};
  for (const ShaftSection& element : elements) {
    z.push_back(z.back() + element.length);
  }
  return z;
}

std::vector<ShaftLayer> FlexibleShaft::layers(int element) const {
  const ShaftSection& section = elements[static_cast<std::size_t>(element)];
  std::vector<ShaftLayer> all{{section.material.value_or(material), section}};
  for (const ShaftSleeve& sleeve : sleeves) {
    if (sleeve.element == element) {
      all.push_back(sleeve.layer);
    }
  }
  return all;
}

Index FlexibleShaft::firstOf(int node) const {
  const auto before =
      std::count_if(pedestals.begin(), pedestals.end(),
                    [node](const RotorPedestal& pedestal) { return pedestal.node < node; });
  return node * kNodeCoordinates + before * 2;
}

int FlexibleShaft::pedestalsOf(int node) const {
  return static_cast<int>(
      std::count_if(pedestals.begin(), pedestals.end(),
                    [node](const RotorPedestal& pedestal) { return pedestal.node == node; }));
}

std::vector<HeldCoordinate> heldCoordinates(const FlexibleShaft& shaft) {
  std::vector<HeldCoordinate> held;
  for (const RigidSupport& support : shaft.rigid_supports) {
    const Index x = shaft.firstOf(support.node);
    const bool grounded = shaft.pedestalsOf(support.node) == 0;
    for (const Index axis : {0, 1}) {
      held.push_back({x + axis, grounded ? HeldCoordinate::kGround : x + kNodeCoordinates + axis});
    }
    for (const Index slope : {2, 3}) {
      if (support.clamps) {
        held.push_back({x + slope, HeldCoordinate::kGround});
      }
    }
  }
  return held;
}

}  // namespace whirl_twin
