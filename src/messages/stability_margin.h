// The monitor's evaluation of one system at one instant: the verdict, its distance from
// instability, and the critical speeds next to the present speed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "messages/states.h"

namespace whirl_twin::state {

/// A critical speed relative to the present running speed (API 617/684).
struct CriticalSpeedMargin {
  double speed = 0.0;                       ///< [rad/s], of the peak unbalance response
  std::string direction;                    ///< "forward" or "backward"
  double amplification_factor = 0.0;        ///< [-], Nc / (N2 - N1); NaN: undefined, below 1
  double separation_margin = 0.0;           ///< [percent]; NaN at standstill
  double required_separation_margin = 0.0;  ///< [percent]
  double band_low = 0.0;                    ///< [rad/s], lower end of the speeds to avoid
  double band_high = 0.0;                   ///< [rad/s], upper end

  template <class Visit>
  static void fields(Visit& visit) {
    visit(TWIN_RENAMED_FIELD(critical_speed, speed), "rad/s");
    visit(TWIN_FIELD(direction), "", requireDirection);
    visit(TWIN_FIELD(amplification_factor), "-");
    visit.numbers("percent", TWIN_FIELD(separation_margin), TWIN_FIELD(required_separation_margin));
    visit.numbers("rad/s", TWIN_FIELD(band_low), TWIN_FIELD(band_high));
  }
};

/// The complete result; fields as in whirl_twin/StabilityMargin.
struct StabilityMargin {
  static constexpr MessageKind kKind{"stability", "StabilityMargin", "*/stability",
                                     MessageKind::kJudged};

  Instant at;
  std::string system;
  std::string model;
  std::uint8_t verdict = 0;  ///< as in the message: 0 asymptotically_stable ... 4 uncertain
  std::string verdict_name;
  std::vector<std::string> coordinate;
  std::vector<double> operating_point;
  double speed = 0.0;  ///< [rad/s]; NaN without a shaft
  std::vector<double> polynomial;
  std::vector<double> first_column;
  std::uint32_t right = 0;
  std::uint32_t imaginary = 0;
  std::uint32_t left = 0;
  double decay_rate = 0.0;         ///< [1/s]
  double damping_ratio = 0.0;      ///< [-]
  double log_decrement = 0.0;      ///< [-]; NaN when overdamped
  double instability_speed = 0.0;  ///< [rad/s]; NaN: none found
  std::vector<CriticalSpeedMargin> critical_speeds;
  // Speeds at which the verdict changes, starting from the present speed; NaN: none.
  double threshold_below = std::numeric_limits<double>::quiet_NaN();  ///< [rad/s], nearest below
  double threshold_above = std::numeric_limits<double>::quiet_NaN();  ///< [rad/s], nearest above
  double age = std::numeric_limits<double>::quiet_NaN();  ///< [s], wall time; NaN: unknown
  // The critical parameter: the one whose change alone leads to instability with the smallest
  // relative change; "": none within ten times its value, or the system is unstable now.
  std::string nearest_parameter;
  double nearest_change = std::numeric_limits<double>::quiet_NaN();  ///< [-], relative to its value
  double nearest_value = std::numeric_limits<double>::quiet_NaN();   ///< where it is lost
  std::string nearest_loss;  ///< divergence, whirl, flutter, no_motion
  double nearest_frequency = std::numeric_limits<double>::quiet_NaN();      ///< [rad/s]
  double nearest_time = std::numeric_limits<double>::quiet_NaN();           ///< [s], simulated
  double cross_coupling_margin = std::numeric_limits<double>::quiet_NaN();  ///< [N/m]
  // Cross-check of Routh's test by the eigenvalues.
  std::uint32_t right_by_eigenvalues = 0;
  bool routh_disagrees = false;  ///< by more than rounding
  // Of a system whose scene specifies parameter tolerances (`spread` without a count).
  std::uint32_t members = 0;         ///< samples drawn within the tolerances and evaluated; 0: none
  std::uint32_t members_beyond = 0;  ///< samples that decay more slowly than the setting, or grow
  double lowest_decay_rate = std::numeric_limits<double>::quiet_NaN();  ///< [1/s], found within it
  bool stable_throughout = false;  ///< by Kharitonov's theorem; false: not proven
  // Amplitude up to which log_decrement is within a tenth of that of the linearized motion.
  std::string log_decrement_coordinate;  ///< its coordinate; "whirl": a rotor's radius; "": unknown
  double log_decrement_amplitude =
      std::numeric_limits<double>::quiet_NaN();  ///< [rad] or [m]; infinite: stable in the whole
                                                 ///< range searched
  // Of a reduced-order rotor: results of the full-order model. NaN: of any other system.
  double unreduced_decay_rate = std::numeric_limits<double>::quiet_NaN();     ///< [1/s]
  double unreduced_log_decrement = std::numeric_limits<double>::quiet_NaN();  ///< [-]
  bool reduction_disagrees = false;  ///< one of them grows and the other does not
  // Not transmitted: for the texts of alerts.
  enum class About { kEquilibrium, kPeriodicMotion, kMeanLoads };
  About judged_about = About::kEquilibrium;

