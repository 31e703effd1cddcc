#include "requests/run_watches.h"

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

ValidityWatch::ValidityWatch(const Twin& twin, const std::vector<std::size_t>& systems)
    : twin_(twin) {
  for (const std::size_t i : systems) {
    if (hasConditions(*twin.systems()[i]->dynamics)) {
      watched_.push_back(i);
    }
  }
}

std::vector<std::string> ValidityWatch::look(const Observer& observer) {
  std::vector<std::string> warnings;
  for (const std::size_t i : watched_) {
    if (twin_.status(i) != StepStatus::kOk) {
      continue;
    }
    const BuiltSystem& system = *twin_.systems()[i];
    const auto n = static_cast<Eigen::Index>(system.spec.q.size());
    const EvaluationPoint<double> at = observer.moment(i);
    for (const Condition& c :
         validity(*system.dynamics, Eigen::Map<const Eigen::VectorXd>(observer.coordinates(i), n),
                  Eigen::Map<const Eigen::VectorXd>(observer.rates(i), n), at)) {
      if (c.margin > 0.0) {
        continue;
      }
      const auto [breach, first] = breaches_[i].try_emplace(c.name, Breach{c, at.time});
      if (first) {
        warnings.push_back(
            fmt::format("{}: warning: from t = {:.9g} s the equations are not valid: {}",
                        system.spec.name, at.time, brokenText({c}, Margins::kShown)));
      } else if (c.margin < breach->second.condition.margin) {
        breach->second.condition = c;
      }
    }
  }
  return warnings;
}

Json ValidityWatch::json(std::size_t system) const {
  Json all = Json::array();
  const auto found = breaches_.find(system);
  if (found != breaches_.end()) {
    for (const auto& [name, breach] : found->second) {
      all.push_back({{"condition", name},
                     {"meaning", breach.condition.broken},
                     {"unit", breach.condition.unit},
                     {"first_time", breach.first_time},
                     {"worst_margin", breach.condition.margin}});
    }
  }
  return all;
}

}  // namespace whirl_twin
