// Run-ups of machines in tables, with volts and the voltage of a keyphasor, through the commands
// that evaluate recordings. The motion is that of its equation, integrated here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>
#include <string>

#include "twin_program.h"

namespace whirl_twin {
namespace measured_table_test {

using Json = nlohmann::json;

constexpr double kPi = 3.14159265358979323846;
constexpr double kMass = 10.0, kStiffness = 1.44e5, kDamping = 120.0, kEccentricity = 3.0e-5;
constexpr double kAcceleration = 20.0, kTop = 200.0;  // rad/s^2, rad/s
constexpr double kRate = 1600.0;                      // Hz
constexpr double kRunOut = 5.0e-6, kRunOutAngle = 63.0 * kPi / 180.0;

constexpr const char* kMachine = R"(name: machine
step: 0.001
drives:
  shaft: {speed: 0.0, profile: [{speed: 200.0, max_acceleration: 20.0}]}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 10.0, stiffness: 1.44e+5, damping: 120.0, eccentricity: 1.0e-5}
sensors:
  probes:
    rate: 1600.0
    channels:
      x: {measures: rotor.x, noise: 3.0e-7}
      y: {measures: rotor.y, noise: 3.0e-7}
  tacho: {keyphasor: shaft}
)";

double speedAt(double t) {
  return std::min(kAcceleration * t, kTop);
}
double angleAt(double t) {
  const double until = kTop / kAcceleration;
  return t < until ? 0.5 * kAcceleration * t * t : kTop * (t - 0.5 * until);
}

/// x, y and their rates.
using State = std::array<double, 4>;

State rateOf(double t, const State& s) {
  const double angle = angleAt(t), speed = speedAt(t);
  const double force = kMass * kEccentricity;
  const double spin = t < kTop / kAcceleration ? kAcceleration : 0.0;
  const double c = std::cos(angle), n = std::sin(angle);
  return {s[2], s[3],
          (force * (speed * speed * c + spin * n) - kDamping * s[2] - kStiffness * s[0]) / kMass,
          (force * (speed * speed * n - spin * c) - kDamping * s[3] - kStiffness * s[1]) / kMass};
}

State stepped(double t, const State& s, double h) {  // Runge & Kutta
  const auto ahead = [&](const State& rate, double part) {
    State at = s;
    for (std::size_t i = 0; i < 4; ++i) {
      at[i] += part * h * rate[i];
    }
    return at;
  };
  const State a = rateOf(t, s), b = rateOf(t + 0.5 * h, ahead(a, 0.5));
  const State c = rateOf(t + 0.5 * h, ahead(b, 0.5)), d = rateOf(t + h, ahead(c, 1.0));
  State next = s;
  for (std::size_t i = 0; i < 4; ++i) {
    next[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
  }
  return next;
}

/// `row` writes what was measured at a time: x and y in m, and the voltage, low for a tenth of a
/// turn.
template <class Row>
std::string runUp(const std::string& head, Row&& row) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::string text = head;
  State state{};
  constexpr int kSub = 4;
  for (int i = 0; i < 20'000; ++i) {  // 12.5 s
    const double t = i / kRate;
    const double angle = angleAt(t), high = angle + kRunOutAngle;
    const double x = state[0] + kRunOut * std::cos(high) + 3.0e-7 * normal(random);
    const double y = state[1] + kRunOut * std::sin(high) + 3.0e-7 * normal(random);
    const double part = std::fmod(angle / (2.0 * kPi), 1.0);
    text += row(i, t, x, y, (part < 0.1 ? -9.0 : -1.5) + 0.05 * normal(random));
    for (int k = 0; k < kSub; ++k) {
      state = stepped(t + k / (kSub * kRate), state, 1.0 / (kSub * kRate));
    }
  }
  return text;
}

class MachineTable : public testing::Test {
 protected:
  Json json(std::vector<std::string> command) const {
    command.emplace_back("--json");
    const Ending end = twin(command);
    EXPECT_EQ(end.status, 0) << end.err;
    return end.status == 0 ? end.json() : Json();
  }
  std::string plain() const {
    return directory_.write("run.csv", runUp("time [s],x [um],y [um],keyphasor [V]\n",
                                             [](int, double t, double x, double y, double volts) {
                                               return fmt::format("{:.4f},{:.2f},{:.2f},{:.2f}\n",
                                                                  t, 1.0e6 * x, 1.0e6 * y, volts);
                                             }));
  }
  void expectBalance(const Json& found) const {
    const Json mass = found["unbalance"].begin().value();
    EXPECT_NEAR(mass["mass_radius"].get<double>(), 3.0e-4, 3.0e-6);
    EXPECT_NEAR(mass["angle"].get<double>(), 0.0, 1.0);
    const Json run_out = found["run_out"]["x"];
    EXPECT_NEAR(run_out["amplitude"].get<double>(), kRunOut, 1.0e-7);
    EXPECT_NEAR(run_out["phase_lag"].get<double>(), -63.0, 1.0);
  }

