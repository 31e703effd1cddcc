// Anti-windup of an integrator while its output is saturated: the saturation residual feeds back to
// the integral with a tracking time (back-calculation), or the integral is frozen while it drives
// the output further into saturation (clamping).
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "controllers/controller_info.h"

namespace whirl_twin {

struct AntiWindup {
  enum class Way { kBackCalculation, kClamping, kNone };
  Way way = Way::kBackCalculation;
  double tracking_time = 0.0;  ///< [s]; 0: kp / ki
  double period = 0.0;         ///< [s], sampling period; lower limit of the tracking time

  /// Integrand for an error e: ki e, less the back-calculation term of the saturation residual of
  /// an output u. Real-time safe.
  double integrand(double kp, double ki, double e, double u, double cut) const noexcept {
    if (ki == 0.0) {
      return 0.0;
    }
    const double beyond = u - cut;
    const double wanted = ki * e;
    switch (way) {
      case Way::kBackCalculation: {
        const double time = tracking_time > 0.0 ? tracking_time : std::abs(kp / ki);
        return wanted - beyond / std::max(time, period);
      }
      case Way::kClamping:
        return beyond * wanted > 0.0 ? 0.0 : wanted;
      case Way::kNone:
        break;
    }
    return wanted;
  }
};

/// `anti_windup` and `tracking_time`, as a scene gives them.
inline AntiWindup antiWindupOf(const ParameterValues& values, const Settings& settings,
                               double rate) {
  const std::string& way = settings.choices.at("anti_windup");
  return {way == "clamping" ? AntiWindup::Way::kClamping
          : way == "none"   ? AntiWindup::Way::kNone
                            : AntiWindup::Way::kBackCalculation,
          values.at("tracking_time"), 1.0 / rate};
}

inline ParameterInfo trackingTimeInfo() {
  return {"tracking_time",
          "s",
          Range::kNotNegative,
          "time constant of back_calculation; 0: kp/ki",
          0.0,
          ""};
}

inline SettingInfo antiWindupSetting() {
  SettingInfo info{"anti_windup", SettingKind::kChoice, "",
                   "anti-windup of the integral while the output is at its limit"};
  info.choices = {"back_calculation", "clamping", "none"};
  return info;
}

}  // namespace whirl_twin
