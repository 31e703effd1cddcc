// A rotor on a prescribed shaft or, where a motor turns it, with a free spin.
#pragma once

#include "mechanics/rotors/free_spin.h"
#include "models/model_entry.h"

namespace whirl_twin {

template <class Rotor>
ModelSetup setUpSpinning(const ParameterValues& values, const ModelContext& around) {
  FreeSpin<Rotor> rotor = makeModel<FreeSpin<Rotor>>(values, around.gravity);
  rotor.motor = around.motor.value();
  return setUp(rotor);
}

template <class Rotor>
ModelSetup setUpEither(const ParameterValues& values, const ModelContext& around) {
  return around.motor ? setUpSpinning<Rotor>(values, around) : setUp<Rotor>(values, around.gravity);
}

template <class Rotor>
ModelVariant spinningVariant(const std::string& when) {
  ModelVariant v = variant<FreeSpin<Rotor>>(when);
  v.motor = true;
  return v;
}

}  // namespace whirl_twin
