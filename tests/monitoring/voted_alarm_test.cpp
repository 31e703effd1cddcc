// 2 of 3: one source that lies raises nothing, one that fails hides nothing and clears nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "messages/alert.h"
#include "monitoring/alarm_settings_reader.h"
#include "monitoring/vibration_alarms.h"
#include "scene/scene_error.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace voted_alarm_test {

constexpr double kSilent = -1.0;  // no state at all
constexpr double kBroken = std::numeric_limits<double>::quiet_NaN();
constexpr double kCalm = 0.1e-3;  // m
constexpr double kWide = 0.8e-3;
constexpr double kTooWide = 2.0e-3;

constexpr char kThree[] = R"(
name: three
step: 0.001
systems:
  a: {model: jeffcott_rotor, parameters: {mass: 1.0, stiffness: 1.0e4, damping: 30.0, speed: 50.0}}
  b: {model: jeffcott_rotor, parameters: {mass: 1.0, stiffness: 1.0e4, damping: 30.0, speed: 50.0}}
  c: {model: jeffcott_rotor, parameters: {mass: 1.0, stiffness: 1.0e4, damping: 30.0, speed: 50.0}}
)";

/// Three rotors, of which two have to agree.
struct Voters {
  explicit Voters(int agree = 2) : monitor(build(sceneOf(kThree)), settings(agree)) {}
  static AlarmSettings settings(int agree) {
    AlarmSettings settings;
    Voting& voting = settings.voting["a"];
    voting.of = {"a", "b", "c"};
    voting.agree = agree;
    voting.alert = 0.5e-3;
    voting.danger = 1.0e-3;
    voting.range = 5.0e-3;
    return settings;
  }
  /// How wide each whirls [m], for a while [s].
  void tell(const std::vector<double>& radii, double duration) {
    const char* const names[] = {"a", "b", "c"};
    for (const double end = time + duration; time < end - 1.0e-9; time += 0.002) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (radii[i] != kSilent) {
          monitor.take(circularWhirl(names[i], time, radii[i], 50.0), time);
        }
      }
      monitor.tick(time, false);
    }
  }
  const state::Alert* alert() { return monitor.alerts().find("a", alert_type::kVotedAmplitude); }

  TwinMonitor monitor;
  double time = 0.0;  ///< [s], simulated and wall
};

TEST(VotedAlarm, OneOfThreeIsNotEnoughAndTwoAre) {
  Voters voters;
  voters.tell({kCalm, kTooWide, kCalm}, 5.0);
  EXPECT_EQ(voters.alert(), nullptr);
  voters.tell({kCalm, kTooWide, kWide}, 0.3);
  ASSERT_NE(voters.alert(), nullptr);
  EXPECT_EQ(voters.alert()->severity, state::Severity::kWarning) << "on danger they do not agree";
  EXPECT_NEAR(voters.alert()->amplitude, kWide, 0.002 * kWide) << "what two of them are above";
  EXPECT_EQ(voters.alert()->text.find("a: 2 of 3 sources above the alert level 0.5 mm (b "), 0u)
      << voters.alert()->text;
  voters.tell({kTooWide, kTooWide, kWide}, 0.3);
  EXPECT_EQ(voters.alert()->severity, state::Severity::kDanger);
  voters.tell({kCalm, kTooWide, kCalm}, 0.9);
  EXPECT_NE(voters.alert(), nullptr);
  voters.tell({kCalm, kTooWide, kCalm}, 0.4);
  EXPECT_EQ(voters.alert(), nullptr);
}

TEST(VotedAlarm, ASourceThatIsNotOkDoesNotVote) {
  Voters voters;
  voters.tell({kTooWide, kBroken, kCalm}, 5.0);
  EXPECT_EQ(voters.alert(), nullptr);
  EXPECT_EQ(voters.monitor.status(voters.time, false).not_ok.at(0), "not voting: b not finite: x");
  voters.tell({kTooWide, 9.0e-3, kCalm}, 5.0);  // beyond its range
  EXPECT_EQ(voters.alert(), nullptr);
  voters.tell({kTooWide, kSilent, kCalm}, 5.0);
  EXPECT_EQ(voters.alert(), nullptr);
  voters.tell({kTooWide, kBroken, kTooWide}, 0.3);
  ASSERT_NE(voters.alert(), nullptr) << "the two that are left agree";
  EXPECT_NE(voters.alert()->text.find("; bad data: b)"), std::string::npos) << voters.alert()->text;
}

