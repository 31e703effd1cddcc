#include "python/stepped_twin.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

#include "accuracy/step_choice.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "realtime/denormals.h"
#include "reports/rotor_systems.h"
#include "twin/checkpoint.h"

namespace whirl_twin {

namespace {

constexpr std::int64_t kStepsAtOnce = 16;  // between two readings of the clock
constexpr std::chrono::milliseconds kLookPeriod{50};

struct SavedHead {
  std::int64_t step;
  std::uint64_t twin_size;  // bytes
};

}  // namespace

SteppedTwin::SteppedTwin(const Scene& scene)
    : scene_(withStepsChosen(scene)),
      twin_(scene_),
      generations_(std::make_shared<SystemGenerations>(twin_)),
      observer_(twin_, generations_),
      record_(twin_.layout().size),
      systems_(twin_.systems()) {
  twin_.buildEnsembles();
}

void SteppedTwin::observe() {
  twin_.write(record_.data());
  observer_.observe(record_.data());
}

/// As many steps as need not be observed, at most `count`.
std::int64_t SteppedTwin::stepUnobserved(std::int64_t count) {
  const bool looks = observer_.looks();
  const std::int64_t most =
      twin_.stepCount() == 0 ? 1 : std::min(count, std::min(kStepsAtOnce, observer_.mostPassed()));
  std::int64_t done = 0;
  while (done < most) {
    const std::int64_t now = looks ? 1 : most - done;
    const std::int64_t stepped = twin_.steps(now);
    done += stepped;
    if (stepped < now || !observer_.look(twin_)) {
      break;
    }
  }
  return done;
}

void SteppedTwin::step(std::int64_t count, const std::function<void()>& look) {
  const DenormalsToZero denormals_to_zero;  // as in the real-time loop: identical numbers
  auto next_look = std::chrono::steady_clock::now() + kLookPeriod;
  while (count > 0) {
    count -= stepUnobserved(count);
    observe();
    if (std::chrono::steady_clock::now() >= next_look) {
      look();
      next_look = std::chrono::steady_clock::now() + kLookPeriod;
    }
  }
}

void SteppedTwin::reset() {
  twin_.reset();
  systems_ = twin_.systems();
  observe();
}

std::size_t SteppedTwin::systemNamed(const std::string& name) const {
  std::vector<std::string> names;
  for (const SystemSpec& system : scene_.systems) {
    names.push_back(system.name);
    if (names.back() == name) {
      return names.size() - 1;
    }
  }
  throw InputError(fmt::format("no system '{}' in {}{}", printable(name), scene_.source,
                               hint(name, names)));
}

void SteppedTwin::setInput(const std::string& system, const std::string& input, double value,
                           std::optional<double> duration) {
  const std::size_t of = systemNamed(system);
  std::vector<std::string> names;
  for (const InputInfo& info : twin_.systems()[of]->dynamics->inputs()) {
    names.push_back(info.name);
  }
  const auto found = std::find(names.begin(), names.end(), input);
  if (found == names.end()) {
    throw InputError(
        fmt::format("{}: no input '{}'{}", system, printable(input), hint(input, names)));
  }
  const std::int64_t now = std::llround(twin_.time() * 1.0e9);
  constexpr double kLongest = 1.0e9;  // s
  if (duration && !(*duration > 0.0 && *duration <= kLongest)) {
    throw InputError(
        fmt::format("duration: must be above 0 and up to {:g} s, found {:g}", kLongest, *duration));
  }
  const std::int64_t length = duration ? std::max<std::int64_t>(1, std::llround(*duration * 1.0e9))
                                       : Inputs::kNever - 1 - std::max<std::int64_t>(now, 0);
  if (!twin_.setInput(of, static_cast<std::size_t>(found - names.begin()), value, length)) {
    throw InputError(fmt::format(
        "{0}: input {1}: must be given as a number in the scene, as systems.{0}.inputs.{1}: 0, to "
        "be set",
        system, input));
  }
}

void SteppedTwin::setParameter(const std::string& system, const std::string& path, double value) {
  const std::size_t of = systemNamed(system);
  SharedSystem changed = systems_[of]->with({path}, {value}, scene_.source);
  std::unique_ptr<Stepper> next = twin_.stepperOf(*changed);
  const std::int64_t number = generations_->add(of, {changed->dynamics, changed->parameters()});
  systems_[of] = std::move(changed);
  static_cast<void>(twin_.replace(of, std::move(next), number));
  observe();
}

std::optional<double> SteppedTwin::parameter(const std::string& system,
                                             const std::string& path) const {
  return systems_[systemNamed(system)]->parameter(path);
}

std::string SteppedTwin::save() {
  const std::string twin = imageOf(twin_);
  const SavedHead head{twin_.stepCount(), static_cast<std::uint64_t>(twin.size())};
  std::string bytes(sizeof head, '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  return bytes + twin + imageOf(observer_);
}

void SteppedTwin::restore(const std::string& bytes) {
  SavedHead head{};
  if (bytes.size() >= sizeof head) {
    std::memcpy(&head, bytes.data(), sizeof head);
  }
  if (bytes.size() < sizeof head || head.twin_size > bytes.size() - sizeof head) {
    throw InputError("restore: must be what save() returned");
  }
  const std::string before = save();
  try {
    put(head.step, bytes.substr(sizeof head), head.twin_size);
  } catch (const InputError&) {
    std::memcpy(&head, before.data(), sizeof head);
    put(head.step, before.substr(sizeof head), head.twin_size);
    throw;
  }
}

void SteppedTwin::put(std::int64_t step, const std::string& images, std::size_t twin_size) {
  Checkpoint saved;
  saved.step = step;
  saved.twin = images.substr(0, twin_size);
  saved.observer = images.substr(twin_size);
  whirl_twin::restore(saved, twin_, "restore");
  whirl_twin::restore(saved, observer_, "restore");
}

}  // namespace whirl_twin
