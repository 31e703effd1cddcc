#include "scene/drive_profile.h"

#include "control/exclusion_bands.h"

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

}  // namespace whirl_twin
