#include "scene/drive_reader.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "control/drive.h"
#include "control/speed_profile.h"

namespace whirl_twin {

namespace {

std::vector<SpeedMove> readProfile(const YAML::Node& list, const std::string& key,
                                   Complaints& complaints) {
  std::vector<SpeedMove> profile;
  if (!list.IsSequence()) {
    complaints.add(key, fmt::format("must be a list of moves, found {}", shown(list)));
    return profile;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const MapReader move(list[i], fmt::format("{}[{}]", key, i),
                         {"speed", "max_acceleration", "max_jerk", "dwell"}, "key of a move",
                         complaints);
    SpeedMove m;
    m.speed = move.numberBetween("speed", -kLargestSpeed, kLargestSpeed, "rad/s", std::nullopt);
    m.max_acceleration = move.number("max_acceleration", Range::kPositive, "rad/s^2", std::nullopt);
    m.max_jerk = move.has("max_jerk")
                     ? move.number("max_jerk", Range::kPositive, "rad/s^3", std::nullopt)
                     : 0.0;
    m.dwell = move.numberBetween("dwell", 0.0, kLongestDuration, "s", 0.0);
    profile.push_back(m);
  }
  return profile;
}

}  // namespace

DriveSpec readDrive(const YAML::Node& node, const std::string& key, const std::string& name,
                    std::int64_t start, Complaints& complaints) {
  DriveSpec drive;
  drive.name = name;
  const MapReader map(node, key, {"speed", "angle", "profile", "motor"}, "key of a drive",
                      complaints);
  if (!map.usable()) {
    return drive;
  }
  const std::size_t before = complaints.all().size();
  drive.speed = map.numberBetween("speed", -kLargestSpeed, kLargestSpeed, "rad/s", 0.0);
  drive.angle = map.numberBetween("angle", -1.0e15, 1.0e15, "rad", 0.0);
  if (map.has("motor")) {
    complaints.add(map.key("motor"),
                   "motors are not modelled in this version; give the drive a profile");
  }
  if (map.has("profile")) {
    drive.profile = readProfile(map.at("profile"), map.key("profile"), complaints);
  }
  if (complaints.all().size() == before) {
    try {  // what only the whole profile shows, such as moves that last longer than can be timed
      static_cast<void>(Drive(drive.speed, drive.angle, drive.profile, start));
    } catch (const std::invalid_argument& error) {
      complaints.add(key, error.what());
    }
  }
  return drive;
}

}  // namespace whirl_twin
