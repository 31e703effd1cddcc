// A controller of the twin as it runs.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "messages/fields.h"
#include "messages/states.h"

namespace whirl_twin::state {

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
