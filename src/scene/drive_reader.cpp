#include "scene/drive_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "control/drive.h"
#include "control/exclusion_bands.h"
#include "control/motor.h"
#include "control/speed_profile.h"
#include "messages/input_error.h"

namespace whirl_twin {

std::vector<double> changeDurations(const DriveSpec& drive) {
  const ExclusionBands avoid(drive.avoid);
  std::vector<double> durations;
  double speed = drive.speed;
  for (const SpeedMove& move : drive.profile) {
    durations.push_back(avoid.plan(speed, 0.0, move).duration);
    speed = move.speed;
  }
  return durations;
}

double profileDuration(const DriveSpec& drive) {
  double total = 0.0;
  for (const double change : changeDurations(drive)) {
    total += change;
  }
  for (const SpeedMove& move : drive.profile) {
    total += move.dwell;
  }
  return total;
}

namespace {

std::vector<SpeedMove> readProfile(const YAML::Node& list, const std::string& key,
                                   Diagnostics& diagnostics) {
  std::vector<SpeedMove> profile;
  if (!list.IsSequence()) {
    diagnostics.add(key, fmt::format("must be a list of moves, found {}", shown(list)));
    return profile;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const MapReader move(list[i], fmt::format("{}[{}]", key, i),
                         {"speed", "max_acceleration", "max_jerk", "dwell"}, "key of a move",
                         diagnostics);
    SpeedMove m;
    m.speed = move.numberBetween("speed", -kMaxSpeed, kMaxSpeed, "rad/s", std::nullopt);
    m.max_acceleration = move.number("max_acceleration", Range::kPositive, "rad/s^2", std::nullopt);
    m.max_jerk = move.has("max_jerk")
                     ? move.number("max_jerk", Range::kPositive, "rad/s^3", std::nullopt)
                     : 0.0;
    m.dwell = move.numberBetween("dwell", 0.0, kMaxDuration, "s", 0.0);
    profile.push_back(m);
  }
  return profile;
}

std::vector<MotorPoint> readMotorTable(const YAML::Node& list, const std::string& key,
                                       Diagnostics& diagnostics) {
  std::vector<MotorPoint> table;
  if (!list.IsSequence() || list.size() < 2 || list.size() > Motor::kMaxPoints) {
    diagnostics.add(
        key, fmt::format("must be a list of 2 to {} maps of speed and torque, found {}",
                         Motor::kMaxPoints,
                         list.IsSequence() ? fmt::format("{} maps", list.size()) : shown(list)));
    return table;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const MapReader row(list[i], fmt::format("{}[{}]", key, i), {"speed", "torque"},
                        "key of a motor's table", diagnostics);
    MotorPoint point;
    point.speed = row.numberBetween("speed", -kMaxSpeed, kMaxSpeed, "rad/s", std::nullopt);
    point.torque = row.number("torque", Range::kAny, "N m", std::nullopt);
    if (row.usable() && !table.empty() && !(point.speed > table.back().speed)) {
      diagnostics.add(row.key("speed"),
                      fmt::format("must be greater than the one before, {} rad/s, "
                                  "found {}",
                                  table.back().speed, point.speed));
    }
    table.push_back(point);
  }
  return table;
}

Motor readMotor(const YAML::Node& node, const std::string& key, Diagnostics& diagnostics) {
  const MapReader map(node, key, {"torque", "stall_torque", "no_load_speed", "table", "drag"},
                      "key of a motor", diagnostics);
  Motor motor;
  if (!map.usable()) {
    return motor;
  }
  const bool falls = map.has("stall_torque") || map.has("no_load_speed");
  if (map.has("torque") + falls + map.has("table") != 1) {
    diagnostics.add(key,
                    "must be one of {torque}, {stall_torque, no_load_speed} and {table}, with a "
                    "drag or without");
  }
  if (map.has("torque")) {
    motor = Motor::constant(map.number("torque", Range::kAny, "N m", std::nullopt));
  }
  if (falls) {
    const double stall = map.number("stall_torque", Range::kPositive, "N m", std::nullopt);
    motor =
        Motor::falling(stall, map.number("no_load_speed", Range::kPositive, "rad/s", std::nullopt));
  }
  if (map.has("table")) {
    const auto table = readMotorTable(map.at("table"), map.key("table"), diagnostics);
    std::copy(table.begin(), table.end(), motor.points.begin());
    motor.count = table.size();
  }
  motor.drag = map.number("drag", Range::kNotNegative, "N m s/rad", 0.0);
  return motor;
}

}  // namespace

DriveSpec readDrive(const YAML::Node& node, const std::string& key, const std::string& name,
                    std::int64_t start, Diagnostics& diagnostics) {
  DriveSpec drive;
  drive.name = name;
  const MapReader map(node, key, {"speed", "angle", "profile", "motor", "avoid"}, "key of a drive",
                      diagnostics);
  if (!map.usable()) {
    return drive;
  }
  const std::size_t before = diagnostics.all().size();
  drive.speed = map.numberBetween("speed", -kMaxSpeed, kMaxSpeed, "rad/s", 0.0);
  drive.angle = map.numberBetween("angle", -1.0e15, 1.0e15, "rad", 0.0);
  if (map.has("motor")) {
    drive.motor = readMotor(map.at("motor"), map.key("motor"), diagnostics);
    if (map.has("profile")) {
      diagnostics.add(map.key("profile"),
                      "a motor's speed is not prescribed: give a motor or a profile, not both");
    }
  }
  if (map.has("profile")) {
    drive.profile = readProfile(map.at("profile"), map.key("profile"), diagnostics);
  }
  if (diagnostics.all().size() == before) {
    try {  // errors of the profile as a whole, such as durations out of range
      static_cast<void>(Drive(drive.speed, drive.angle, drive.profile, start));
    } catch (const InputError& error) {
      diagnostics.add(key, error.what());
    }
  }
  return drive;
}

}  // namespace whirl_twin
