// The monitor on what sensors measure: probes and a keyphasor of a twin that runs as fast as it
// can, with or without the twin's own states beside them.
#include "monitoring/measured_signal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "messages/alert.h"
#include "twin/measurements.h"
#include "twin/order_observer.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace measured_signal_test {

// 1X of 2e-5 * 2.25 / 1.25 = 36 um at 150 rad/s; its critical speed is 100 rad/s.
constexpr const char* kMeasured = R"(
name: measured
step: 0.0005
drives:
  shaft: {speed: 150.0}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 40.0, eccentricity: 2.0e-5, phase_mark: 0.4}
    initial: {x: -3.4e-5, y_rate: -5.1e-3}
sensors:
  probes:
    rate: 2000.0
    channels:
      left: {measures: rotor, direction: 2.356194490192345, noise: 2.0e-7, run_out: 1.0e-5, run_out_angle: 1.2}
      right: {measures: rotor, direction: 0.785398163397448, noise: 2.0e-7, run_out: 1.0e-5, run_out_angle: 1.2}
  tacho: {keyphasor: shaft, mark: 2.0, jitter: 1.0e-6}
)";

/// A machine of which the monitor knows what its sensors tell, and the twin's states if asked for.
struct MeasuredMachine {
  explicit MeasuredMachine(const std::string& scene, const AlarmSettings& settings = {})
      : watched(sceneOf(scene), settings),
        sensors(watched.twin.scene().sensors, build(watched.twin.scene()), observed()),
        orders(watched.twin) {}

  const Observer& observed() {
    watched.twin.write(watched.record.data());
    watched.observer.observe(watched.record.data());
    return watched.observer;
  }
  void run(double duration) {
    const double step = watched.twin.scene().stepSeconds();
    for (auto i = std::llround(duration / step); i > 0; --i) {
      watched.twin.step();
      if (states) {
        watched.feed();
      } else {
        observed();
        watched.wall += step;
      }
      orders.take(watched.record.data(), watched.observer);
      for (state::Measurement& block : sensors.observe(watched.observer)) {
        if (spoil(block)) {
          monitor().take(block, watched.wall);
        }
      }
      for (const state::OrderState& now : monitor().takeOrders()) {
        published = now;
      }
      if (i % 100 == 0) {
        monitor().tick(watched.wall, false);
      }
    }
  }
  state::OrderState trueOrders() const {
    state::OrderState truth;
    orders.tell(watched.observer, {0}, [&](const std::string&, auto make) { truth = make(); });
    return truth;
  }
  TwinMonitor& monitor() { return watched.monitor; }
  const state::Alert* alert(const char* type) { return monitor().alerts().find("rotor", type); }
  std::string notOk() { return monitor().notOk(watched.wall, false).front(); }

  WatchedTwin watched;
  Measurements sensors;
  OrderObserver orders;
  bool states = false;
  std::function<bool(state::Measurement&)> spoil = [](state::Measurement&) { return true; };
  state::OrderState published;  ///< last, of what was measured
};

AlarmSettings withZones(double b, double c) {
  AlarmSettings settings;
  settings.zones["rotor"] = {0.5 * b, b, c};
  return settings;
}

TEST(MeasuredSignal, IsToldByTheScenesSensors) {
  const auto orbit = measuredOrbitOf(build(sceneOf(kMeasured)), 0);
  ASSERT_TRUE(orbit);
  EXPECT_EQ(orbit->probes[0].channel, "left");
  EXPECT_EQ(orbit->probes[1].channel, "right");
  EXPECT_EQ(orbit->keyphasor, "tacho");
  EXPECT_NEAR(orbit->shaft.mark, 2.4, 1e-12);  // from the phase mark
  std::string without = kMeasured;
  without.erase(without.find("  tacho"));
  EXPECT_FALSE(measuredOrbitOf(build(sceneOf(without)), 0)) << "no keyphasor";
  std::string alike = kMeasured;
  alike.replace(alike.find("direction: 0.785398163397448"), 28, "direction: 2.356194490192345");
  EXPECT_FALSE(measuredOrbitOf(build(sceneOf(alike)), 0)) << "must not be parallel";
}

