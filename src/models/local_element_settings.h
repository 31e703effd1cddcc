// Local nonlinear elements of a flexible rotor in a scene: rubs, cubic springs, oil films
// (mechanics/local_elements.h).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/local_force.h"
#include "mechanics/rotors/short_journal_bearing.h"
#include "models/settings.h"

namespace whirl_twin {

/// Tables rubs, cubic_springs and squeeze_films.
std::vector<SettingInfo> localElementSettings();

struct NodeElement {
  /// The two bodies that it connects. For a node without a pedestal all are equivalent.
  enum class Between {
    kShaftAndGround,
    kShaftAndPedestal,  ///< the first one, as a bearing
    kPedestalAndGround  ///< the last one, as a damper around its ring
  };
  std::string name;  ///< "rub_3"
  int node = 0;
  Between between = Between::kShaftAndGround;
  std::shared_ptr<const NodalForceLaw> law;
  double damping = 0.0;                                       ///< [N s/m], of the rotor itself
  std::optional<ShortJournalBearing> journal = std::nullopt;  ///< it is the film of
};

/// Those of these tables, and the journal bearings without a load. Throws SetupError.
std::vector<NodeElement> nodeElements(const Settings& settings, int nodes);

}  // namespace whirl_twin
