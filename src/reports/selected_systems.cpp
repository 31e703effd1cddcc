#include "reports/selected_systems.h"

#include <fmt/format.h>

#include "messages/names.h"
#include "messages/refusal.h"

namespace whirl_twin {

std::vector<std::size_t> selectedSystems(const Scene& scene,
                                         const std::optional<std::string>& name) {
  std::vector<std::size_t> selected;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    names.push_back(scene.systems[i].name);
    if (!name || *name == names.back()) {
      selected.push_back(i);
    }
  }
  if (selected.empty()) {
    throw Refusal(
        fmt::format("--system: no system '{}' in {}{}", *name, scene.source, hint(*name, names)));
  }
  return selected;
}

}  // namespace whirl_twin
