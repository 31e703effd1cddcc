#include "reports/largest_sag.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl_twin {

std::optional<LargestSag> largestSag(const Dynamics& dynamics, const Eigen::VectorXd& q) {
  std::optional<LargestSag> largest;
  for (const Station& station : dynamics.stations()) {
    const LargestSag here{station.name, station.along_x.dot(q), station.along_y.dot(q)};
    const double size = std::hypot(here.x, here.y);
    if (size > (largest ? std::hypot(largest->x, largest->y) : 0.0)) {
      largest = here;
    }
  }
  return largest;
}

std::string text(const LargestSag& sag) {
  return fmt::format("{:.6g} m at {} (x {:.6g} m, y {:.6g} m)", std::hypot(sag.x, sag.y),
                     sag.station, sag.x + 0.0, sag.y + 0.0);
}

Json json(const std::optional<LargestSag>& sag) {
  return sag ? Json{{"station", sag->station},
                    {"deflection", std::hypot(sag->x, sag->y)},
                    {"x", sag->x + 0.0},
                    {"y", sag->y + 0.0}}
             : Json();
}

}  // namespace whirl_twin