  template <class Visit>
  static void fields(Visit& visit) {
    // A polynomial has one coefficient more than roots. Multipliers of a periodic motion, and the
    // roots of many coordinates, have no polynomial: two per coordinate.
    const auto roots = [](const char* name, std::int64_t value, const auto& message) {
      requireRange(name, value, 0,
                   static_cast<std::int64_t>(
                       std::max(message.polynomial.size(), 2 * message.operating_point.size())));
    };
    visit.head(TWIN_FIELD(system));
    visit(TWIN_FIELD(model), "", requireName, Stays::kSame);
    visit(TWIN_FIELD(verdict), "", between(0, 4));
    visit(TWIN_FIELD(verdict_name), "", requireName);
    visit.array(TWIN_FIELD(coordinates), TWIN_FIELD(coordinate), "", each(requireName),
                Stays::kSame);
    visit.along(TWIN_FIELD(coordinate), TWIN_FIELD(operating_point), "rad or m");
    visit(TWIN_FIELD(speed), "rad/s");
    visit.array(TWIN_FIELD(coefficients), TWIN_FIELD(polynomial), "");
    visit.array(TWIN_FIELD(rows), TWIN_FIELD(first_column), "");
    visit(TWIN_FIELD(right), "", roots);
    visit(TWIN_FIELD(imaginary), "", roots);
    visit(TWIN_FIELD(left), "", roots);
    visit(TWIN_FIELD(decay_rate), "1/s");
    visit.numbers("-", TWIN_FIELD(damping_ratio), TWIN_FIELD(log_decrement));
    visit(TWIN_FIELD(instability_speed), "rad/s");
    // NaN and false are redundant: none was found.
    visit.derived(TWIN_FIELD(instability_speed_valid),
                  [](const auto& message) { return !std::isnan(message.instability_speed); });
    visit.rows(TWIN_FIELD(critical_speeds), TWIN_FIELD(critical_speeds));
    visit.numbers("rad/s", TWIN_FIELD(threshold_below), TWIN_FIELD(threshold_above));
    visit(TWIN_FIELD(age), "s");
    visit(TWIN_FIELD(nearest_parameter), "", requireText);
    visit(TWIN_FIELD(nearest_change), "-");
    visit(TWIN_FIELD(nearest_value), "");
    visit(TWIN_FIELD(nearest_loss), "", requireText);
    visit(TWIN_FIELD(nearest_frequency), "rad/s");
    visit(TWIN_FIELD(nearest_time), "s");
    visit(TWIN_FIELD(cross_coupling_margin), "N/m");
    visit(TWIN_FIELD(right_by_eigenvalues), "", roots);
    visit(TWIN_FIELD(routh_disagrees), "", requireFlag);
    visit(TWIN_FIELD(members), "");
    visit(TWIN_FIELD(members_beyond), "",
          [](const char* name, std::int64_t value, const auto& message) {
            requireRange(name, value, 0, static_cast<std::int64_t>(message.members));
          });
    visit(TWIN_FIELD(lowest_decay_rate), "1/s");
    visit(TWIN_FIELD(stable_throughout), "", requireFlag);
    visit(TWIN_FIELD(log_decrement_coordinate), "", requireText);
    visit(TWIN_FIELD(log_decrement_amplitude), "");
    visit(TWIN_FIELD(unreduced_decay_rate), "1/s");
    visit(TWIN_FIELD(unreduced_log_decrement), "-");
    visit(TWIN_FIELD(reduction_disagrees), "", requireFlag);
  }
};

}  // namespace whirl_twin::state
