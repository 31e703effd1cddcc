#include "mechanics/rotors/nonlinear_jeffcott_rotor.h"
#include "models/models.h"
#include "models/spinning_setup.h"

namespace whirl_twin {

ModelSetup setUpNonlinearJeffcott(const ParameterValues& values, const ModelContext& around) {
  return setUpEither<NonlinearJeffcottRotor>(values, around);
}

ModelVariant nonlinearJeffcottVariant(const std::string& when) {
  return variant<NonlinearJeffcottRotor>(when);
}

}  // namespace whirl_twin
