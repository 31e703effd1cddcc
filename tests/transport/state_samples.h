// States with all kinds of double values, and a bit-exact comparison of two of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "messages/message.h"

namespace whirl_twin {

/// All that a state holds, as bytes: equal bytes, equal states, NaN and the sign of zero included.
template <class State>
std::string bitsOf(State state) {
  std::string bits;
  const auto put = [&bits](const void* from, std::size_t size) {
    bits.append(static_cast<const char*>(from), size);
  };
  eachMember(state, [&](const char*, auto& field, Stays) {
    using Field = std::decay_t<decltype(field)>;
    if constexpr (std::is_same_v<Field, std::string>) {
      bits += field + '\n';
    } else if constexpr (std::is_same_v<Field, std::vector<std::string>>) {
      for (const auto& text : field) {
        bits += text + '\n';
      }
    } else if constexpr (std::is_arithmetic_v<Field> || std::is_enum_v<Field>) {
      put(&field, sizeof(field));
    } else {
      put(field.data(), field.size() * sizeof(field.front()));
    }
  });
  return bits;
}

class StateSamples {
 public:
  explicit StateSamples(unsigned seed) : random_(seed) {}

  state::WhirlState whirl() { return sample<state::WhirlState>(); }
  state::DriveState drive() { return sample<state::DriveState>(); }

  state::PendulumState pendulum() {
    auto s = sample<state::PendulumState>();
    s.angle = numbers(s.name.size());
    s.rate = numbers(s.name.size());
    return s;
  }

  state::MotorState motor() { return sample<state::MotorState>(); }

  state::EnsembleState ensemble() {
    auto s = sample<state::EnsembleState>();
    s.count = 1 + static_cast<std::int64_t>(below(std::uint64_t{1} << 62));
    s.running = static_cast<std::int64_t>(below(static_cast<std::uint64_t>(s.count) + 1));
    s.quantity.emplace_back("radius");
    s.unit.clear();
    for (std::size_t i = 0; i < s.quantity.size(); ++i) {
      s.unit.emplace_back(below(2) == 0 ? "m" : "rad");
    }
    eachMember(s, [&](const char*, auto& field, Stays) {
      if constexpr (std::is_same_v<std::decay_t<decltype(field)>, std::vector<double>>) {
        field = numbers(s.quantity.size());
      }
    });
    return s;
  }

  state::ControllerState controller() {
    auto s = sample<state::ControllerState>();
    s.signal_unit.assign(s.signal.size(), "rad/s");
    s.value = numbers(s.signal.size());
    s.input_unit.assign(s.input.size(), "N m");
    s.output = numbers(s.input.size());
    for (std::int64_t* const count : {&s.samples, &s.saturated, &s.missed, &s.age}) {
      *count = static_cast<std::int64_t>(below(std::uint64_t{1} << 62));
    }
    s.supervision = static_cast<state::Supervision>(below(5));
    return s;
  }

  state::ControllerMargins margins() {
    auto s = sample<state::ControllerMargins>();
    s.verdict = static_cast<std::uint8_t>(below(5));
    s.signal_peak = numbers(s.signal.size());
    s.signal_frequency = numbers(s.signal.size());
    return s;
  }

  state::ParameterChange change() {
    auto s = sample<state::ParameterChange>();
    s.names.emplace_back("bearings[0].kxx");
    s.changed.emplace_back("stiffness[0][1]");
    s.values = numbers(s.names.size());
    s.previous = numbers(s.changed.size());
    return s;
  }

  state::LoopStatistics loop() {
    auto s = sample<state::LoopStatistics>();
    const std::size_t systems = s.system.size();
    s.integrator.assign(systems, "exponential");
    s.error_estimate = numbers(systems);
    s.tolerance = numbers(systems);
    s.stopped.assign(systems, static_cast<std::uint8_t>(below(4)));
    s.stopped_why.assign(systems, "why");
    s.age_p50 = numbers(s.external.size());
    s.age_p99 = numbers(s.external.size());
    s.age_max = numbers(s.external.size());
    s.step_mean = numbers(s.timed.size());
    s.step_max = numbers(s.timed.size());
    s.long_steps = numbers(s.timed.size());
    s.started = static_cast<std::int64_t>(below(kMaxStamp));
    return s;
  }

