#include "tools/accuracy_watch.h"

#include <fmt/format.h>

namespace whirl_twin {

AccuracyWatch::AccuracyWatch(const Twin& twin, const std::vector<std::size_t>& systems)
    : twin_(twin) {
  for (const std::size_t i : systems) {
    if (twin.systems()[i]->spec.integrator == "auto") {
      watched_.push_back(i);
    }
  }
}

std::vector<std::string> AccuracyWatch::look(const Observer& observer) {
  std::vector<std::string> warnings;
  for (const std::size_t i : watched_) {
    const SystemSpec& spec = twin_.systems()[i]->spec;
    const double estimate = observer.errorEstimate(i);
    if (estimate > spec.tolerance && lost_.count(i) == 0) {
      const double now = observer.instant().time;
      lost_[i] = now;
      warnings.push_back(fmt::format(
          "{}: warning: from t = {:.9g} s the steps are less accurate than required: error about "
          "{:.1g} over the horizon, above the tolerance {:g} (ACCURACY_LOST)",
          spec.name, now, estimate, spec.tolerance));
    }
  }
  return warnings;
}

std::optional<double> AccuracyWatch::lostAt(std::size_t system) const {
  const auto found = lost_.find(system);
  return found == lost_.end() ? std::nullopt : std::optional<double>(found->second);
}

}  // namespace whirl_twin
