// State of a controller of the running twin.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "messages/fields.h"
#include "messages/states.h"

namespace whirl_twin::state {

// Distance of a control loop from instability, as the monitor evaluates it.

/// The smallest margins over all its sensors, all other loops closed. NaN: unknown, or not yet
/// computed.
struct ControllerMargins {
  static constexpr MessageKind kKind{"margins", "ControllerMargins", "controllers/*/margins",
                                     MessageKind::kJudged};
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  Instant at;
  std::string controller;
  std::uint8_t verdict = 4;  ///< of its loop, values as in StabilityMargin
  std::string verdict_name;
  std::string objection;            ///< why the loop cannot be evaluated; else ""
  double speed = kNone;             ///< [rad/s], shaft speed of the evaluation; NaN: no shaft
  double spectral_radius = kNone;   ///< [-], in `period`
  double period = kNone;            ///< [s], period after which the sampling pattern of its loop
                                    ///< repeats
  double sensitivity_peak = kNone;  ///< [-], max |S|; infinite: not stable
  double peak_frequency = kNone;    ///< [rad/s]
  std::string zone;                 ///< ISO 14839-3: A, B, C, D, unbounded; "": unknown
  double gain_margin = kNone;       ///< [-], maximum factor of the gain
  double gain_reduction = kNone;    ///< [-], minimum factor of the gain
  double phase_margin = kNone;      ///< [rad]
  double phase_crossover = kNone;   ///< [rad/s], where
  double delay_margin = kNone;      ///< [s], that the delay may grow by
  double saturated = kNone;  ///< [-], fraction of the last second's outputs that the actuators did
                             ///< not realize
  double missed = kNone;     ///< [-], fraction of its samples without a number
  // At each of its sensors.
  std::vector<std::string> signal;
  std::vector<double> signal_peak;       ///< [-], max |S|
  std::vector<double> signal_frequency;  ///< [rad/s], where
  double age = kNone;                    ///< [s], wall time from the state to the verdict

  template <class Visit>
  static void fields(Visit& visit) {
    const auto signal = TWIN_FIELD(signal);
    visit.head(TWIN_FIELD(controller));
    visit(TWIN_FIELD(verdict), "", between(0, 4));
    visit(TWIN_FIELD(verdict_name), "", requireName);
    visit(TWIN_FIELD(objection), "", requireText);
    visit(TWIN_FIELD(speed), "rad/s");
    visit(TWIN_FIELD(spectral_radius), "-");
    visit(TWIN_FIELD(period), "s");
    visit(TWIN_FIELD(sensitivity_peak), "-");
    visit(TWIN_FIELD(peak_frequency), "rad/s");
    visit(TWIN_FIELD(zone), "", requireText);
    visit.numbers("-", TWIN_FIELD(gain_margin), TWIN_FIELD(gain_reduction));
    visit(TWIN_FIELD(phase_margin), "rad");
    visit(TWIN_FIELD(phase_crossover), "rad/s");
    visit(TWIN_FIELD(delay_margin), "s");
    visit.numbers("-", TWIN_FIELD(saturated), TWIN_FIELD(missed));
    visit.array(TWIN_FIELD(signals), signal, "", kAnything, Stays::kSame);
    visit.along(signal, TWIN_FIELD(signal_peak), "-");
    visit.along(signal, TWIN_FIELD(signal_frequency), "rad/s");
    visit(TWIN_FIELD(age), "s");
  }
};

/// State of a speed controller's response to resonance capture of its shaft.
enum class Supervision : std::uint8_t {
  kNone = 0,         ///< nothing holds it
  kRetreating = 1,   ///< captured: unloaded, returns below the band
  kTryingAgain = 2,  ///< in the band, or on its way
  kGivenUp = 3,      ///< aborted after the maximum number of tries: stays below
  kRefused = 4,      ///< known in advance to be impossible: stays below
};

struct ControllerState {
  static constexpr MessageKind kKind{"controller", "ControllerState", "controllers/*",
                                     MessageKind::kSeries};

  Instant at;
  std::string controller;
  std::vector<std::string> signal;       ///< "rotor.x"
  std::vector<std::string> signal_unit;  ///< "m", "rad", "m/s", "rad/s"
  std::vector<double> value;             ///< the sensor values at the last sample
  std::vector<std::string> input;        ///< "rotor.force_x"
  std::vector<std::string> input_unit;
  std::vector<double> output;  ///< as it acts
  std::int64_t samples = 0;    ///< since the start
  std::int64_t saturated = 0;  ///< outputs limited by an actuator
  std::int64_t missed = 0;     ///< samples without a finite output
  std::int64_t age = -1;       ///< [samples], age of the newest output of a controller in another
                               ///< process; -1: none
  bool lost = false;           ///< its time-out has expired without an answer
  Supervision supervision = Supervision::kNone;

  template <class Visit>
  static void fields(Visit& visit) {
    const auto count = between(0, std::numeric_limits<std::int64_t>::max());
    const auto signal = TWIN_FIELD(signal);
    visit.head(TWIN_FIELD(controller));
    visit.array(TWIN_FIELD(signals), signal, "", kAnything, Stays::kSame);
    visit.along(signal, TWIN_FIELD(signal_unit), "");
    visit.along(signal, TWIN_FIELD(value), "");
    const auto input = TWIN_FIELD(input);
    visit.array(TWIN_FIELD(inputs), input, "", kAnything, Stays::kSame);
    visit.along(input, TWIN_FIELD(input_unit), "");
    visit.along(input, TWIN_FIELD(output), "");
    visit(TWIN_FIELD(samples), "", count);
    visit(TWIN_FIELD(saturated), "", count);
    visit(TWIN_FIELD(missed), "", count);
    visit(TWIN_FIELD(age), "", between(-1, std::numeric_limits<std::int64_t>::max()));
    visit(TWIN_FIELD(lost), "", requireFlag);
    visit(TWIN_FIELD(supervision), "", between(0, 4));
  }
};

}  // namespace whirl_twin::state