TEST(VotedAlarm, ASourceThatFailsClearsNothing) {
  Voters voters;
  voters.tell({kTooWide, kTooWide, kCalm}, 0.3);
  ASSERT_NE(voters.alert(), nullptr);
  voters.tell({kTooWide, kBroken, kCalm}, 5.0);
  EXPECT_NE(voters.alert(), nullptr) << "b may be too wide still";
  voters.tell({kTooWide, kSilent, kCalm}, 5.0);
  EXPECT_NE(voters.alert(), nullptr);
  voters.tell({kCalm, kSilent, kCalm}, 1.2);
  EXPECT_EQ(voters.alert(), nullptr) << "b alone could not raise it";
}

TEST(VotedAlarm, AllOfThemOrAnyOfThemIfSoSet) {
  Voters all(3);
  all.tell({kTooWide, kTooWide, kCalm}, 5.0);
  EXPECT_EQ(all.alert(), nullptr);
  Voters any(1);
  any.tell({kCalm, kCalm, kWide}, 0.3);
  EXPECT_NE(any.alert(), nullptr);
}

TEST(VotedAlarm, ClearsWhenItsSettingIsTakenAway) {
  Voters voters;
  voters.tell({kTooWide, kTooWide, kTooWide}, 0.3);
  ASSERT_NE(voters.alert(), nullptr);
  voters.monitor.set(AlarmSettings());
  voters.tell({kTooWide, kTooWide, kTooWide}, 1.2);
  EXPECT_EQ(voters.alert(), nullptr);
  voters.monitor.set(Voters::settings(2));
  voters.tell({kTooWide, kTooWide, kTooWide}, 0.3);
  EXPECT_NE(voters.alert(), nullptr);
}

/// Stations of one shaft vote, which are no systems.
TEST(VotedAlarm, ListensToStationsOfAShaft) {
  const BuiltScene scene = build(sceneOf(kThree));
  AlarmSettings settings = Voters::settings(2);
  settings.voting["a"].of = {"a", "a_node_1", "a_node_5"};
  TwinMonitor monitor(scene, settings);
  for (double time = 0.0; time < 0.3; time += 0.002) {
    for (const char* name : {"a", "a_node_1", "a_node_5"}) {
      const double radius = name == std::string("a") ? kCalm : kWide;
      monitor.take(circularWhirl(name, time, radius, 50.0), time);
    }
  }
  EXPECT_NE(monitor.alerts().find("a", alert_type::kVotedAmplitude), nullptr);
}

std::vector<std::string> errorsOf(const std::string& text) {
  try {
    readAlarmSettings(YAML::Load(text), "monitor.yaml", {"rotor", "pump"}, {}, {"rotor_node_1"});
  } catch (const SceneError& error) {
    return error.errors();
  }
  return {};
}

TEST(VotedAlarm, ItsSettingsAreCheckedLikeAScene) {
  EXPECT_TRUE(errorsOf("voting: {rotor: {of: [rotor, rotor_node_1, pump], agree: 2, "
                       "alert: 1.0e-3, danger: 2.0e-3, range: 3.0e-3}}")
                  .empty());
  const std::vector<std::string> errors = errorsOf(R"(
voting:
  roter: {of: [rotor, pump], agree: 1, alert: 1.0e-3}
  rotor: {of: [rotor, rotor_nod_1, rotor], agree: 4, alert: 2.0e-3, danger: 1.0e-3, range: 1.0e-3}
  pump: {of: [rotor]}
)");
  const std::vector<std::string> expected{
      "voting.roter: unknown rotor of the scene; did you mean 'rotor'?",
      "voting.rotor.of[1]: must be a rotor of the scene or one of its stations, found "
      "'rotor_nod_1'; did you mean 'rotor_node_1'?",
      "voting.rotor.of[2]: duplicate: rotor is already in the list",
      "voting.rotor.agree: must be",
      "voting.rotor.danger: must be above alert, 0.002 m, found 0.001",
      "voting.rotor.range: must be above the levels, 0.001 m, found 0.001",
      "voting.pump.of: must be a list of two sources or more, found a list"};
  EXPECT_EQ(errors.size(), expected.size());
  for (std::size_t i = 0; i < errors.size() && i < expected.size(); ++i) {
    EXPECT_EQ(errors[i].find("monitor.yaml: " + expected[i]), 0u) << errors[i];
  }
}

}  // namespace voted_alarm_test
}  // namespace whirl_twin
