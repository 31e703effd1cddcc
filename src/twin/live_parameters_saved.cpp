// Saving and restoring live changes for checkpoints.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "control/speed_profile.h"
#include "messages/input_error.h"
#include "twin/live_parameters.h"

namespace whirl_twin {

namespace {

/// [rad/s]
std::pair<double, double> speedsOf(const YAML::Node& from, const YAML::Node& to) {
  const std::pair<double, double> speeds{from.as<double>(), to.as<double>()};
  if (!(std::fabs(speeds.first) <= kMaxSpeed) || !(std::fabs(speeds.second) <= kMaxSpeed)) {
    throw YAML::Exception(from.Mark(), "must be the speed of a drive");
  }
  return speeds;
}

}  // namespace

YAML::Node LiveParameters::saved() const {
  const auto number = [](double value) { return fmt::format("{}", value); };
  YAML::Node saved;
  const std::vector<std::string> known = names();
  for (Which i = 0; i < generations_.size(); ++i) {
    if (generations_[i] == 0) {
      continue;
    }
    const state::ParameterChange now =
        isSystem(i) ? systems_[i]->parameters() : parametersOf(controllers_[i - systems_.size()]);
    const state::ParameterChange published =
        twin_.generations()->at(i, generations_[i])->parameters;
    YAML::Node change;
    change["which"] = known[i];
    change["generation"] = generations_[i];
    change["names"] = now.names;
    for (const double value : now.values) {
      change["values"].push_back(number(value));
    }
    change["changed"] = published.changed;
    for (const double value : published.previous) {
      change["previous"].push_back(number(value));
    }
    for (const auto& [from, to] : isSystem(i) ? made_ready_[i] : std::vector<SpeedRange>()) {
      change["made_ready"].push_back(std::vector<std::string>{number(from), number(to)});
    }
    saved["changes"].push_back(change);
  }
  for (std::size_t i = 0; i < speed_ranges_.size(); ++i) {
    YAML::Node drive;
    drive["from"] = number(speed_ranges_[i].first);
    drive["to"] = number(speed_ranges_[i].second);
    if (targets_[i]) {
      drive["target"] = number(*targets_[i]);
    }
    saved["drives"].push_back(drive);
  }
  for (const Ramp& ramp : ramps_) {
    YAML::Node node;
    node["which"] = known[ramp.which];
    node["name"] = ramp.name;
    node["numbers"] = std::vector<std::string>{number(ramp.from), number(ramp.to),
                                               number(ramp.start), number(ramp.duration)};
    saved["ramps"].push_back(node);
  }
  saved["ramped_at"] = number(ramped_at_);
  saved["paused"] = twin_.paused();
  return saved;
}

LiveParameters::Which LiveParameters::whichOf(const YAML::Node& name) const {
  const std::vector<std::string> known = names();
  const auto found = std::find(known.begin(), known.end(), name.as<std::string>());
  if (found == known.end()) {
    throw YAML::Exception(name.Mark(), "must be a system or a controller");
  }
  return static_cast<Which>(found - known.begin());
}

/// Of a system or a controller: created as at the change.
void LiveParameters::resumeChange(const YAML::Node& saved) {
  const Which which = whichOf(saved["which"]);
  const auto generation = saved["generation"].as<std::int64_t>();
  SystemGeneration made;
  state::ParameterChange set;
  set.system = saved["which"].as<std::string>();
  set.names = saved["names"].as<std::vector<std::string>>();
  set.values = saved["values"].as<std::vector<double>>();
  if (set.values.size() != set.names.size() || generation <= 0) {
    throw YAML::Exception(saved.Mark(), "must be a map of live changes");
  }
  if (isSystem(which)) {
    const SharedSystem system = twin_.twin().systems()[which]->with(set);
    if (!system) {
      throw InputError(fmt::format("the saved parameters of {} cannot be set", set.system));
    }
    std::unique_ptr<Stepper> stepper = twin_.twin().stepperOf(*system);
    for (const YAML::Node& range : saved["made_ready"]) {
      const SpeedRange speeds = speedsOf(range[0], range[1]);
      made_ready_[which].push_back(speeds);
      if (std::unique_ptr<Stepper> ready = stepper->readyFor(speeds.first, speeds.second)) {
        stepper = std::move(ready);
      }
    }
    systems_[which] = system;
    made = {system->dynamics, system->parameters()};
    twin_.atRest().replace(which, std::move(stepper), generation);
  } else {
    ChangedController next = changedController(which, set.names, set.values);
    made = {nullptr, parametersOf(next.spec)};
    controller(which) = std::move(next.spec);
    twin_.atRest().replaceLaw(which - systems_.size(), std::move(next.law), generation);
  }
  if (saved["changed"]) {
    made.parameters.changed = saved["changed"].as<std::vector<std::string>>();
  }
  if (saved["previous"]) {
    made.parameters.previous = saved["previous"].as<std::vector<double>>();
  }
  generations_[which] = generation;
  twin_.generations()->restore(which, generation, std::move(made));
}

void LiveParameters::resume(const YAML::Node& saved) {
  for (const YAML::Node& change : saved["changes"]) {
    resumeChange(change);
  }
  for (std::size_t i = 0; i < speed_ranges_.size(); ++i) {
    const YAML::Node drive = saved["drives"][i];
    speed_ranges_[i] = speedsOf(drive["from"], drive["to"]);
    if (drive["target"]) {
      targets_[i] = speedsOf(drive["target"], drive["target"]).first;
    }
  }
  for (const YAML::Node& ramp : saved["ramps"]) {
    const auto number = [&](int i) { return ramp["numbers"][i].as<double>(); };
    ramps_.push_back({whichOf(ramp["which"]), ramp["name"].as<std::string>(), number(0), number(1),
                      number(2), number(3)});
  }
  ramped_at_ = saved["ramped_at"].as<double>();
}

}  // namespace whirl_twin
