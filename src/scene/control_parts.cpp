#include "scene/control_parts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace whirl_twin {

namespace {

constexpr std::int64_t kMaxParts = 20000;  // examined in search of a periodic pattern
constexpr std::size_t kMaxLengths = 16;    // each requires a prepared step
/// Noise channel of a seed; the channels of sensors are below it.
constexpr std::uint32_t kJitterChannel = 0xFFFFFFFF;

/// Period after which all instants repeat [ns]; nothing if it exceeds kMaxParts sub-steps, or does
/// not exist.
std::optional<std::int64_t> hyperperiod(const Scene& scene) {
  std::int64_t all = scene.step;
  for (const ControllerSpec& controller : scene.controllers) {
    const std::int64_t period = SampleInstants(controller.rate).period();
    if (period == 0 || controller.jitter > 0) {
      return std::nullopt;
    }
    const std::int64_t times = period / std::gcd(all, period);
    if (all / scene.step > kMaxParts / times) {
      return std::nullopt;
    }
    all *= times;
  }
  return all;
}

}  // namespace

ControlInstants::ControlInstants(const ControllerSpec& controller, std::int64_t start)
    : instants_(controller.rate),
      delay_(controller.delay),
      jitter_(controller.jitter),
      noise_(controller.jitter_seed, kJitterChannel) {
  this->start(start);
}

void ControlInstants::start(std::int64_t start) noexcept {
  sample_ = instants_.firstFrom(start);
  output_ = instants_.firstFrom(start - delay_ - jitter_);
  while (dueAt(output_) < start) {
    ++output_;
  }
  sample_time_ = instants_.at(sample_);
  output_time_ = dueAt(output_);
}

bool ControlInstants::isAt(std::int64_t time) const noexcept {
  ControlInstants other = *this;
  other.start(time);
  // An instant at `time` itself may have been passed. With jitter, an output waits for earlier
  // ones.
  const std::int64_t period = instants_.at(other.sample_ + 1) - instants_.at(other.sample_);
  const std::int64_t apart = 2 + 2 * jitter_ / period;
  return sample_ >= other.sample_ && sample_ <= other.sample_ + 1 &&
         sample_time_ == instants_.at(sample_) && output_ >= other.output_ - apart &&
         output_ <= other.output_ + apart && output_time_ >= time &&
         output_time_ <= time + apart * period + delay_ + jitter_;
}

std::int64_t ControlInstants::dueAt(std::int64_t output) const noexcept {
  const std::int64_t due = instants_.at(output) + delay_;
  return jitter_ == 0 ? due
                      : due + std::llround(static_cast<double>(jitter_) * noise_.even(output));
}

std::vector<std::int64_t> partLengths(const Scene& scene) {
  std::vector<ControlInstants> controllers;
  for (const ControllerSpec& controller : scene.controllers) {
    controllers.emplace_back(controller, scene.time);
  }
  const std::optional<std::int64_t> period = hyperperiod(scene);
  std::map<std::int64_t, std::int64_t> count;  // sub-steps by length
  std::int64_t time = scene.time;
  std::int64_t step_end = time + scene.step;
  std::int64_t parts = 0;
  while (parts < kMaxParts && !(period && time >= scene.time + *period)) {
    std::int64_t next = step_end;
    for (ControlInstants& controller : controllers) {
      while (controller.sampleTime() <= time) {
        controller.passSample();
      }
      while (controller.outputTime() <= time) {
        controller.passOutput();
      }
      next = std::min(next, controller.next());
    }
    ++count[next - time];
    ++parts;
    time = next;
    step_end += time == step_end ? scene.step : 0;
  }
  const bool all_seen = period && time >= scene.time + *period;
  count.erase(scene.step);
  std::vector<std::pair<std::int64_t, std::int64_t>> often;
  for (const auto& [length, times] : count) {
    often.emplace_back(times, length);
  }
  std::sort(often.rbegin(), often.rend());
  std::vector<std::int64_t> lengths;
  for (std::size_t i = 0; i < std::min(often.size(), kMaxLengths); ++i) {
    lengths.push_back(often[i].second);
  }
  if (!all_seen || often.size() > kMaxLengths) {
    for (std::int64_t length = 1; length < scene.step; length *= 2) {
      lengths.push_back(length);
    }
  }
  std::sort(lengths.begin(), lengths.end(), std::greater<>());
  lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
  return lengths;
}

bool involves(const ControllerSpec& controller, std::size_t system) {
  const auto is_it = [&](const auto& of) { return of.system == system; };
  return std::any_of(controller.measures.begin(), controller.measures.end(), is_it) ||
         std::any_of(controller.acts_on.begin(), controller.acts_on.end(), is_it);
}

bool isControlled(const Scene& scene, std::size_t system) {
  return std::any_of(scene.controllers.begin(), scene.controllers.end(),
                     [&](const ControllerSpec& c) { return involves(c, system); });
}

bool isTiedToOthers(const Scene& scene, std::size_t system) {
  const auto is_other = [&](const auto& of) { return of.system != system; };
  return std::any_of(scene.controllers.begin(), scene.controllers.end(),
                     [&](const ControllerSpec& c) {
                       return involves(c, system) &&
                              (std::any_of(c.measures.begin(), c.measures.end(), is_other) ||
                               std::any_of(c.acts_on.begin(), c.acts_on.end(), is_other));
                     });
}

}  // namespace whirl_twin
