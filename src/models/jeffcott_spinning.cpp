#include "mechanics/rotors/jeffcott_rotor.h"
#include "models/models.h"
#include "models/spinning_setup.h"

namespace whirl_twin {

ModelSetup setUpSpinningJeffcott(const ParameterValues& values, const ModelContext& around) {
  return setUpSpinning<JeffcottRotor>(values, around);
}

ModelVariant spinningJeffcottVariant(const std::string& when) {
  return spinningVariant<JeffcottRotor>(when);
}

}  // namespace whirl_twin
