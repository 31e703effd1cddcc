#include "display/measured_place.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace whirl_twin {

std::optional<MeasuredPlace> MeasuredPlace::of(const BuiltScene& scene, const std::string& system) {
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    const BuiltSystem& built = *scene.systems[i];
    if (built.spec.name != system || built.dynamics->isRotor()) {
      continue;
    }
    for (const SensorSpec& sensor : scene.scene.sensors) {
      MeasuredPlace place;
      place.source_ = sensor.name;
      place.channel_.resize(built.dynamics->coordinates().size());
      for (const SensorChannelSpec& channel : sensor.channels) {
        if (channel.signal.system == i && channel.signal.kind == SignalSpec::Kind::kCoordinate) {
          place.channel_[channel.signal.coordinate] = channel.name;
        }
      }
      if (std::none_of(place.channel_.begin(), place.channel_.end(),
                       [](const std::string& name) { return name.empty(); })) {
        return place;
      }
    }
  }
  return std::nullopt;
}

std::vector<double> MeasuredPlace::newest(const Measurement& block) const {
  std::vector<std::size_t> column;
  for (const std::string& name : channel_) {
    const auto found = std::find(block.channel.begin(), block.channel.end(), name);
    if (found == block.channel.end()) {
      return {};
    }
    column.push_back(static_cast<std::size_t>(found - block.channel.begin()));
  }
  const std::size_t width = block.channel.size();
  const std::size_t values = std::min(block.value.size(), block.valid.size());
  for (std::size_t end = values - values % width; end > 0; end -= width) {
    std::vector<double> place;
    for (const std::size_t c : column) {
      const std::size_t at = end - width + c;
      if (block.valid[at] && std::isfinite(block.value[at])) {
        place.push_back(block.value[at]);
      }
    }
    if (place.size() == column.size()) {
      return place;
    }
  }
  return {};
}

}  // namespace whirl_twin
