#include "mechanics/rotors/journal_jeffcott_rotor.h"
#include "models/jeffcott_forms.h"
#include "models/spinning_setup.h"

namespace whirl_twin {

ModelSetup setUpJournalJeffcott(const ParameterValues& values, const Surroundings& around) {
  return setUpEither<JournalJeffcottRotor>(values, around);
}

ModelVariant journalJeffcottVariant(const std::string& when) {
  return variant<JournalJeffcottRotor>(when);
}

}  // namespace whirl_twin
