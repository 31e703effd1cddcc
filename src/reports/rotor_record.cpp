#include "reports/rotor_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "algebra/constants.h"
#include "estimation/measured_queue.h"
#include "messages/input_error.h"
#include "messages/units.h"
#include "scene/signal_names.h"
#include "signal/recorded_signal.h"

namespace whirl_twin {

namespace {

constexpr double kTogether = 1.0e-3;  // of a period: samples less apart are of one instant
constexpr double kPatience = 600.0;   // s, that samples wait for those of other sources
constexpr double kMaxAngle = 1.0e15;  // rad; beyond, a double has no phase

/// A source of probes and what the log has of it.
struct RecordedSource {
  const SensorSpec* spec = nullptr;
  std::int64_t samples = 0;                 // each later than all before
  std::int64_t first = 0, last = 0;         // [ns]
  std::map<std::string, double> deviation;  // [m], of its channels, as in the first message
  std::map<std::string, WildSamples> wild;  // of its channels

  void take(const state::Measurement& message) {
    if (samples == 0) {
      first = last = message.instantOf(0);
      for (std::size_t c = 0; c < message.channel.size(); ++c) {
        deviation[message.channel[c]] = unitScale(message.unit[c], "m") * message.deviation[c];
      }
    }
    for (std::int64_t i = 0; i < message.samples; ++i) {
      const std::int64_t instant = message.instantOf(i);
      if (samples > 0 && instant <= last) {
        continue;
      }
      ++samples;
      last = instant;
      for (std::size_t c = 0; c < message.channel.size(); ++c) {
        const std::size_t at = static_cast<std::size_t>(i) * message.channel.size() + c;
        const double value = unitScale(message.unit[c], "m") * message.value[at];
        if (message.valid[at] != 0 && std::isfinite(value)) {
          wild[message.channel[c]].take(instant, value);
        }
      }
    }
  }
  double period() const {  // [s]
    return static_cast<double>(last - first) * kNanosecond / static_cast<double>(samples - 1);
  }
  /// Its samples are those of the instants of the other.
  bool isAtInstantsOf(const RecordedSource& other) const {
    const double slack = kTogether * other.period() / kNanosecond;
    return samples == other.samples &&
           std::fabs(static_cast<double>(first - other.first)) < slack &&
           std::fabs(static_cast<double>(last - other.last)) < slack;
  }
  std::string wildNote(const std::string& probe, const WildSamples& of) const {
    return fmt::format(
        "{}: {} implausible {} left out, the first {:.4g} s after the first sample, up to {:.3g} m",
        probe, of.instants.size(), of.instants.size() == 1 ? "sample" : "samples",
        kNanosecond * static_cast<double>(of.instants.front() - first), of.largest);
  }
};

/// At the rotor, not at its casing.
std::vector<RecordedProbe> probesOf(const SensorSpec& sensor, std::size_t system,
                                    std::size_t stations) {
  std::vector<RecordedProbe> probes;
  for (const SensorChannelSpec& channel : sensor.channels) {
    const SignalSpec& at = channel.signal;
    if (at.kind == SignalSpec::Kind::kDisplacement && at.system == system &&
        at.station < stations) {
      probes.push_back(
          {channel.name, at.station, at.direction, 0.0, channel.sensor.delay,
           channel.sensor.bandwidth,
           std::polar(channel.run_out.amplitude, channel.run_out.angle - at.direction)});
    }
  }
  return probes;
}

}  // namespace

std::string RecordCounts::pulseNote() const {
  std::string note;
  if (!stated) {
    note = fmt::format("the keyphasor's pulses scatter by {:.2g} s, more than the scene specifies",
                       jitter);
  }
  if (false_pulses > 0) {
    note += fmt::format("{}{} of {} pulses of the keyphasor are rejected", note.empty() ? "" : "; ",
                        false_pulses, pulses + false_pulses);
  }
  return note;
}

void RecordCounts::addTo(Json& json, std::int64_t used) const {
  json.update({{"samples", used},
               {"samples_without_angle", no_angle},
               {"values_not_valid", not_valid},
               {"false_pulses", false_pulses},
               {"missing_pulses", missing_pulses},
               {"pulse_jitter", jitter}});
}

RotorRecord::RotorRecord(const BuiltScene& scene, const RotorSystem& system,
                         const Recording& recording, ProbesRead probes)
    : recording_(recording), measured_(estimatorSources(scene.scene, {})) {
  findProbes(scene, system, probes);
  if (probes_.empty()) {
    findWhirl(system);
  }
  if (probes_.empty()) {
    throw InputError(fmt::format(
        "{}: must have displacement probes at '{}' and a keyphasor on its shaft, as `sensors` of "
        "the "
        "scene names them, or its whirl, on channels that begin with {} (--lcm-prefix); {}",
        log(), system.name, recording_.prefix, foundElsewhere(eachMessage([](const Message&) {}))));
  }
  if (!(steady_speed_ > 0.0)) {
    throw InputError(fmt::format("{}: the shaft must rotate forward", log()));
  }
}

LoggedMessages RotorRecord::eachMessage(const std::function<void(const Message&)>& take) const {
  return readRecording(
      recording_, measured_, {&state::Measurement::kKind, &state::WhirlState::kKind},
      [&](const Message& message, std::int64_t) { take(message); },
      [](std::uint64_t, std::uint64_t) {});
}

/// Sources of probes at the rotor of which the log has samples, and a keyphasor.
void RotorRecord::findProbes(const BuiltScene& scene, const RotorSystem& system, ProbesRead which) {
  std::map<std::string, RecordedSource> sources;
  std::map<std::string, KeyphasorSettings> keyphasors;
  const std::size_t place = selectedSystems(scene.scene, system.name).front();
  const std::size_t drive = scene.scene.driveOf(scene.scene.systems[place]);
  for (const SensorSpec& sensor : scene.scene.sensors) {
    if (sensor.keyphasor && sensor.drive == drive) {
      keyphasors[sensor.name] = *sensor.keyphasor;
    } else if (!sensor.keyphasor && !probesOf(sensor, place, system.stations.size()).empty()) {
      sources[sensor.name].spec = &sensor;
    }
  }
  if (sources.empty() || keyphasors.empty()) {
    return;
  }
  std::map<std::string, std::vector<std::int64_t>> pulses;
  const LoggedMessages log = eachMessage([&](const Message& message) {
    const auto* const measured = std::get_if<state::Measurement>(&message);
    if (measured == nullptr) {
      return;
    }
    if (keyphasors.count(measured->source) > 0) {
      std::vector<std::int64_t>& all = pulses[measured->source];
      for (std::int64_t i = 0; i < measured->samples; ++i) {
        if (measured->valid[static_cast<std::size_t>(i)] != 0) {
          all.push_back(measured->instantOf(i));
        }
      }
    }
    if (const auto found = sources.find(measured->source); found != sources.end()) {
      found->second.take(*measured);
    }
  });
  notes_ = log.remarks;
  const RecordedSource* best = nullptr;
  for (const auto& [name, source] : sources) {
    if (source.samples > 1 &&
        (best == nullptr || probesOf(*source.spec, place, system.stations.size()).size() >
                                probesOf(*best->spec, place, system.stations.size()).size())) {
      best = &source;
    }
  }
  const auto most = std::max_element(
      pulses.begin(), pulses.end(),
      [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  if (best == nullptr || most == pulses.end()) {
    return;
  }
  period_ = best->period();
  std::vector<const RecordedSource*> used;
  for (const SensorSpec& sensor : scene.scene.sensors) {
    const auto found = sources.find(sensor.name);
    if (found == sources.end()) {
      continue;
    }
    if (found->second.samples < 2) {
      notes_.push_back(fmt::format("the log has no samples of {}", sensor.name));
    } else if (which == ProbesRead::kAtSameInstants && !found->second.isAtInstantsOf(*best)) {
      notes_.push_back(
          fmt::format("{} is not used: its samples are not simultaneous with those of {}",
                      sensor.name, best->spec->name));
    } else {
      used.push_back(&found->second);
    }
  }
  for (const RecordedSource* source : used) {
    sources_.push_back({source->spec->name, {}, probes_.size()});
    for (RecordedProbe& probe : probesOf(*source->spec, place, system.stations.size())) {
      const auto said = source->deviation.find(probe.name);
      probe.deviation = said != source->deviation.end() && said->second > 0.0 ? said->second : 0.0;
      sources_.back().channels.push_back(probe.name);
      const auto found = source->wild.find(probe.name);
      if (used.size() > 1) {
        probe.name = source->spec->name + "/" + probe.name;
      }
      if (found != source->wild.end() && !found->second.instants.empty()) {
        notes_.push_back(source->wildNote(probe.name, found->second));
        for (const std::int64_t instant : found->second.instants) {
          wild_.emplace(probe.name, instant);
        }
      }
      probes_.push_back(std::move(probe));
    }
  }
  keyphasor_ = keyphasors[most->first];
  pulses_ = most->second;
  steady_speed_ = longestKeptSpeed(pulses_);
}

/// The whirl that a twin published, at each station that it published: x and y of each.
void RotorRecord::findWhirl(const RotorSystem& system) {
  std::map<std::string, std::int64_t> states;
  std::vector<std::pair<double, double>> dwells;
  std::map<std::string, std::pair<double, double>> times;  // first and last [s]
  eachMessage([&](const Message& message) {
    if (const auto* const whirl = std::get_if<state::WhirlState>(&message)) {
      if (++states[whirl->system] == 1) {
        times[whirl->system] = {whirl->at.time, whirl->at.time};
      }
      double& last = times[whirl->system].second;
      if (whirl->system == system.name && whirl->at.time > last && whirl->speed > 0.0 &&
          std::isfinite(whirl->speed)) {
        dwells.emplace_back(whirl->speed, whirl->at.time - last);
      }
      last = std::max(last, whirl->at.time);
    }
  });
  const std::int64_t count = states[system.name];
  if (count < 2) {
    return;
  }
  for (std::size_t k = 0; k < system.stations.size(); ++k) {
    const std::string name = k == 0 ? system.name : stationName(system.name, system.stations[k]);
    if (states[name] == count) {
      whirls_.push_back(name);
      probes_.push_back({system.stations[k].name + " x", k, 0.0});
      probes_.push_back({system.stations[k].name + " y", k, 0.5 * kPi});
    }
  }
  const auto [first, last] = times[system.name];
  period_ = (last - first) / static_cast<double>(count - 1);
  steady_speed_ = longestKeptSpeed(std::move(dwells));
}

RecordCounts RotorRecord::read(const std::function<void(const ProbeReading&)>& take) const {
  return whirls_.empty() ? readProbes(take) : readWhirl(take);
}

RecordCounts RotorRecord::readProbes(const std::function<void(const ProbeReading&)>& take) const {
  RecordCounts counts;
  RecordedShaft shaft(keyphasor_, pulses_);
  const auto newQueue = [&] {
    MeasuredQueue queue(kPatience);
    for (const ProbeSource& source : sources_) {
      queue.addSource(source.name, source.channels,
                      std::vector<std::string>(source.channels.size(), "m"));
    }
    return queue;
  };
  MeasuredQueue queue = newQueue();
  std::optional<std::int64_t> origin, row;
  std::int64_t newest = std::numeric_limits<std::int64_t>::min();
  const auto together = std::llround(kTogether * period_ / kNanosecond);
  ProbeReading reading;
  reading.values = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(probes_.size()), kNaN);
  std::vector<bool> there(probes_.size(), false);
  const auto finishRow = [&] {
    if (row) {
      const ShaftEstimate at = shaft.at(*row);
      if (at.known) {
        reading.time = static_cast<double>(*row - *origin) * kNanosecond;
        reading.index = std::llround(reading.time / period_);
        reading.turns = at.angle.turns;
        reading.remainder = at.angle.remainder;
        reading.speed = at.speed;
        for (std::size_t c = 0; c < there.size(); ++c) {
          counts.not_valid +=
              there[c] && std::isnan(reading.values[static_cast<Eigen::Index>(c)]) ? 1 : 0;
        }
        ++counts.samples;
        take(reading);
      } else {
        ++counts.no_angle;
      }
    }
    reading.values.setConstant(kNaN);
    there.assign(there.size(), false);
    row = std::nullopt;
  };
  const auto drain = [&] {
    while (const std::optional<MeasuredSample> sample = queue.next()) {
      const std::size_t probe = sources_[sample->source].first + sample->channel;
      if (row && (sample->time - *row > together || there[probe])) {
        finishRow();
      }
      if (!row && sample->time <= newest) {
        continue;
      }
      origin = origin.value_or(sample->time);
      row = row.value_or(sample->time);
      newest = std::max(newest, sample->time);
      there[probe] = true;
      const bool wild = !wild_.empty() && wild_.count({probes_[probe].name, sample->time}) > 0;
      reading.values[static_cast<Eigen::Index>(probe)] =
          sample->valid && !wild ? sample->value : kNaN;
    }
  };
  eachMessage([&](const Message& message) {
    const auto* const measured = std::get_if<state::Measurement>(&message);
    if (measured == nullptr) {
      return;
    }
    // Over a long gap the queue would take the clock for set, and lose what waits.
    if (origin && measured->instantOf(0) - newest > kClockJump / 2) {
      queue.finish();
      drain();
      queue = newQueue();
    }
    queue.take(*measured);
    drain();
  });
  queue.finish();
  drain();
  finishRow();
  counts.pulses = shaft.counts().taken;
  counts.false_pulses = shaft.counts().refused;
  counts.missing_pulses = shaft.counts().missed;
  counts.jitter = shaft.jitter();
  counts.stated = shaft.scattersAsStated();
  return counts;
}

RecordCounts RotorRecord::readWhirl(const std::function<void(const ProbeReading&)>& take) const {
  RecordCounts counts;
  ProbeReading reading;
  const auto stations = static_cast<Eigen::Index>(whirls_.size());
  reading.values = Eigen::VectorXd::Constant(2 * stations, kNaN);
  std::optional<double> time, origin;
  const auto finish = [&] {
    if (time) {
      counts.not_valid += reading.values.array().isNaN().count();
      ++counts.samples;
      take(reading);
    }
    reading.values.setConstant(kNaN);
  };
  eachMessage([&](const Message& message) {
    const auto* const whirl = std::get_if<state::WhirlState>(&message);
    if (whirl == nullptr) {
      return;
    }
    const auto found = std::find(whirls_.begin(), whirls_.end(), whirl->system);
    if (found == whirls_.end() || (time && whirl->at.time < *time)) {
      return;
    }
    if (!(std::fabs(whirl->shaft_angle) <= kMaxAngle) || !std::isfinite(whirl->speed)) {
      ++counts.no_angle;
      return;
    }
    if (!time || whirl->at.time > *time) {
      finish();
      time = whirl->at.time;
      origin = origin.value_or(*time);
      reading.time = *time - *origin;
      reading.index = std::llround(reading.time / period_);
      reading.turns = static_cast<std::int64_t>(std::floor(whirl->shaft_angle / kTwoPi));
      reading.remainder = whirl->shaft_angle - kTwoPi * static_cast<double>(reading.turns);
      reading.speed = whirl->speed;
    }
    const auto place = 2 * static_cast<Eigen::Index>(found - whirls_.begin());
    reading.values[place] = whirl->x;
    reading.values[place + 1] = whirl->y;
  });
  finish();
  return counts;
}

}  // namespace whirl_twin
