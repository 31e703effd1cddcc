#include "scene/part_of_scene.h"

#include <algorithm>

namespace whirl_twin {

namespace {

/// Renumbers a system; false if it is not among them.
template <class OfSystem>
bool move(OfSystem& of, const std::vector<std::size_t>& systems) {
  const auto found = std::find(systems.begin(), systems.end(), of.system);
  of.system = static_cast<std::size_t>(found - systems.begin());
  return found != systems.end();
}

template <class OfSystems>
bool moveAll(OfSystems& all, const std::vector<std::size_t>& systems) {
  return std::all_of(all.begin(), all.end(), [&](auto& of) { return move(of, systems); });
}

}  // namespace

Scene partOf(const Scene& scene, const std::vector<std::size_t>& systems) {
  Scene part = scene;
  part.systems.clear();
  for (const std::size_t i : systems) {
    part.systems.push_back(scene.systems[i]);
  }
  part.controllers.clear();
  for (ControllerSpec controller : scene.controllers) {
    if (moveAll(controller.measures, systems) && moveAll(controller.acts_on, systems)) {
      part.controllers.push_back(std::move(controller));
    }
  }
  part.sensors.clear();
  for (SensorSpec sensor : scene.sensors) {
    if (std::all_of(sensor.channels.begin(), sensor.channels.end(),
                    [&](SensorChannelSpec& channel) { return move(channel.signal, systems); })) {
      part.sensors.push_back(std::move(sensor));
    }
  }
  return part;
}

}  // namespace whirl_twin
