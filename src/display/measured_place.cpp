#include "display/measured_place.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "messages/units.h"

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
      for (const CoordinateInfo& coordinate : built.dynamics->coordinates()) {
        place.channel_.emplace_back();
        place.unit_.push_back(coordinate.unit);
      }
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
  std::vector<double> scale;
  for (std::size_t i = 0; i < channel_.size(); ++i) {
    const auto found = std::find(block.channel.begin(), block.channel.end(), channel_[i]);
    const auto c = static_cast<std::size_t>(found - block.channel.begin());
    if (c >= std::min(block.channel.size(), block.unit.size())) {
      return {};
    }
    column.push_back(c);
    scale.push_back(unitScale(block.unit[c], unit_[i]));
    if (scale.back() == 0.0) {
      return {};
    }
  }
  const std::size_t width = block.channel.size();
  const std::size_t values = std::min(block.value.size(), block.valid.size());
  for (std::size_t end = values - values % width; end > 0; end -= width) {
    std::vector<double> place;
    for (std::size_t i = 0; i < column.size(); ++i) {
      const std::size_t at = end - width + column[i];
      if (block.valid[at] && std::isfinite(block.value[at])) {
        place.push_back(scale[i] * block.value[at]);
      }
    }
    if (place.size() == column.size()) {
      return place;
    }
  }
  return {};
}

}  // namespace whirl_twin
