// The scene that a twin runs, as text, for receivers that only have its messages. Later live
// changes are published as ParameterChange.
#pragma once

#include <string>
#include <vector>

#include "messages/states.h"

namespace whirl_twin::state {

struct SceneText {
  static constexpr MessageKind kKind{"scene", "SceneText", "scene", MessageKind::kLatched};

  Instant at;                     ///< when it was published
  std::string source;             ///< the file, where it is known
  std::vector<std::string> line;  ///< YAML, as a scene file has it

  template <class Visit>
  static void fields(Visit& visit) {
    visit.head();
    visit(TWIN_FIELD(source), "", requireText);
    visit.array(TWIN_FIELD(lines), TWIN_FIELD(line), "", each(requireText));
  }
};

}  // namespace whirl_twin::state
