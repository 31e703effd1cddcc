// The model's decay rate beside that of the ambient vibration.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "messages/alert.h"
#include "monitoring/model_alarms.h"

namespace whirl_twin {
namespace decay_alarm_test {

using Complex = std::complex<double>;

/// An isotropic rotor at 120 rad/s that noise excites, at 100 rad/s and with a decay rate [1/s].
struct NoisyRotor {
  explicit NoisyRotor(unsigned seed) : random(seed) {}

  state::WhirlState next(double decay_rate) {
    ++step;
    vibration = std::exp(Complex(-decay_rate, 100.0) * 1e-3) * vibration +
                1e-6 * Complex(normal(random), normal(random));
    state::WhirlState s;
    s.system = "rotor";
    s.at.step = step;
    s.at.time = 1e-3 * static_cast<double>(step);
    s.speed = 120.0;
    s.shaft_angle = 120.0 * s.at.time;
    const Complex z = vibration + std::polar(5e-5, s.shaft_angle) + Complex(0.0, -1e-4) +
                      1e-6 * Complex(normal(random), normal(random));
    s.x = z.real();
    s.y = z.imag();
    return s;
  }

  std::mt19937_64 random;
  std::normal_distribution<double> normal;
  Complex vibration;
  std::int64_t step = 0;
};

struct Watched {
  explicit Watched(double record, unsigned seed = 1)
      : alarm("rotor", settings(record)), rotor(seed) {}

  static AlarmSettings settings(double record) {
    AlarmSettings s;
    s.decay_audit = record;
    return s;
  }
  void model(double decay_rate, std::uint8_t verdict = 0) {
    state::StabilityMargin margin;
    margin.verdict = verdict;
    margin.decay_rate = decay_rate;
    alarm.update(margin);
  }
  void run(double duration, double decay_rate) {
    for (int i = 0; i < 1000.0 * duration; ++i) {
      alarm.update(rotor.next(decay_rate), alerts);
    }
  }
  const state::Alert* alert() const { return alerts.find("rotor", alert_type::kModelMismatch); }

  DecayAlarm alarm;
  AlertList alerts;
  NoisyRotor rotor;
};

TEST(DecayAlarm, IsRaisedWhereTheMachineDecaysSlowerThanItsModelAndClears) {
  Watched watched(40.0);
  watched.model(6.0);
  watched.run(60.0, 1.0);
  ASSERT_NE(watched.alert(), nullptr);
  EXPECT_EQ(watched.alert()->severity, state::Severity::kWarning);
  EXPECT_NEAR(watched.alert()->decay_rate, 1.0, 0.6);
  EXPECT_NE(watched.alert()->text.find("closer to instability"), std::string::npos)
      << watched.alert()->text;
  watched.model(1.0);
  watched.run(60.0, 1.0);
  EXPECT_EQ(watched.alert(), nullptr);
}

TEST(DecayAlarm, AnHourOfNoiseRaisesNothingWhereTheModelIsRight) {
  Watched watched(30.0);
  watched.model(2.0);
  watched.run(3600.0, 2.0);
  EXPECT_EQ(watched.alert(), nullptr) << watched.alert()->text;
}

TEST(DecayAlarm, IsOffUnlessARecordIsSetAndSaysNothingOfAnUnstableModel) {
  Watched off(0.0);
  off.model(6.0);
  off.run(60.0, 1.0);
  EXPECT_EQ(off.alert(), nullptr);
  Watched unstable(40.0);
  unstable.model(-6.0, 3);
  unstable.run(60.0, 1.0);
  EXPECT_EQ(unstable.alert(), nullptr);
}

TEST(DecayAlarm, OneStateInFiveIsEnough) {
  Watched watched(40.0);
  watched.model(6.0);
  for (int i = 0; i < 60000; ++i) {
    const state::WhirlState whirl = watched.rotor.next(1.0);
    if (whirl.at.step % 5 == 0) {
      watched.alarm.update(whirl, watched.alerts);
    }
  }
  EXPECT_NE(watched.alert(), nullptr);
}

}  // namespace decay_alarm_test
}  // namespace whirl_twin
