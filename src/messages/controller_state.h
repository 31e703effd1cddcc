// A controller of the twin as it runs.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "messages/fields.h"
#include "messages/states.h"

namespace whirl_twin::state {

// How far the loop of a controller is from instability, as the monitor judges it.

/// The least margins of all its sensors, all other loops closed. NaN: not known, or not yet.
struct ControllerMargins {
  static constexpr MessageKind kKind{"margins", "ControllerMargins", "controllers/*/margins",
                                     MessageKind::kJudged};
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  Instant at;
  std::string controller;
  std::uint8_t verdict = 4;  ///< on its loop, as StabilityMargin's
  std::string verdict_name;
  std::string objection;            ///< why the loop cannot be judged; else ""
  double speed = kNone;             ///< [rad/s], of the shaft that it is judged at; NaN: no shaft
  double spectral_radius = kNone;   ///< [-], in `period`
  double period = kNone;            ///< [s], after which the samples of its loop come again
  double sensitivity_peak = kNone;  ///< [-], max |S|; infinite: not stable
  double peak_frequency = kNone;    ///< [rad/s]
  std::string zone;                 ///< ISO 14839-3: A, B, C, D, unbounded; "": not known
  double gain_margin = kNone;       ///< [-], the gain may rise to less than so many times
  double gain_reduction = kNone;    ///< [-], and fall to more than this part
  double phase_margin = kNone;      ///< [rad]
  double phase_crossover = kNone;   ///< [rad/s], where
  double delay_margin = kNone;      ///< [s], that the delay may grow by
  double saturated =
      kNone;              ///< [-], part of the last second's outputs that were not given as asked
  double missed = kNone;  ///< [-], part of its samples that gave no number
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

/// What a speed controller does about a resonance that holds its shaft.
enum class Supervision : std::uint8_t {
  kNone = 0,         ///< nothing holds it
  kRetreating = 1,   ///< captured: it is unloaded and goes back below the band
  kTryingAgain = 2,  ///< in the band, or on its way
  kGivenUp = 3,      ///< after its tries it stays below
  kRefused = 4,      ///< known beforehand: it stays below
};

struct ControllerState {
  static constexpr MessageKind kKind{"controller", "ControllerState", "controllers/*",
                                     MessageKind::kSeries};

  Instant at;
  std::string controller;
  std::vector<std::string> signal;       ///< "rotor.x"
  std::vector<std::string> signal_unit;  ///< "m", "rad", "m/s", "rad/s"
  std::vector<double> value;             ///< as the sensors showed it at the last sample
  std::vector<std::string> input;        ///< "rotor.force_x"
  std::vector<std::string> input_unit;
  std::vector<double> output;  ///< as it acts
  std::int64_t samples = 0;    ///< since the start
  std::int64_t saturated = 0;  ///< outputs that an actuator could not give
  std::int64_t missed = 0;     ///< samples without an output that is a number
  std::int64_t age = -1;       ///< [samples], of what one in another process gave last; -1: nothing
  bool lost = false;           ///< it has not answered for its time-out
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
