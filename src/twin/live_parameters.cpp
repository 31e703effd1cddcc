#include "twin/live_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "controllers/controller_registry.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "scene/parameter_paths.h"
#include "twin/trial_steps.h"

namespace whirl_twin {

namespace {

constexpr const char* kEnded = "the simulation is ending";
constexpr double kMaxRamp = 1.0e6;  // s
/// Systems are prepared for speeds beyond those of a move by this fraction of the highest.
constexpr double kSpeedMargin = 0.02;
/// A profile may advance while systems are prepared; then the preparation is repeated.
constexpr int kMaxPreparations = 3;

constexpr const char* kService = "set_parameter";  // prefix of its diagnostics

std::vector<double> valuesOf(const BuiltSystem& system, const std::vector<std::string>& names) {
  std::vector<double> values;
  for (const std::string& name : names) {
    values.push_back(system.parameter(name).value_or(0.0));
  }
  return values;
}

std::vector<double> valuesOf(const ControllerSpec& controller,
                             const std::vector<std::string>& names) {
  std::vector<double> values;
  for (const std::string& name : names) {
    values.push_back(parameterAt(name, *findController(controller.type), controller).value_or(0.0));
  }
  return values;
}

std::vector<std::pair<double, double>> profileRanges(const Twin& twin) {
  std::vector<std::pair<double, double>> ranges;
  for (std::size_t i = 0; i < twin.driveCount(); ++i) {
    ranges.push_back(twin.drive(i).speedRange());
  }
  return ranges;
}

}  // namespace

LiveParameters::LiveParameters(LiveTwin& twin, std::function<bool()> wait)
    : twin_(twin),
      wait_(std::move(wait)),
      systems_(twin.twin().systems()),
      controllers_(twin.twin().scene().controllers),
      generations_(systems_.size() + controllers_.size()),
      made_ready_(systems_.size()),
      scene_speed_ranges_(profileRanges(twin.twin())),
      speed_ranges_(scene_speed_ranges_),
      targets_(scene_speed_ranges_.size()) {}

double LiveParameters::time() const {
  return twin_.twin().seconds(twin_.stepCount());
}

void LiveParameters::restored() {
  systems_ = twin_.twin().systems();
  controllers_ = twin_.twin().scene().controllers;
  std::fill(generations_.begin(), generations_.end(), 0);
  std::fill(made_ready_.begin(), made_ready_.end(), std::vector<SpeedRange>());
  speed_ranges_ = scene_speed_ranges_;
  std::fill(targets_.begin(), targets_.end(), std::nullopt);
  ramps_.clear();
}

bool LiveParameters::takeOver(std::size_t system, std::unique_ptr<Stepper> next,
                              SystemGeneration generation) {
  const std::int64_t number = twin_.generations()->add(system, std::move(generation));
  generations_[system] = number;
  return wait_() && twin_.replace(system, next, number) && wait_();
}

bool LiveParameters::change(std::size_t system, SharedSystem changed,
                            const std::vector<std::string>& names) {
  std::unique_ptr<Stepper> next = twin_.twin().stepperOf(*changed);
  made_ready_[system].clear();
  if (targets_[changed->drive]) {  // a new system is prepared for the scene's speeds only
    const auto [lowest, highest] = speed_ranges_[changed->drive];
    const double target = *targets_[changed->drive];
    for (const auto& [from, to] : {std::pair{lowest, highest}, std::pair{target, target}}) {
      made_ready_[system].emplace_back(from, to);
      if (std::unique_ptr<Stepper> ready = next->readyFor(from, to)) {
        next = std::move(ready);
      }
    }
  }
  SystemGeneration generation{changed->dynamics, changed->parameters()};
  generation.parameters.changed = names;
  generation.parameters.previous = valuesOf(*systems_[system], names);
  systems_[system] = std::move(changed);
  return takeOver(system, std::move(next), std::move(generation));
}

bool LiveParameters::change(std::size_t controller, ChangedController next,
                            const std::vector<std::string>& names) {
  SystemGeneration generation{nullptr, parametersOf(next.spec)};
  generation.parameters.changed = names;
  generation.parameters.previous = valuesOf(controllers_[controller], names);
  controllers_[controller] = std::move(next.spec);
  const std::int64_t number =
      twin_.generations()->add(systems_.size() + controller, std::move(generation));
  generations_[systems_.size() + controller] = number;
  return wait_() && twin_.replaceLaw(controller, next.law, number) && wait_();
}

ChangedController LiveParameters::changedController(Which which,
                                                    const std::vector<std::string>& names,
                                                    const std::vector<double>& values) {
  return withParameters(twin_.twin().scene(), controller(which), names, values, kService);
}

std::vector<std::string> LiveParameters::names() const {
  std::vector<std::string> names;
  for (const SharedSystem& system : systems_) {
    names.push_back(system->spec.name);
  }
  for (const ControllerSpec& controller : controllers_) {
    names.push_back(controller.name);
  }
  return names;
}

std::string LiveParameters::diagnosticOf(const ParameterRequest& request) const {
  const std::vector<std::string> known = names();
  if (std::find(known.begin(), known.end(), request.system) == known.end()) {
    const std::string near = nearestName(request.system, known);
    return fmt::format("system: must be a system{} of the scene, found '{}'{}",
                       controllers_.empty() ? "" : " or a controller", request.system,
                       near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
  }
  if (!(request.ramp >= 0.0 && request.ramp <= kMaxRamp)) {
    return fmt::format("ramp: must be from 0 to {:g} s, found {}", kMaxRamp, request.ramp);
  }
  if (request.names.size() != request.values.size()) {
    return fmt::format("must be one value per parameter, found {} parameters and {} values",
                       request.names.size(), request.values.size());
  }
  for (const std::string& name : request.names) {
    if (std::count(request.names.begin(), request.names.end(), name) > 1) {
      return fmt::format("parameter: duplicate '{}'", name);
    }
  }
  return "";
}

/// Applies the immediate part; a nonempty message: rejected. The end of a ramp is checked here,
/// intermediate values on the way.
ParameterAnswer LiveParameters::begin(Which which, const ParameterRequest& request) {
  ParameterAnswer answer;
  const bool at_once = request.ramp == 0.0;
  try {
    if (isSystem(which)) {
      SharedSystem changed = systems_[which]->with(request.names, request.values, kService);
      answer.message = whyItWouldStop(twin_.twin().built(), *changed);
      if (!answer.message.empty()) {
        return answer;
      }
      answer.previous = valuesOf(*systems_[which], request.names);
      answer.done = !at_once || change(which, std::move(changed), request.names);
    } else {
      ChangedController changed = changedController(which, request.names, request.values);
      answer.previous = valuesOf(controller(which), request.names);
      answer.done = !at_once || change(which - systems_.size(), std::move(changed), request.names);
    }
  } catch (const std::exception& error) {
    answer.message = error.what();
  }
  return answer;
}

ParameterAnswer LiveParameters::set(const ParameterRequest& request) {
  ParameterAnswer answer;
  answer.message = diagnosticOf(request);
  if (!answer.message.empty()) {
    return answer;
  }
  const std::vector<std::string> known = names();
  const auto which =
      static_cast<Which>(std::find(known.begin(), known.end(), request.system) - known.begin());
  answer = begin(which, request);
  if (!answer.message.empty()) {
    return answer;
  }
  answer.step = request.ramp > 0.0 ? twin_.stepCount() : twin_.answer().step;
  const auto replaced = [&](const Ramp& ramp) {
    return ramp.which == which &&
           std::count(request.names.begin(), request.names.end(), ramp.name) > 0;
  };
  ramps_.erase(std::remove_if(ramps_.begin(), ramps_.end(), replaced), ramps_.end());
  answer.message = answer.done ? "" : kEnded;
  for (std::size_t i = 0; answer.done && i < request.names.size(); ++i) {
    const double from = answer.previous[i];
    const double to = request.values[i];
    answer.message += fmt::format("{}{}.{} from {} to {}", i == 0 ? "" : ", ", request.system,
                                  request.names[i], from, to);
    if (request.ramp > 0.0) {
      ramps_.push_back({which, request.names[i], from, to, time(), request.ramp});
      answer.message += fmt::format(" in {:g} s", request.ramp);
    }
  }
  return answer;
}

void LiveParameters::continueRamps(Which which, double now) {
  std::vector<std::string> names;
  std::vector<double> values;
  for (const Ramp& ramp : ramps_) {
    if (ramp.which == which) {
      const double part = std::clamp((now - ramp.start) / ramp.duration, 0.0, 1.0);
      names.push_back(ramp.name);
      values.push_back(part < 1.0 ? ramp.from + part * (ramp.to - ramp.from) : ramp.to);
    }
  }
  if (names.empty()) {
    return;
  }
  static_cast<void>(
      isSystem(which)
          ? change(which, systems_[which]->with(names, values, kService), names)
          : change(which - systems_.size(), changedController(which, names, values), names));
}

std::vector<std::string> LiveParameters::continueRamps() {
  std::vector<std::string> given_up;
  const double now = time();
  if (ramps_.empty() || std::fabs(now - ramped_at_) < kRampUpdate) {
    return given_up;
  }
  ramped_at_ = now;
  for (Which i = 0; i < systems_.size() + controllers_.size(); ++i) {
    const auto over = [&](const Ramp& ramp) {
      return ramp.which == i && now >= ramp.start + ramp.duration;
    };
    const auto of_this = [&](const Ramp& ramp) { return ramp.which == i; };
    try {
      continueRamps(i, now);
      ramps_.erase(std::remove_if(ramps_.begin(), ramps_.end(), over), ramps_.end());
    } catch (const std::exception& error) {
      ramps_.erase(std::remove_if(ramps_.begin(), ramps_.end(), of_this), ramps_.end());
      given_up.push_back(fmt::format("a ramp was aborted: {}", error.what()));
    }
  }
  return given_up;
}

std::uint64_t LiveParameters::stepsToUpdate() const {
  if (ramps_.empty()) {
    return std::numeric_limits<std::uint64_t>::max();
  }
  const double left = ramped_at_ + kRampUpdate - time();  // [s]; arbitrary after a reset
  const double steps = std::round(left / twin_.twin().scene().stepSeconds());
  return static_cast<std::uint64_t>(std::clamp(steps, 1.0, kMaxRamp));
}

std::string LiveParameters::diagnosticOf(std::size_t drive, const SpeedReach& reach) const {
  const double speed = reach.target;
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    if (systems_[i]->drive != drive) {
      continue;
    }
    const Ensemble* const ensemble = twin_.twin().ensemble(i);
    if (ensemble != nullptr) {
      const auto [low, high] = ensemble->steps().speeds();
      if (reach.lowest < low || reach.highest > high) {
        return fmt::format(
            "speed: must be from {:g} to {:g} rad/s, the range prepared for the ensemble of {}, "
            "found {:g}",
            low, high, systems_[i]->spec.name, reach.lowest < low ? reach.lowest : reach.highest);
      }
    }
    try {
      const std::string stop = whyItWouldStop(twin_.twin().built(), *systems_[i], speed);
      if (!stop.empty()) {
        return fmt::format("speed: at {:g} rad/s {}", speed, stop);
      }
    } catch (const RunFailure& error) {
      return fmt::format("speed: at {:g} rad/s: {}", speed, error.what());
    }
  }
  return "";
}

std::optional<SpeedReach> LiveParameters::reachOf(std::size_t drive, const SpeedMove& move) {
  TwinCommand look;
  look.kind = TwinCommand::Kind::kLook;
  look.drive = drive;
  if (!twin_.send(look) || !wait_()) {
    return std::nullopt;
  }
  const TwinAnswer now = twin_.answer();
  const ExclusionBands& avoid = twin_.twin().drive(drive).avoid();
  SpeedMove to = move;
  to.speed = avoid.allowed(move.speed, move.max_acceleration, move.max_jerk, now.target_speed);
  // With limited jerk the speed continues to change until the acceleration is zero.
  const auto [low, high] =
      std::minmax({now.speed, stoppingSpeed(now.speed, now.acceleration, move.max_jerk), to.speed});
  SpeedReach reach{to.speed, low, high};
  const BandedChange plan = avoid.plan(now.speed, now.acceleration, to);
  for (std::size_t i = 0; i < plan.count; ++i) {
    reach.lowest = std::min(reach.lowest, plan.speeds[i]);
    reach.highest = std::max(reach.highest, plan.speeds[i]);
  }
  return reach;
}

bool LiveParameters::prepareFor(std::size_t drive, const SpeedMove& move) {
  SpeedRange& range = speed_ranges_[drive];
  for (int i = 0; i < kMaxPreparations; ++i) {
    const std::optional<SpeedReach> reach = reachOf(drive, move);
    if (!reach) {
      return false;
    }
    const auto [target, low, high] = *reach;
    const bool covered = low >= range.first && high <= range.second;
    if (covered && i > 0) {
      return true;
    }
    if (!covered) {
      const double margin = kSpeedMargin * std::max(std::fabs(low), std::fabs(high));
      range = {std::min(range.first, low - margin), std::max(range.second, high + margin)};
    }
    targets_[drive] = target;
    for (std::size_t s = 0; s < systems_.size(); ++s) {
      if (systems_[s]->drive == drive && !prepare(s, covered)) {
        return false;
      }
    }
  }
  return true;
}

bool LiveParameters::prepare(std::size_t system, bool range_covered) {
  const std::size_t drive = systems_[system]->drive;
  const Stepper& running = twin_.twin().running(system);
  std::unique_ptr<Stepper> next;
  if (!range_covered) {
    next = running.readyFor(speed_ranges_[drive].first, speed_ranges_[drive].second);
    made_ready_[system].push_back(speed_ranges_[drive]);
  }
  // The final speed, at which a system may step exactly.
  made_ready_[system].emplace_back(*targets_[drive], *targets_[drive]);
  if (auto ready = (next ? *next : running).readyFor(*targets_[drive], *targets_[drive])) {
    next = std::move(ready);
  }
  return !next || takeOver(system, std::move(next),
                           {systems_[system]->dynamics, systems_[system]->parameters()});
}

}  // namespace whirl_twin
