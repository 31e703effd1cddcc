#include "mechanics/rotors/nonlinear_jeffcott_rotor.h"
#include "scene/models/jeffcott_forms.h"
#include "scene/spinning_setup.h"

namespace whirl_twin {

ModelSetup setUpNonlinearJeffcott(const ParameterValues& values, const Surroundings& around) {
  return setUpEither<NonlinearJeffcottRotor>(values, around);
}

ModelVariant nonlinearJeffcottVariant(const std::string& when) {
  return variant<NonlinearJeffcottRotor>(when);
}

}  // namespace whirl_twin
