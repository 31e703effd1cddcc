#include "scene/station_names.h"

namespace whirl_twin {

std::string stationName(const std::string& system, const Station& station) {
  return system + "_" + station.name;
}

std::vector<std::string> publishedStations(const std::string& system, const Dynamics& dynamics) {
  std::vector<std::string> names{system};
  for (const Station& station : dynamics.stations()) {
    if (station.published) {
      names.push_back(stationName(system, station));
    }
  }
  return names;
}

}  // namespace whirl_twin