  /// Every other one with an instant for each sample.
  state::Measurement measurement() {
    auto s = sample<state::Measurement>();
    s.channel = {"probe_x", "probe_y", "keyphasor"};
    s.channel.resize(1 + below(3));
    s.unit.assign(s.channel.size(), "m");
    s.deviation.assign(s.channel.size(), below(2) == 0 ? 1e-6 : std::nan(""));
    s.samples = 1 + static_cast<std::int64_t>(below(5));
    s.first_instant = static_cast<std::int64_t>(below(kMaxStamp / 2));
    s.period = below(2) == 0 ? 0 : 1 + static_cast<std::int64_t>(below(1000000));
    s.instant.clear();
    for (std::int64_t i = 0; s.period == 0 && i < s.samples; ++i) {
      s.instant.push_back(s.first_instant + i * 1000 +
                          static_cast<std::int64_t>(below(1000)) * (i == 0 ? 0 : 1));
    }
    s.value = numbers(static_cast<std::size_t>(s.samples) * s.channel.size());
    s.valid.clear();
    for (std::size_t i = 0; i < s.value.size(); ++i) {
      s.valid.push_back(static_cast<std::uint8_t>(below(2)));
    }
    return s;
  }

  state::InputCommand command() {
    auto s = sample<state::InputCommand>();
    s.value.assign(s.input.size(), 1e-3 * static_cast<double>(below(1000)) - 0.5);
    s.duration = 1e-3 * static_cast<double>(1 + below(1000000));
    return s;
  }

  state::AlarmCommand alarmCommand() {
    auto s = sample<state::AlarmCommand>();
    s.command = static_cast<std::uint8_t>(1 + below(3));
    s.duration = 1e-3 * static_cast<double>(below(3600001));
    return s;
  }

  state::StabilityMargin margin() {
    state::StabilityMargin s;
    s.critical_speeds.resize(below(4));
    fill(s);
    s.operating_point = numbers(s.coordinate.size());
    s.verdict = static_cast<std::uint8_t>(below(5));
    s.right = s.imaginary = s.left = s.right_by_eigenvalues = 0;
    s.members = static_cast<std::uint32_t>(below(100001));
    s.members_beyond = static_cast<std::uint32_t>(below(s.members + 1));
    if (!s.polynomial.empty()) {
      s.left = static_cast<std::uint32_t>(s.polynomial.size()) - 1;
    }
    for (auto& critical : s.critical_speeds) {
      critical.direction = below(2) == 0 ? "forward" : "backward";
    }
    return s;
  }

  state::MonitorStatus status() {
    auto s = sample<state::MonitorStatus>();
    s.alerts = static_cast<std::int64_t>(below(100));
    s.dangers = static_cast<std::int64_t>(below(100));
    s.verdict_age = numbers(s.system.size());
    s.not_ok.assign(s.system.size(), "no state for 2.0 s");
    s.inhibited = numbers(s.system.size());
    return s;
  }

  state::OrderState orders() {
    auto s = sample<state::OrderState>();
    for (auto* column : {&s.forward_amplitude, &s.forward_lag, &s.backward_amplitude,
                         &s.backward_lag, &s.deviation}) {
      *column = numbers(s.order.size());
    }
    for (auto* column : {&s.line_ratio, &s.line_forward, &s.line_backward, &s.line_growth}) {
      *column = numbers(s.line_frequency.size());
    }
    return s;
  }

  state::FollowState follow() {
    auto s = sample<state::FollowState>();
    s.parameter.emplace_back("bearings[0].kxx");
    s.parameter_unit.assign(s.parameter.size(), "N/m");
    s.value = numbers(s.parameter.size());
    s.deviation.assign(s.parameter.size(), below(2) == 0 ? 1e3 : std::nan(""));
    s.channel = {"probes/probe_x", "probes/probe_y", "torque/torque"};
    s.channel.resize(below(4));
    s.channel_unit.assign(s.channel.size(), "m");
    s.residual = numbers(s.channel.size());
    s.residual_deviation.assign(s.channel.size(), std::numeric_limits<double>::infinity());
    s.offset = numbers(s.channel.size());
    s.channel_status.assign(s.channel.size(), static_cast<std::uint8_t>(below(4)));
    for (double* limit :
         {&s.mismatch, &s.mismatch_least, &s.mismatch_limit, &s.whiteness_limit, &s.drift,
          &s.drift_limit, &s.clock_offset_deviation, &s.shaft_angle_deviation}) {
      *limit = std::fabs(*limit);
    }
    s.drift_parameter = below(2) == 0 ? s.parameter.back() : "";
    s.force_x = numbers(s.bearing.size());
    s.force_y = numbers(s.bearing.size());
    s.force_deviation.assign(s.bearing.size(), 0.5);
    for (std::int64_t* count : {&s.used, &s.late, &s.lost, &s.repeated, &s.invalid, &s.refused}) {
      *count = static_cast<std::int64_t>(below(std::uint64_t{1} << 62));
    }
    return s;
  }

