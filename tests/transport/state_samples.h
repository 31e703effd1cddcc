// States full of everything a double can be, and a way to see whether two of them agree bit for
// bit.
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "messages/alert.h"
#include "messages/message_check.h"
#include "messages/stability_margin.h"
#include "messages/states.h"

namespace whirl_twin {

// Calls visit(field) for every field of a state, so that none can be forgotten in a comparison.

template <class Visit>
void eachField(state::Instant& at, Visit&& visit) {
  visit(at.step), visit(at.time), visit(at.stamp);
}

template <class Visit>
void eachField(state::WhirlState& s, Visit&& visit) {
  eachField(s.at, visit);
  visit(s.system), visit(s.radius), visit(s.phase), visit(s.phase_valid), visit(s.whirl_angle);
  visit(s.whirl_rate), visit(s.speed), visit(s.shaft_angle), visit(s.x), visit(s.y);
  visit(s.x_rate), visit(s.y_rate), visit(s.orbit_major), visit(s.orbit_minor);
  visit(s.forward), visit(s.energy_residual);
}

template <class Visit>
void eachField(state::PendulumState& s, Visit&& visit) {
  eachField(s.at, visit);
  visit(s.system), visit(s.name), visit(s.angle), visit(s.rate), visit(s.kinetic);
  visit(s.potential), visit(s.energy_residual);
}

template <class Visit>
void eachField(state::DriveState& s, Visit&& visit) {
  eachField(s.at, visit);
  visit(s.drive), visit(s.speed), visit(s.acceleration), visit(s.jerk), visit(s.target_speed);
  visit(s.turns), visit(s.remainder), visit(s.shaft_angle);
}

template <class Visit>
void eachField(state::MotorState& s, Visit&& visit) {
  eachField(s.at, visit);
  visit(s.drive), visit(s.system), visit(s.speed), visit(s.acceleration), visit(s.torque);
  visit(s.motor_power), visit(s.drag_power), visit(s.dissipated_power), visit(s.energy);
  visit(s.motor_work), visit(s.dissipated_work);
}

template <class Visit>
void eachField(state::EnsembleState& s, Visit&& visit) {
  eachField(s.at, visit);
  visit(s.system), visit(s.count), visit(s.running), visit(s.quantity), visit(s.unit);
  visit(s.mean), visit(s.standard_deviation), visit(s.smallest), visit(s.percentile_5);
  visit(s.percentile_25), visit(s.median), visit(s.percentile_75), visit(s.percentile_95);
  visit(s.largest), visit(s.peak_mean), visit(s.peak_standard_deviation);
  visit(s.peak_percentile_5), visit(s.peak_median), visit(s.peak_percentile_95);
  visit(s.peak_largest);
}

template <class Visit>
void eachField(state::ParameterChange& s, Visit&& visit) {
  eachField(s.at, visit);
  visit(s.system), visit(s.names), visit(s.values), visit(s.changed), visit(s.previous);
}

template <class Visit>
void eachField(state::StabilityMargin& s, Visit&& visit) {
  eachField(s.at, visit);
  visit(s.system), visit(s.model), visit(s.verdict), visit(s.verdict_name), visit(s.coordinate);
  visit(s.operating_point), visit(s.speed), visit(s.polynomial), visit(s.first_column);
  visit(s.right), visit(s.imaginary), visit(s.left), visit(s.decay_rate), visit(s.damping_ratio);
  visit(s.log_decrement), visit(s.instability_speed);
  for (auto& c : s.critical_speeds) {
    visit(c.speed), visit(c.direction), visit(c.amplification_factor), visit(c.separation_margin);
    visit(c.required_separation_margin), visit(c.band_low), visit(c.band_high);
  }
}

template <class Visit>
void eachField(state::Alert& s, Visit&& visit) {
  visit(s.id), visit(s.type), visit(s.system), visit(s.severity), visit(s.raised);
  visit(s.raised_time), visit(s.time), visit(s.stamp), visit(s.speed), visit(s.acceleration);
  visit(s.critical_speed), visit(s.time_to_entry), visit(s.separation_margin);
  visit(s.required_separation_margin), visit(s.amplification_factor), visit(s.decay_rate);
  visit(s.text);
}

/// All that a state holds, as bytes: equal bytes, equal states, NaN and the sign of zero included.
template <class State>
std::string bitsOf(State state) {
  std::string bits;
  const auto put = [&bits](const void* from, std::size_t size) {
    bits.append(static_cast<const char*>(from), size);
  };
  eachField(state, [&](auto& field) {
    using Field = std::decay_t<decltype(field)>;
    if constexpr (std::is_same_v<Field, std::string>) {
      bits += field + '\n';
    } else if constexpr (std::is_same_v<Field, std::vector<std::string>>) {
      for (const auto& text : field) {
        bits += text + '\n';
      }
    } else if constexpr (std::is_same_v<Field, std::vector<double>>) {
      put(field.data(), field.size() * sizeof(double));
    } else {
      put(&field, sizeof(field));
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
    eachField(s, [&](auto& field) {
      if constexpr (std::is_same_v<std::decay_t<decltype(field)>, std::vector<double>>) {
        field = numbers(s.quantity.size());
      }
    });
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

  state::StabilityMargin margin() {
    state::StabilityMargin s;
    s.critical_speeds.resize(below(4));
    fill(s);
    s.operating_point = numbers(s.coordinate.size());
    s.verdict = static_cast<std::uint8_t>(below(5));
    s.right = s.imaginary = s.left = 0;
    if (!s.polynomial.empty()) {
      s.left = static_cast<std::uint32_t>(s.polynomial.size()) - 1;
    }
    for (auto& critical : s.critical_speeds) {
      critical.direction = below(2) == 0 ? "forward" : "backward";
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

  /// Any 64 bits, and often those that get lost most easily.
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
    eachField(s, [this](auto& field) { put(field); });
    if constexpr (std::is_same_v<State, state::Alert>) {
      s.stamp = static_cast<std::int64_t>(below(kMaxStamp));
    } else {
      put(s.at);
    }
  }

  std::mt19937_64 random_;
};

}  // namespace whirl_twin
