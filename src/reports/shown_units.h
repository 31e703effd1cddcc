// Units of the numbers in the text and the figures of a report, by choice of the user. JSON and CSV
// are in SI units.
#pragma once

#include <optional>
#include <string>

#include "algebra/constants.h"

namespace whirl_twin {

struct ShownUnit {
  std::string name;
  double size = 1.0;  ///< in the SI

  double in(double si) const { return si / size; }
  /// Of an axis: "shaft speed (rpm)".
  std::string label(const std::string& quantity) const { return quantity + " (" + name + ")"; }
  /// "83.2 rad/s", "794 rpm": as a figure has it.
  std::string shortText(double si) const;
  /// Of an angular speed, beside it: rpm, or rad/s if rpm or another one is shown already.
  ShownUnit beside() const;
};

struct ShownUnits {
  ShownUnit speed{"rad/s"};      ///< of a shaft
  ShownUnit frequency{"rad/s"};  ///< of a whirl
  ShownUnit vibration{"m"};      ///< amplitude of an orbit: semi-axis, or peak to peak
  ShownUnit length{"m"};
  ShownUnit stiffness{"N/m"};
  ShownUnit angle{"deg", kDegree};

  /// For a column beside the speed or the frequency: rpm or Hz, or rad/s if another one than rad/s
  /// is shown already.
  ShownUnit besideSpeed() const;
  ShownUnit besideFrequency() const;
  /// "83.2 rad/s, 794 rpm"
  std::string speedText(double speed) const;
};

/// Of a list: "rpm, mil pp, deg". The first unit of an angular speed is that of shafts, and of
/// frequencies unless there is a second one; a length with pp, pk or rms is that of vibrations
/// only. Throws InputError, beginning with `source`.
ShownUnits shownUnits(const std::string& list, const std::string& source);

/// By the option, or else by the file of the user, $XDG_CONFIG_HOME/whirl_twin/units or
/// ~/.config/whirl_twin/units: a list in one line or several, with comments behind #.
ShownUnits chosenUnits(const std::optional<std::string>& option);

}  // namespace whirl_twin
