// A flexible rotor from the side: its bent shaft, discs and bearings, to scale. A support of less
// than a tenth of the stiffness of the stiffest bearing is drawn as a seal, a stationary ring
// around the shaft.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/dynamics.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "mechanics/sketch.h"

namespace whirl_twin {

/// The shaft lies along the sketch's x, its y is up, its x goes into the picture.
class FlexibleRotorPicture {
 public:
  /// `stations`: of the nodes 0, 1 ..., `pedestals`: of the shaft's, in the coordinates that it is
  /// drawn from.
  FlexibleRotorPicture(const FlexibleShaft& shaft, std::vector<Station> stations,
                       std::vector<Station> pedestals, int probe_node);
  Sketch operator()(const Eigen::VectorXd& q, double angle) const;

 private:
  struct Disc {
    int node;
    double radius, thickness;  ///< [m]
  };

  /// Of an element or a sleeve, from one place along the element to another [0, 1].
  struct Rod {
    int element;
    double from, to, radius;
    SketchRole role;
  };
  struct Pedestal {
    int node;
    int depth;  ///< 0: under the bearing
  };

  struct Seal {
    int node;
    double radius;  ///< [m]
  };

  double radiusAt(int node) const;
  void addRods(int element, const ShaftSection& section, SketchRole role);

  std::vector<Rod> rods_;
  std::vector<Disc> discs_;
  std::vector<int> bearings_;
  std::vector<Seal> seals_;
  std::vector<Pedestal> pedestals_;
  std::vector<Station> stations_, pedestal_stations_;
  int probe_node_;
  double length_, height_;  ///< [m]
};

}  // namespace whirl_twin
