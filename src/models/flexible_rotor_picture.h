// A flexible rotor from the side: its bent shaft, discs and bearings, to scale.
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
  /// `stations`: of the nodes 0, 1 ..., in the coordinates that it is drawn from.
  FlexibleRotorPicture(const FlexibleShaft& shaft, std::vector<Station> stations, int probe_node);
  Sketch operator()(const Eigen::VectorXd& q, double angle) const;

 private:
  struct Disc {
    int node;
    double radius, thickness;  ///< [m]
  };

  std::vector<double> radii_;  ///< [m], of the elements
  std::vector<Disc> discs_;
  std::vector<int> bearings_;
  std::vector<Station> stations_;
  int probe_node_;
  double length_, height_;  ///< [m]
};

}  // namespace whirl_twin
