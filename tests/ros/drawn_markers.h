// Reads back the markers drawn by a display.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "display/system_display.h"

namespace whirl_twin {

/// All markers of a frame of the display, of a system called "system".
inline std::vector<visualization_msgs::Marker> drawn(const SystemDisplay& display,
                                                     const SystemStatus& status,
                                                     const Eigen::Vector3d& place) {
  visualization_msgs::MarkerArray markers;
  MarkerCanvas canvas(markers, "system", display.placedAt(place));
  display.draw(status, canvas);
  return markers.markers;
}

/// The first marker of the part.
inline const visualization_msgs::Marker& part(
    const std::vector<visualization_msgs::Marker>& markers, const std::string& name) {
  for (const auto& marker : markers) {
    if (marker.ns == "system/" + name) {
      return marker;
    }
  }
  throw std::out_of_range("no marker " + name);
}

}  // namespace whirl_twin
