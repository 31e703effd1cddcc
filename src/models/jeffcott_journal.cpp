#include <memory>
#include <utility>

#include "integration/jacobi_integral.h"
#include "mechanics/lagrangian_dynamics.h"
#include "mechanics/local_elements.h"
#include "mechanics/rotors/journal_jeffcott_rotor.h"
#include "models/linear_rotor_setup.h"
#include "models/models.h"
#include "models/spinning_setup.h"

namespace whirl_twin {

ModelSetup setUpJournalJeffcott(const ParameterValues& values, const ModelContext& around) {
  if (around.motor) {
    return setUpSpinning<JournalJeffcottRotor>(values, around);
  }
  const auto rotor = makeModel<JournalJeffcottRotor>(values, around.gravity);
  const FilmlessJeffcottRotor& linear = rotor;
  OilFilm both{rotor.bearing(), true};
  both.bearing.viscosity *= 2.0;  // a film's force is proportional to it
  LocalForce films;
  films.name = "journals";
  films.along_x = Eigen::Vector4d::Unit(2);
  films.along_y = Eigen::Vector4d::Unit(3);
  films.inputs = {LocalForce::kNoInput, LocalForce::kNoInput};
  films.law = localLaw(both);
  return withExactLinearPart(setUp(rotor),
                             std::make_shared<LagrangianDynamics<FilmlessJeffcottRotor>>(linear),
                             both.linearDamping(), jacobiIntegral(linear), {films});
}

ModelVariant journalJeffcottVariant(const std::string& when) {
  ModelVariant v = variant<JournalJeffcottRotor>(when);
  v.integrators.emplace_back(Exponential<1>::kName);
  return v;
}

}  // namespace whirl_twin
