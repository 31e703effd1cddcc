// The types of alert the monitor raises, as they stand in whirl_twin/Alert.
#pragma once

namespace whirl_twin::alert_type {

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

/// The system of an alert about all of the twin.
inline constexpr char kEverybody[] = "twin";

}  // namespace whirl_twin::alert_type
