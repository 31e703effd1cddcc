// How far the loop of a controller is from instability, as the monitor judges it.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "messages/fields.h"
#include "messages/states.h"

namespace whirl_twin::state {

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

}  // namespace whirl_twin::state