  const TemporaryDirectory directory_;
  const std::string scene_ = directory_.write("machine.yaml", kMachine);
};

TEST_F(MachineTable, IsMonitored) {
  const Json run = json({"monitor", scene_, plain()});
  const Json resonances = run["systems"]["rotor"]["resonances"];
  ASSERT_EQ(resonances.size(), 1u) << resonances;
  // A passage at 20 rad/s^2 is later than the resonance at 120 rad/s.
  EXPECT_NEAR(resonances[0]["speed"].get<double>(), 124.0, 4.0);
  EXPECT_EQ(run["rejected"], 0);
  EXPECT_NE(run["remarks"].dump().find("falling through"), std::string::npos);
}

TEST_F(MachineTable, IsBalanced) {
  expectBalance(json({"balance", scene_, "--measured", plain()}));
}

TEST_F(MachineTable, IsReadByModesAndFollow) {
  const std::string table = plain();
  const Json modes = json({"modes", scene_, "--measured", table, "--speed", "200"});
  EXPECT_GT(modes["systems"]["rotor"]["samples"].get<int>(), 3000);
  const Json run = json({"follow", scene_, table});
  const Json samples = run["systems"]["rotor"]["samples"];
  EXPECT_GT(samples["used"].get<int>() + samples["refused"].get<int>(), 30'000);
}

// mV with semicolons and decimal commas, samples counted, other names.
TEST_F(MachineTable, OfVoltsIsImportedAsALog) {
  const auto comma = [](std::string text) {
    std::replace(text.begin(), text.end(), '.', ',');
    return text;
  };
  const std::string table = directory_.write(
      "volts.txt",
      "Rig 3;25,6\n" + runUp("sample;CH1 [mV];CH2 [V];once per turn\n",
                             [&](int i, double, double x, double y, double volts) {
                               return comma(fmt::format("{};{:.3f};{:.6f};{:.2f}\n", i,
                                                        -9800.0 + 1.0e3 * x * 0.2 / 2.54e-5,
                                                        -9.1 + y * 0.2 / 2.54e-5, volts));
                             }));
  const std::string settings = directory_.write(
      "import.yaml",
      "time: sample\nrate: 1.6 kHz\n"
      "columns:\n  x: {column: CH1, scale: 200 mV/mil, gap: -9.8 V}\n"
      "  y: {column: CH2, scale: 200 mV/mil, gap: -9.1 V}\n"
      "keyphasor: {column: once per turn, threshold: -5 V, slope: falling, hysteresis: 1 V}\n");
  const std::string log = directory_.file("run.lcmlog");
  const Ending end = twin({"import", "measurements", table, "--scene", scene_, "--settings",
                           settings, "--output", log});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_NE(end.err.find("separator ';', decimal ','"), std::string::npos) << end.err;
  const Json of_log = json({"balance", scene_, "--measured", log});
  expectBalance(of_log);
  Json of_table = json({"balance", scene_, "--measured", table, "--import", settings});
  of_table["log"] = of_log["log"];
  of_table["notes"] = of_log["notes"];
  EXPECT_EQ(of_table, of_log);
  EXPECT_EQ(twin({"balance", scene_, "--measured", log, "--import", settings}).status, 2);
  EXPECT_EQ(twin({"import", "measurements", table, "--output", log}).status, 2);
}

TEST(Bode, OfExportedVectors) {
  const TemporaryDirectory directory;
  std::string text = "speed_rpm,amplitude_um_pp,phase_lag_deg\n";
  for (double rpm = 300.0; rpm <= 7600.0; rpm += 100.0) {
    const double ratio = rpm * kPi / 30.0 / 440.0;
    const std::complex<double> z = std::polar(4.0, -297.0 * kPi / 180.0) +
                                   std::polar(20.0, -0.8) * ratio * ratio /
                                       std::complex<double>(1.0 - ratio * ratio, 0.09 * ratio);
    text += fmt::format("{:.1f},{:.3f},{:.2f}\n", rpm, 2.0 * std::abs(z),
                        std::fmod(360.0 - std::arg(z) * 180.0 / kPi, 360.0));
  }
  const Ending end = twin({"bode", directory.write("vectors.csv", text), "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json probe = end.json()["probes"].begin().value();
  ASSERT_EQ(probe["critical_speeds"].size(), 1u);
  const Json critical = probe["critical_speeds"][0];
  EXPECT_NEAR(critical["speed"].get<double>(), 440.0, 0.05);
  EXPECT_NEAR(critical["damping_ratio"].get<double>(), 0.045, 5.0e-5);
  EXPECT_NEAR(probe["slow_roll"]["peak_to_peak"].get<double>(), 8.0e-6, 2.0e-8);
  EXPECT_NEAR(probe["slow_roll"]["phase_lag"].get<double>(), 297.0, 0.2);
  EXPECT_EQ(twin({"bode", directory.write("other.csv", "a,b\n1,2\n")}).status, 2);
}

}  // namespace measured_table_test
}  // namespace whirl_twin