  state::Alert alert() {
    auto s = sample<state::Alert>();
    s.severity = static_cast<state::Severity>(below(3));
    s.raised_time = time();
    s.time = time();
    s.text = "Drehzahl nahe \xce\xa9\xe2\x82\x81: 95 rad/s";
    return s;
  }

  /// visit(sample) with one of every kind, so that none can be omitted.
  template <class Visit>
  void each(Visit&& visit) {
    eachKind([&](auto kind) { visit(of(kind)); });
  }

  /// Any 64 bits, often the values most easily lost.
  double number() {
    static const double kDelicate[] = {-0.0,
                                       0.0,
                                       5e-324,
                                       -2.2e-308,
                                       std::numeric_limits<double>::infinity(),
                                       -std::numeric_limits<double>::infinity(),
                                       std::numeric_limits<double>::quiet_NaN(),
                                       -std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::max()};
    if (below(2) == 0) {
      return kDelicate[below(std::size(kDelicate))];
    }
    const std::uint64_t bits = random_();
    double number = 0.0;
    std::memcpy(&number, &bits, sizeof(number));
    return number;
  }

  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }

 private:
  auto of(KindOf<state::WhirlState>) { return whirl(); }
  auto of(KindOf<state::PendulumState>) { return pendulum(); }
  auto of(KindOf<state::DriveState>) { return drive(); }
  auto of(KindOf<state::MotorState>) { return motor(); }
  auto of(KindOf<state::EnsembleState>) { return ensemble(); }
  auto of(KindOf<state::StabilityMargin>) { return margin(); }
  auto of(KindOf<state::ParameterChange>) { return change(); }
  auto of(KindOf<state::LoopStatistics>) { return loop(); }
  auto of(KindOf<state::Measurement>) { return measurement(); }
  auto of(KindOf<state::InputCommand>) { return command(); }
  auto of(KindOf<state::AlarmCommand>) { return alarmCommand(); }
  auto of(KindOf<state::Alert>) { return alert(); }
  auto of(KindOf<state::MonitorStatus>) { return status(); }
  auto of(KindOf<state::OrderState>) { return orders(); }
  auto of(KindOf<state::FollowState>) { return follow(); }
  auto of(KindOf<state::ControllerState>) { return controller(); }
  auto of(KindOf<state::ControllerMargins>) { return margins(); }
  auto of(KindOf<state::ControllerMeasurement>) {
    return exchanged<state::ControllerMeasurement>();
  }
  auto of(KindOf<state::SceneText>) { return sample<state::SceneText>(); }
  auto of(KindOf<state::ControllerCommand>) { return exchanged<state::ControllerCommand>(); }

  template <class State>
  State exchanged() {
    auto s = sample<State>();
    s.run = static_cast<std::int64_t>(below(1000));
    return s;
  }

  double time() { return static_cast<double>(below(1000000000)) * 1e-3; }

  std::vector<double> numbers(std::size_t count) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i) {
      numbers.push_back(number());
    }
    return numbers;
  }

  template <class State>
  State sample() {
    State s;
    fill(s);
    return s;
  }

  void put(bool& field) { field = below(2) == 0; }
  void put(double& field) { field = number(); }
  void put(std::int64_t& field) { field = static_cast<std::int64_t>(random_()); }
  void put(std::uint64_t& field) { field = random_() >> 1; }  // the maximum that LCM can represent
  void put(std::int32_t& field) { field = static_cast<std::int32_t>(random_()); }
  void put(std::uint32_t& field) { field = static_cast<std::uint32_t>(random_()); }
  void put(std::string& field) { field = "name_" + std::to_string(below(1000)); }
  void put(std::vector<double>& field) { field = numbers(below(6)); }
  void put(std::vector<std::string>& field) {
    field.resize(below(4));
    for (auto& text : field) {
      put(text);
    }
  }
  template <class Other>
  void put(Other&) {}

  void put(state::Instant& at) {
    at.step = static_cast<std::int64_t>(below(std::uint64_t{1} << 62));
    at.time = time();
    at.stamp = static_cast<std::int64_t>(below(kMaxStamp));
  }

  template <class State>
  void fill(State& s) {
    eachMember(s, [this](const char*, auto& field, Stays) { put(field); });
    if constexpr (std::is_same_v<State, state::Alert>) {
      s.stamp = static_cast<std::int64_t>(below(kMaxStamp));
    } else {
      put(s.at);
    }
  }

  std::mt19937_64 random_;
};

}  // namespace whirl_twin
