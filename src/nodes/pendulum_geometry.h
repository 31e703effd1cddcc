// Where the joints of a pendulum are, from its coordinates and the scene's parameters.
//
// Pendulum axes: z up, origin at the pivot; theta is measured from hanging down and swings towards
// +x at plane angle 0. A driven or free spin turns the plane of the swing about z by the plane
// angle.
#pragma once

#include <XmlRpcValue.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "whirl_twin/DriveState.h"
#include "whirl_twin/PendulumState.h"

namespace whirl_twin {

/// What the scene says about a pendulum beyond its messages; defaults where it says nothing.
struct PendulumGeometry {
  std::string model;     ///< empty: not known
  double length1 = 0.5;  ///< [m]
  double length2 = 0.5;  ///< [m]
  std::string drive;     ///< the shaft that turns the plane; empty: none
  double speed = 0.0;    ///< [rad/s], of the plane without a drive
};

/// Reads a system of the scene (`model`, `drive`, `parameters`) as the ROS parameters hold it;
/// numbers may be int, double or string (YAML 1.1 takes 1e-1 for a string).
PendulumGeometry pendulumGeometry(XmlRpc::XmlRpcValue system);

/// Angle [rad] of the plane of the swing about the vertical.
/// @param drive state of the geometry's drive; null without one
double planeAngle(const PendulumState& state, const PendulumGeometry& geometry,
                  const DriveState* drive);

/// Pivot, joints and last bob, in order, in pendulum axes [m]; empty when the coordinates are not
/// those of a pendulum this knows: (theta), (theta, phi), (theta1, theta2) absolute or (theta1,
/// theta3) with theta3 relative to the first rod.
std::vector<Eigen::Vector3d> pendulumJoints(const PendulumState& state,
                                            const PendulumGeometry& geometry, double plane_angle);

}  // namespace whirl_twin
