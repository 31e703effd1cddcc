// Units of the numbers in the text of a report, by choice of the user. JSON, CSV and figures are in
// SI units.
#pragma once

#include <optional>
#include <string>

#include "algebra/constants.h"

namespace whirl_twin {

struct ShownUnit {
  std::string name;
  double size = 1.0;  ///< in the SI

  double in(double si) const { return si / size; }
};

struct ShownUnits {
  ShownUnit speed{"rad/s"};      ///< of a shaft
  ShownUnit frequency{"rad/s"};  ///< of a whirl
  ShownUnit vibration{"m"};      ///< amplitude of an orbit: semi-axis, or peak to peak
  ShownUnit length{"m"};
  ShownUnit stiffness{"N/m"};
  ShownUnit angle{"deg", kDegree};

  /// For a column beside the speed or the frequency: rpm or Hz, and rad/s if that is shown already.
  ShownUnit besideSpeed() const;
  ShownUnit besideFrequency() const;
};

/// Of a list: "rpm, mil pp, deg". The first unit of an angular speed is that of shafts, and of
/// frequencies unless there is a second one; a length with pp, pk or rms is that of vibrations
/// only. Throws InputError, beginning with `source`.
ShownUnits shownUnits(const std::string& list, const std::string& source);

/// By the option, or else by the file of the user, $XDG_CONFIG_HOME/whirl_twin/units or
/// ~/.config/whirl_twin/units: a list in one line or several, with comments behind #.
ShownUnits chosenUnits(const std::optional<std::string>& option);

}  // namespace whirl_twin
