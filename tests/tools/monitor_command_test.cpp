// `twin monitor`: a log replayed through the monitor.
#include <gtest/gtest.h>

#include "twin_program.h"

namespace whirl_twin {
namespace monitor_command_test {

using Json = nlohmann::json;

/// m 2, k 7200, c 12: critical speed 60.15 rad/s, to be avoided from 48.13 to 70.74 rad/s.
constexpr const char* kRunUp = R"(name: run_up
step: 0.001
drives:
  shaft: {speed: 30.0, profile: [{speed: 90.0, max_acceleration: 5.0}]}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4}
)";

class RunUpLog : public testing::Test {
 protected:
  RunUpLog() {
    const Ending end =
        twin({"simulate", scene_, "--duration", "12", "--sample", "0.002", "--output", log_});
    EXPECT_EQ(end.status, 0) << end.err;
  }
  static Json alertOf(const Json& run, const std::string& type) {
    Json found;
    for (const Json& alert : run["alerts"]) {
      if (alert["type"] == type) {
        EXPECT_TRUE(found.is_null()) << type << " is raised twice";
        found = alert;
      }
    }
    return found;
  }

  const TemporaryDirectory directory_;
  const std::string scene_ = directory_.write("run_up.yaml", kRunUp);
  const std::string log_ = directory_.file("run_up.lcmlog");
};