TEST(MeasuredSignal, OrdersAndAlarmsComeWithoutATwin) {
  AlarmSettings settings = withZones(50e-6, 300e-6);
  settings.slow_roll["rotor"].given.forward = std::polar(1.0e-5, 1.2 - 0.4);
  MeasuredMachine machine(kMeasured, settings);
  machine.run(3.0);
  const state::OrderState truth = machine.trueOrders();
  ASSERT_TRUE(machine.published.valid);
  EXPECT_EQ(machine.published.system, "rotor_measured");
  EXPECT_NEAR(machine.published.speed, 150.0, 1e-2);
  EXPECT_NEAR(machine.published.forward_amplitude[0], truth.forward_amplitude[0], 1e-7);
  EXPECT_NEAR(std::remainder(machine.published.forward_lag[0] - truth.forward_lag[0], 6.283185307),
              0.0, 5e-3);
  ASSERT_NE(machine.alert(alert_type::kVibrationZone), nullptr);
  EXPECT_EQ(machine.alert(alert_type::kVibrationZone)->severity, state::Severity::kWarning);
  EXPECT_EQ(machine.notOk(), "");
  EXPECT_EQ(machine.monitor().alerts().find("rotor", alert_type::kDataLost), nullptr);
  // The model is judged at the measured speed.
  const auto margins = machine.monitor().takeMargins();
  ASSERT_FALSE(margins.empty());
  EXPECT_NEAR(margins.back().speed, 150.0, 1e-2);
  EXPECT_EQ(margins.back().verdict_name, "asymptotically_stable");
}

TEST(MeasuredSignal, AlarmsActOnItAndNotOnTheTwinBesideIt) {
  // The probes of the machine show twice what the twin believes.
  MeasuredMachine machine(kMeasured, withZones(100e-6, 300e-6));
  machine.states = true;
  machine.run(2.0);
  EXPECT_EQ(machine.alert(alert_type::kVibrationZone), nullptr);
  machine.spoil = [](state::Measurement& block) {
    for (std::size_t i = 0; block.source == "probes" && i < block.value.size(); ++i) {
      block.value[i] *= 2.0;
    }
    return true;
  };
  machine.run(2.0);
  EXPECT_NE(machine.alert(alert_type::kVibrationZone), nullptr);
  EXPECT_EQ(machine.notOk(), "");
}

TEST(MeasuredSignal, SlowRollIsLearntAtSlowSpeedAndTakenOff) {
  std::string run_up = kMeasured;
  run_up.replace(run_up.find("speed: 150.0"), 12,
                 "speed: 20.0, profile: [{speed: 20.0, max_acceleration: 1.0, dwell: 6.0}, "
                 "{speed: 150.0, max_acceleration: 40.0}]");
  run_up.erase(run_up.find("    initial"), run_up.find("sensors:") - run_up.find("    initial"));
  for (const bool learn : {false, true}) {
    AlarmSettings settings;
    if (learn) {
      settings.slow_roll["rotor"].below = 30.0;
    }
    MeasuredMachine machine(run_up, settings);
    machine.run(14.0);
    const state::OrderState truth = machine.trueOrders();
    ASSERT_TRUE(machine.published.valid);
    const auto of = [](const state::OrderState& orders) {
      return std::polar(orders.forward_amplitude[0], -orders.forward_lag[0]);
    };
    // At 20 rad/s 0.8 um of unbalance belong to it.
    const double off = std::abs(of(machine.published) - of(truth));
    EXPECT_NEAR(off, learn ? 0.0 : 1.0e-5, 1.0e-6);
    ASSERT_EQ(machine.monitor().slowRoll("rotor").has_value(), learn);
    if (learn) {
      EXPECT_NEAR(
          std::abs(machine.monitor().slowRoll("rotor")->forward - std::polar(1.0e-5, 1.2 - 0.4)),
          0.0, 1.0e-6);
    }
  }
}

