// One alert of the monitor; fields as in whirl_twin/Alert.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "messages/fields.h"

namespace whirl_twin::state {

enum class Severity : std::uint8_t { kInfo = 0, kWarning = 1, kDanger = 2 };

struct Alert {
  static constexpr MessageKind kKind{"alerts", "AlertArray", "alerts",
                                     MessageKind::kJudged | MessageKind::kLatched};

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::uint32_t id = 0;  ///< increasing; constant from raised to cleared
  std::string type;      ///< CRITICAL_SPEED_APPROACH, IN_CRITICAL_BAND, UNSTABLE, ...
  std::string system;
  Severity severity = Severity::kInfo;
  bool raised = true;                         ///< in the active list
  double raised_time = 0.0;                   ///< [s], simulated
  double time = 0.0;                          ///< [s], simulated
  std::int64_t stamp = 0;                     ///< [ns], of the state evaluated last
  double speed = kNone;                       ///< [rad/s]
  double acceleration = kNone;                ///< [rad/s^2]
  double critical_speed = kNone;              ///< [rad/s]
  double time_to_entry = kNone;               ///< [s]
  double separation_margin = kNone;           ///< [percent]
  double required_separation_margin = kNone;  ///< [percent]
  double amplification_factor = kNone;        ///< [-]
  double decay_rate = kNone;                  ///< [1/s]
  std::string text;                           ///< one sentence for a person
  bool acknowledged = false;                  ///< acknowledged by an operator
  bool latched = false;            ///< its cause has vanished, and it waits for a reset of the
                                   ///< alarms
  bool first_out = false;          ///< no alert of its system was active when it was raised
  std::uint32_t repeats = 0;       ///< number of earlier occurrences since the last reset
  double amplitude = kNone;        ///< [m], whirl radius, or the quantity that the text names
  double amplitude_limit = kNone;  ///< [m], that it is above

  template <class Visit>
  static void fields(Visit& visit) {
    visit.stamped();
    visit(TWIN_FIELD(id), "");  // LCM has no unsigned numbers: the same 32 bits
    visit(TWIN_FIELD(type), "", requireName);
    visit(TWIN_FIELD(system), "", requireName);
    visit(TWIN_FIELD(severity), "", between(0, 2));
    visit.negated(TWIN_RENAMED_FIELD(state, raised));  // 0: raised
    visit(TWIN_FIELD(raised_time), "s", requireTime);
    visit(TWIN_FIELD(time), "s", requireTime);
    visit(TWIN_FIELD(speed), "rad/s");
    visit(TWIN_FIELD(acceleration), "rad/s^2");
    visit(TWIN_FIELD(critical_speed), "rad/s");
    visit(TWIN_FIELD(time_to_entry), "s");
    visit.numbers("percent", TWIN_FIELD(separation_margin), TWIN_FIELD(required_separation_margin));
    visit(TWIN_FIELD(amplification_factor), "-");
    visit(TWIN_FIELD(decay_rate), "1/s");
    visit(TWIN_FIELD(text), "", requireText);
    visit(TWIN_FIELD(acknowledged), "", requireFlag);
    visit(TWIN_FIELD(latched), "", requireFlag);
    visit(TWIN_FIELD(first_out), "", requireFlag);
    visit(TWIN_FIELD(repeats), "");
    visit.numbers("m", TWIN_FIELD(amplitude), TWIN_FIELD(amplitude_limit));
  }
};

}  // namespace whirl_twin::state

namespace whirl_twin::alert_type {

// The types of alert that the monitor raises, spelled as in whirl_twin/Alert.

inline constexpr char kCriticalSpeedApproach[] = "CRITICAL_SPEED_APPROACH";
inline constexpr char kInCriticalBand[] = "IN_CRITICAL_BAND";
inline constexpr char kSommerfeldCapture[] = "SOMMERFELD_CAPTURE";
inline constexpr char kWhirlAmplitude[] = "WHIRL_AMPLITUDE";
inline constexpr char kVotedAmplitude[] = "VOTED_AMPLITUDE";
inline constexpr char kVibrationZone[] = "VIBRATION_ZONE";
inline constexpr char kSubsynchronousWhirl[] = "SUBSYNCHRONOUS_WHIRL";
inline constexpr char kRub[] = "RUB";
inline constexpr char kUnstable[] = "UNSTABLE";
inline constexpr char kLowDamping[] = "LOW_DAMPING";
inline constexpr char kRouthDisagrees[] = "ROUTH_DISAGREES";
inline constexpr char kUnstableWithinSpread[] = "UNSTABLE_WITHIN_SPREAD";
inline constexpr char kModelMismatch[] = "MODEL_MISMATCH";
inline constexpr char kDrift[] = "DRIFT";
inline constexpr char kSensor[] = "SENSOR";
inline constexpr char kEnergyResidual[] = "ENERGY_RESIDUAL";
inline constexpr char kAccuracyLost[] = "ACCURACY_LOST";
inline constexpr char kNotFinite[] = "NOT_FINITE";
inline constexpr char kStopped[] = "STOPPED";  // for any other cause
inline constexpr char kModelInvalid[] = "MODEL_INVALID";
inline constexpr char kControllerLost[] = "CONTROLLER_LOST";
inline constexpr char kLoopSensitivity[] = "LOOP_SENSITIVITY";
inline constexpr char kActuatorSaturated[] = "ACTUATOR_SATURATED";
inline constexpr char kResonanceNotPassed[] = "RESONANCE_NOT_PASSED";
inline constexpr char kDataLost[] = "DATA_LOST";
inline constexpr char kLcmLost[] = "LCM_LOST";
inline constexpr char kDuplicateTwin[] = "DUPLICATE_TWIN";
inline constexpr char kInhibited[] = "INHIBITED";
inline constexpr char kTripMultiplied[] = "TRIP_MULTIPLIED";

inline constexpr const char* kAll[] = {kCriticalSpeedApproach,
                                       kInCriticalBand,
                                       kSommerfeldCapture,
                                       kWhirlAmplitude,
                                       kVotedAmplitude,
                                       kVibrationZone,
                                       kSubsynchronousWhirl,
                                       kRub,
                                       kUnstable,
                                       kLowDamping,
                                       kRouthDisagrees,
                                       kUnstableWithinSpread,
                                       kModelMismatch,
                                       kDrift,
                                       kSensor,
                                       kEnergyResidual,
                                       kAccuracyLost,
                                       kNotFinite,
                                       kStopped,
                                       kModelInvalid,
                                       kControllerLost,
                                       kLoopSensitivity,
                                       kActuatorSaturated,
                                       kResonanceNotPassed,
                                       kDataLost,
                                       kLcmLost,
                                       kDuplicateTwin,
                                       kInhibited,
                                       kTripMultiplied};

/// The system of an alert about the whole twin.
inline constexpr char kEverybody[] = "twin";

}  // namespace whirl_twin::alert_type