TEST_F(RunUpLog, TheBandIsAnnouncedEnteredAndLeft) {
  const Ending end = twin({"monitor", scene_, log_, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json run = end.json();
  EXPECT_EQ(run["begin"], 0.0);
  EXPECT_EQ(run["end"], 12.0);
  EXPECT_NEAR(run["duration"].get<double>(), 12.0, 1e-6);
  EXPECT_EQ(run["rejected"], 0);
  EXPECT_EQ(run["damaged"], 0);
  // 5 rad/s^2 from 30 rad/s on: in the band from 3.626 to 8.148 s, announced two seconds before.
  const Json approach = alertOf(run, "CRITICAL_SPEED_APPROACH");
  ASSERT_FALSE(approach.is_null());
  EXPECT_NEAR(approach["raised"].get<double>(), 1.626, 0.01);
  const Json in_band = alertOf(run, "IN_CRITICAL_BAND");
  ASSERT_FALSE(in_band.is_null());
  EXPECT_NEAR(in_band["raised"].get<double>(), 3.626, 0.01);
  EXPECT_EQ(in_band["severity"], "warning") << "a passage is no danger";
  EXPECT_GT(in_band["cleared"].get<double>(), 8.148 + 0.9);
  EXPECT_LT(in_band["cleared"].get<double>(), 8.148 + 1.5);
  const Json& rotor = run["systems"]["rotor"];
  EXPECT_EQ(rotor["states"], 6001);
  // Ten a second, and where the speed has changed by a hundredth: below 50 rad/s that takes less.
  EXPECT_GT(rotor["verdicts"].get<double>(), 118);
  EXPECT_LT(rotor["verdicts"].get<double>(), 170);
  EXPECT_NEAR(rotor["least_decay_rate"].get<double>(), 12.0 / (2.0 * 2.0), 1e-9);
}

/// Its parameters, published again every ten seconds, carry the time of their last change.
TEST_F(RunUpLog, NoSilenceIsHeardWhereNoneIs) {
  EXPECT_TRUE(alertOf(twin({"monitor", scene_, log_, "--json"}).json(), "DATA_LOST").is_null());
}

TEST_F(RunUpLog, DamageIsCountedAndChangesNoAlert) {
  std::string bytes = contentsOf(log_);
  const Json whole = twin({"monitor", scene_, log_, "--json"}).json();
  bytes.replace(bytes.size() / 2, 5000, std::string(5000, '\x5a'));
  const std::string garbled = directory_.write("garbled.lcmlog", bytes);
  const Ending end = twin({"monitor", scene_, garbled, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json run = end.json();
  EXPECT_GT(run["damaged"].get<int>(), 0);
  EXPECT_LT(run["messages"], whole["messages"]);
  ASSERT_EQ(run["alerts"].size(), whole["alerts"].size());
  for (std::size_t i = 0; i < run["alerts"].size(); ++i) {
    EXPECT_EQ(run["alerts"][i]["type"], whole["alerts"][i]["type"]);
    EXPECT_EQ(run["alerts"][i]["raised"], whole["alerts"][i]["raised"]);
  }
}

TEST_F(RunUpLog, ThePageHoldsItsPicturesAndStandsAlone) {
  const std::string page = directory_.file("run_up.html");
  const Ending end = twin({"monitor", scene_, log_, "--output", page});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_NE(end.out.find("IN_CRITICAL_BAND"), std::string::npos) << end.out;
  const std::string html = contentsOf(page);
  EXPECT_NE(html.find("<svg"), std::string::npos);
  EXPECT_NE(html.find("IN_CRITICAL_BAND"), std::string::npos);
  EXPECT_NE(html.find("vibration about the mean"), std::string::npos);
  EXPECT_EQ(html.find("src="), std::string::npos) << "a page that needs another file";
  EXPECT_EQ(html.substr(html.size() - 8), "</html>\n");
}

/// Damping ratio 0.05: the peak of 1X at 60.15 rad/s, amplification factor 9.90; 5 rad/s^2 is just
/// slow enough for them, 0.15 (N2 - N1)^2 = 5.5.
TEST_F(RunUpLog, TellsTheResonanceThatWasPassedBesideTheModels) {
  const Ending end = twin({"monitor", scene_, log_, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json resonances = end.json()["systems"]["rotor"]["resonances"];
  ASSERT_EQ(resonances.size(), 1u) << resonances.dump();
  const Json& passed = resonances[0];
  // The whirl responds late, by some 1/3 s, the time constant of its decay.
  EXPECT_GT(passed["speed"].get<double>(), 60.15);
  EXPECT_LT(passed["speed"].get<double>(), 60.15 + 2.0 * 5.0 / 3.0);
  EXPECT_NEAR(passed["time"].get<double>(), (passed["speed"].get<double>() - 30.0) / 5.0, 0.1);
  EXPECT_NEAR(passed["amplitude"].get<double>(), 1.0e-3, 0.05e-3);
  EXPECT_NEAR(passed["amplification_factor"].get<double>(), 9.9, 1.0);
  EXPECT_NEAR(passed["acceleration"].get<double>(), 5.0, 0.1);
  EXPECT_NEAR(passed["model_critical_speed"].get<double>(), 60.15, 0.01);
  EXPECT_NEAR(passed["model_amplification_factor"].get<double>(), 9.9, 0.01);
  const std::string text = twin({"monitor", scene_, log_}).out;
  EXPECT_NE(text.find("resonance passed at"), std::string::npos) << text;
}

TEST_F(RunUpLog, NamesTheLinesOfTheFullSpectrumAtTheEndOrWhereAsked) {
  const Json at_end =
      twin({"monitor", scene_, log_, "--json"}).json()["systems"]["rotor"]["spectrum"];
  EXPECT_NEAR(at_end["end"].get<double>(), 12.0, 1e-9);
  EXPECT_NEAR(at_end["speed"].get<double>(), 87.0, 3.1) << "at the middle of the window";
  ASSERT_FALSE(at_end["lines"].empty());
  EXPECT_EQ(at_end["lines"][0]["name"], "1X");
  EXPECT_GT(at_end["lines"][0]["frequency"], 0.0) << "forward";
  const Ending asked = twin({"monitor", scene_, log_, "--spectrum-at", "5", "--json"});
  ASSERT_EQ(asked.status, 0) << asked.err;
  EXPECT_NEAR(asked.json()["systems"]["rotor"]["spectrum"]["end"].get<double>(), 5.0, 1e-9);
  const Ending beyond = twin({"monitor", scene_, log_, "--spectrum-at", "13"});
  EXPECT_EQ(beyond.status, 2);
  EXPECT_NE(beyond.err.find("0 to 12 s, found 13 s"), std::string::npos) << beyond.err;
}

TEST_F(RunUpLog, ThePageHasTheCascadeOverTheSpeedAndTheOrders) {
  const std::string page = directory_.file("cascade.html");
  ASSERT_EQ(twin({"monitor", scene_, log_, "--output", page}).status, 0);
  const std::string html = contentsOf(page);
  EXPECT_NE(html.find("cascade of full spectra"), std::string::npos);
  EXPECT_NE(html.find("speed of the shaft (rad/s)"), std::string::npos);
  EXPECT_NE(html.find("Resonances passed"), std::string::npos);
  EXPECT_NE(html.find("1X forward"), std::string::npos);
}

TEST_F(RunUpLog, SettingsAreThoseOfTheNodeAndCheckedAsThere) {
  const std::string late = directory_.write("late.yaml", "approach_time: 1.0\n");
  const Ending end = twin({"monitor", scene_, log_, "--settings", late, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_NEAR(alertOf(end.json(), "CRITICAL_SPEED_APPROACH")["raised"].get<double>(), 2.626, 0.01);

  const std::string wrong = directory_.write("wrong.yaml", "aproach_time: 1.0\nhysteresis: -1\n");
  const Ending refused = twin({"monitor", scene_, log_, "--settings", wrong});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("approach_time"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("hysteresis"), std::string::npos) << refused.err;
}

TEST_F(RunUpLog, OfAnotherSceneIsRefused) {
  const Ending end = twin({"monitor", kDemo, scene_});
  EXPECT_EQ(end.status, 2) << "no log";
  const std::string page = directory_.file("page.html");
  std::string renamed = kRunUp;
  renamed.replace(renamed.find("rotor:"), 5, "spool");
  const std::string other = directory_.write("other.yaml", renamed);
  const Ending refused = twin({"monitor", other, log_, "--output", page});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("must have states"), std::string::npos) << refused.err;
  EXPECT_EQ(contentsOf(page), "") << "nothing half-done";
}

// Measurement of that run-up by two oblique probes, with a run-out of 20 um: identified first, then
// compensated.
TEST(MonitorCommand, TakesWhatSensorsMeasure) {
  const TemporaryDirectory directory;
  std::string text = kRunUp;
  text.replace(text.find("{speed: 30.0, profile: ["), 24,
               "{speed: 15.0, profile: [{speed: 15.0, max_acceleration: 1.0, dwell: 4.0}, ");
  text +=
      "sensors:\n  probes:\n    rate: 1000.0\n    channels:\n"
      "      a: {measures: rotor, direction: 0.785, run_out: 2.0e-5, run_out_angle: 0.5}\n"
      "      b: {measures: rotor, direction: 2.356, run_out: 2.0e-5, run_out_angle: 0.5}\n"
      "  tacho: {keyphasor: shaft}\n";
  const std::string scene = directory.write("measured.yaml", text);
  const std::string log = directory.file("measured.lcmlog");
  ASSERT_EQ(twin({"simulate", scene, "--duration", "18", "--measure", "sensors", "--sample",
                  "0.005", "--output", log})
                .status,
            0);
  const std::string settings =
      directory.write("monitor.yaml", "slow_roll: {rotor: {below: 18.0}}\n");
  const Json plain = twin({"monitor", scene, log, "--json"}).json();
  const Json rolled = twin({"monitor", scene, log, "--settings", settings, "--json"}).json();
  EXPECT_EQ(rolled["rejected"], 0);
  EXPECT_FALSE(plain["systems"]["rotor"].contains("slow_roll"));
  const Json& roll = rolled["systems"]["rotor"]["slow_roll"];
  // At 15 rad/s 6.6 um of the unbalance of 100 um are in it.
  EXPECT_NEAR(roll["forward"].get<double>(), 2.0e-5, 7.0e-6);
  EXPECT_LT(roll["backward"].get<double>(), 1.0e-7);
  const Json& passed = rolled["systems"]["rotor"]["resonances"];
  ASSERT_EQ(passed.size(), 1u);
  EXPECT_NEAR(passed[0]["speed"].get<double>(), 62.0, 1.5);
}

}  // namespace monitor_command_test
}  // namespace whirl_twin