TEST(MeasuredSignal, WhatIsNotOkRaisesAndClearsNothing) {
  struct Fault {
    const char* why;
    std::function<bool(state::Measurement&)> spoil;
  };
  const auto of_left = [](auto change) {
    return [change](state::Measurement& block) {
      for (std::size_t i = 0; block.source == "probes" && i < block.value.size(); i += 2) {
        change(block, i);
      }
      return true;
    };
  };
  const std::vector<Fault> faults = {
      {"invalid: probes/left",
       of_left([](state::Measurement& block, std::size_t i) { block.valid[i] = i % 40 != 0; })},
      {"not finite: probes/left", of_left([](state::Measurement& block, std::size_t i) {
         block.value[i] = i % 40 == 0 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
       })},
      {"stuck: probes/left",
       of_left([](state::Measurement& block, std::size_t i) { block.value[i] = 1.0e-6; })},
      {"timeout: no sample of probes/left for",
       [](state::Measurement& block) { return block.source != "probes"; }},
      {"out of range: measured whirl", of_left([](state::Measurement& block, std::size_t i) {
         block.value[i] = 1.0e-3;
         block.value[i] += 1.0e-6 * static_cast<double>(i % 7);
       })}};
  for (const Fault& fault : faults) {
    AlarmSettings settings = withZones(50e-6, 3.0e-3);
    settings.amplitude["rotor"].range = 0.5e-3;
    MeasuredMachine machine(kMeasured, settings);
    machine.run(1.5);
    ASSERT_NE(machine.alert(alert_type::kVibrationZone), nullptr);
    EXPECT_EQ(machine.notOk(), "");
    machine.spoil = fault.spoil;
    machine.run(3.0);
    EXPECT_EQ(machine.notOk().find(fault.why), 0u) << fault.why << ": " << machine.notOk();
    EXPECT_NE(machine.alert(alert_type::kVibrationZone), nullptr) << fault.why;
    EXPECT_EQ(machine.alert(alert_type::kVibrationZone)->severity, state::Severity::kWarning);
  }
}

TEST(MeasuredSignal, WithoutPulsesVibrationIsJudgedOn) {
  MeasuredMachine machine(kMeasured, withZones(150e-6, 300e-6));
  machine.run(1.5);
  machine.spoil = [](state::Measurement& block) { return block.source != "tacho"; };
  machine.run(4.0);
  EXPECT_EQ(machine.notOk().find("timeout: no pulse of tacho for"), 0u) << machine.notOk();
  EXPECT_FALSE(machine.published.valid);
  EXPECT_EQ(machine.alert(alert_type::kVibrationZone), nullptr);
  machine.spoil = [](state::Measurement& block) {
    for (std::size_t i = 0; block.source == "probes" && i < block.value.size(); ++i) {
      block.value[i] *= 4.0;
    }
    return block.source != "tacho";
  };
  machine.run(2.0);
  EXPECT_NE(machine.alert(alert_type::kVibrationZone), nullptr);
}

// A pick-up that sees anything but the mark, from the start or later on: instants at random.
TEST(MeasuredSignal, PulsesThatAgreeOnNoShaftAreReported) {
  for (const double before : {0.0, 1.5}) {
    MeasuredMachine machine(kMeasured, withZones(150e-6, 300e-6));
    machine.run(before);
    std::mt19937_64 random(3);
    std::exponential_distribution<double> wait(30.0);
    std::int64_t last = std::llround(1.0e9 * before);
    machine.spoil = [&](state::Measurement& block) {
      for (std::int64_t& instant : block.instant) {
        last += std::llround(1.0e9 * wait(random)) + 1;
        instant = last;
      }
      return true;
    };
    machine.run(3.0);
    EXPECT_EQ(machine.notOk().find("pulses rejected: "), 0u) << before << ": " << machine.notOk();
    EXPECT_EQ(machine.alert(alert_type::kVibrationZone), nullptr);
  }
}

}  // namespace measured_signal_test
}  // namespace whirl_twin
