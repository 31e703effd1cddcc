#include "reports/shown_units.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"

namespace whirl_twin {

namespace {

std::string trimmedUnit(const std::string& text) {
  constexpr const char* kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(kBlank) + 1 - begin);
}

/// A semi-axis is the peak of the vibration; other measures of it, in semi-axes.
struct VibrationMeasure {
  const char* suffix;
  double of_peak;
};
const VibrationMeasure kVibrationMeasures[] = {
    {" pp", 2.0}, {" pk", 1.0}, {" rms", std::sqrt(0.5)}};

/// "mil pp" of vibrations; false if it has no such suffix.
bool takeMeasure(const std::string& text, ShownUnits& units) {
  for (const VibrationMeasure& measure : kVibrationMeasures) {
    const std::string suffix = measure.suffix;
    if (text.size() <= suffix.size() ||
        text.compare(text.size() - suffix.size(), suffix.size(), suffix) != 0) {
      continue;
    }
    const std::string unit = trimmedUnit(text.substr(0, text.size() - suffix.size()));
    const double size = isUnit(unit) ? unitScale(unit, "m") : 0.0;
    if (size == 0.0) {
      return false;
    }
    units.vibration = {unit + suffix, size / measure.of_peak};
    return true;
  }
  return false;
}

std::filesystem::path fileOfUser() {
  const char* const folder = std::getenv("XDG_CONFIG_HOME");
  if (folder != nullptr && *folder != '\0') {
    return std::filesystem::path(folder) / "whirl_twin/units";
  }
  const char* const home = std::getenv("HOME");
  return home == nullptr ? std::filesystem::path()
                         : std::filesystem::path(home) / ".config/whirl_twin/units";
}

}  // namespace

std::string ShownUnit::shortText(double si) const {
  return size == kRpm ? fmt::format("{:.0f} {}", in(si), name)
                      : fmt::format("{:.4g} {}", in(si), name);
}

ShownUnit ShownUnit::beside() const {
  return size == 1.0 ? ShownUnit{"rpm", kRpm} : ShownUnit{"rad/s"};
}

std::string ShownUnits::speedText(double of) const {
  return fmt::format("{}, {}", speed.shortText(of), besideSpeed().shortText(of));
}

ShownUnit ShownUnits::besideSpeed() const {
  return speed.beside();
}
ShownUnit ShownUnits::besideFrequency() const {
  return frequency.size == 1.0 ? ShownUnit{"Hz", kTwoPi} : ShownUnit{"rad/s"};
}

ShownUnits shownUnits(const std::string& list, const std::string& source) {
  ShownUnits units;
  bool has_speed = false, has_vibration = false;
  std::istringstream entries(list);
  for (std::string entry; std::getline(entries, entry, ',');) {
    const std::string unit = trimmedUnit(entry);
    if (takeMeasure(unit, units)) {
      has_vibration = true;
      continue;
    }
    const auto size = [&](const char* si) { return isUnit(unit) ? unitScale(unit, si) : 0.0; };
    if (const double speed = size("rad/s"); speed != 0.0) {
      (has_speed ? units.frequency : units.speed) = {unit, speed};
      if (!has_speed) {
        units.frequency = units.speed;
      }
      has_speed = true;
    } else if (const double length = size("m"); length != 0.0) {
      units.length = {unit, length};
      if (!has_vibration) {
        units.vibration = units.length;
      }
    } else if (const double angle = size("rad"); angle != 0.0) {
      units.angle = {unit, angle};
    } else if (const double stiffness = size("N/m"); stiffness != 0.0) {
      units.stiffness = {unit, stiffness};
    } else {
      throw InputError(fmt::format(
          "{}: must be a list of units of angular speed (shaft, frequency), length (also pp, pk or "
          "rms, of vibrations), angle or stiffness, such as \"rpm, mil pp, deg\"; found {}",
          source, inQuotes(unit)));
    }
  }
  return units;
}

ShownUnits chosenUnits(const std::optional<std::string>& option) {
  if (option) {
    return shownUnits(*option, "--units");
  }
  const std::filesystem::path path = fileOfUser();
  std::error_code error;
  if (path.empty() || !std::filesystem::is_regular_file(path, error)) {
    return {};
  }
  std::ifstream file(path);
  std::string list;
  for (std::string line; std::getline(file, line);) {
    const std::string part = trimmedUnit(line.substr(0, line.find('#')));
    list += part.empty() ? "" : (list.empty() ? "" : ",") + part;
  }
  return shownUnits(list, path.string());
}

}  // namespace whirl_twin
