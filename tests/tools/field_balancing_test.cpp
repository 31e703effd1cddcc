// `twin balance FILE`: correction masses from trial runs and known influence coefficients.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "twin_program.h"

namespace whirl_twin {
namespace field_balancing_test {

// One probe, one plane, v = 2 u: an unbalance of 3 at 0 degrees shows 6, and 1 more at 90 degrees
// makes 6 + 2i, read as a lag of -18.43 degrees. Three have to be set opposite.
TEST(Balance, SetsTheMassOpposite) {
  const TemporaryDirectory folder;
  const std::string runs =
      folder.write("runs.yaml",
                   "probes: [left]\n"
                   "planes: [disc]\n"
                   "initial: [[6, 0]]\n"
                   "trials:\n"
                   "  - {plane: disc, mass_radius: 1, angle: 90,\n"
                   "     readings: [[6.324555320336759, -18.43494882292201]]}\n");
  const Ending end = twin({"balance", runs, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto disc = end.json()["correction"]["disc"];
  EXPECT_NEAR(disc["mass_radius"].get<double>(), 3.0, 1e-12);
  EXPECT_NEAR(std::fabs(disc["angle"].get<double>()), 180.0, 1e-10);
  EXPECT_NEAR(end.json()["residual_rms"].get<double>(), 0.0, 1e-12);
}

/// Amplitudes and lags [deg] that the probes of the scene `balancing` read at 70 rad/s, with trial
/// masses in its two planes.
std::string readings(double left, double right, double angle) {
  std::string scene = contentsOf(WHIRL_TWIN_SOURCE "/config/scenes/balancing.yaml");
  int node = 2;
  for (const double mass : {left, right}) {
    const std::string empty = fmt::format("{{node: {}, magnitude: 0.0, angle: 0.0}}", node);
    const std::size_t at = scene.find(empty);
    EXPECT_NE(at, std::string::npos) << empty;
    scene.replace(at, empty.size(),
                  fmt::format("{{node: {}, magnitude: {}, angle: {}}}", node, mass, angle));
    node += 2;
  }
  const TemporaryDirectory folder;
  const Ending end = twin({"orbit", folder.write("trial.yaml", scene), "--speed", "70", "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
  const auto stations = end.json()["systems"]["rotor"]["stations"];
  std::vector<std::string> all;
  for (const char* probe : {"node_1", "node_5"}) {
    all.push_back(fmt::format("[{}, {}]", stations[probe]["major"].get<double>(),
                              stations[probe]["phase_lag"].get<double>() * 180.0 / M_PI));
  }
  return fmt::format("[{}]", fmt::join(all, ", "));
}

// docs/rotors.md, with the trial masses where there is a hole: 6.0e-4 kg m at 0.9 rad and 9.0e-4 at
// 3.6 rad are hidden in the scene, and are to be set opposite.
TEST(Balance, FindsWhatTheShippedSceneHidesWithTrialMassesAtAnyAngle) {
  const TemporaryDirectory folder;
  const std::string runs = folder.write(
      "runs.yaml",
      fmt::format("probes: [node_1, node_5]\nplanes: [left, right]\ninitial: {}\ntrials:\n"
                  "  - {{plane: left, mass_radius: 5.0e-4, angle: 60, readings: {}}}\n"
                  "  - {{plane: right, mass_radius: 5.0e-4, angle: 60, readings: {}}}\n",
                  readings(0.0, 0.0, 0.0), readings(5.0e-4, 0.0, M_PI / 3.0),
                  readings(0.0, 5.0e-4, M_PI / 3.0)));
  const Ending end = twin({"balance", runs, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const auto correction = end.json()["correction"];
  EXPECT_NEAR(correction["left"]["mass_radius"].get<double>(), 6.0e-4, 1e-12);
  EXPECT_NEAR(correction["left"]["angle"].get<double>(), 0.9 * 180.0 / M_PI - 180.0, 1e-6);
  EXPECT_NEAR(correction["right"]["mass_radius"].get<double>(), 9.0e-4, 1e-12);
  EXPECT_NEAR(correction["right"]["angle"].get<double>(), 3.6 * 180.0 / M_PI - 180.0, 1e-6);
}

TEST(Balance, SaysWhereTheFileIsWrong) {
  const TemporaryDirectory folder;
  const std::string runs = folder.write("runs.yaml",
                                        "probes: [left]\nplanes: [disc]\ninitial: [[6, 0]]\n"
                                        "trials: [{plane: disk, mass_radius: 1, angle: north,\n"
                                        "          readings: [[1]], mas: 1}]\n"
                                        "weights: [-1]\n");
  const Ending end = twin({"balance", runs});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  Lines expected;
  for (const char* error :
       {"weights[0]: must be a weight from 0 to 1e+12, found -1",
        "trials[0].mas: unknown key of a trial run",
        "trials[0].plane: must be the name of a plane, found 'disk'; did you mean 'disc'?",
        "trials[0].angle: must be an angle in deg from -360000 to 360000, found 'north'",
        "trials[0].readings[0]: must be [amplitude, phase lag in deg], found a list"}) {
    expected.push_back("twin: " + runs + ": " + error);
  }
  EXPECT_EQ(linesOf(end.err), expected);
}

TEST(Balance, NeedsARunForEveryPlane) {
  const TemporaryDirectory folder;
  const std::string runs =
      folder.write("runs.yaml",
                   "probes: [left]\nplanes: [disc, fan]\ninitial: [[6, 0]]\nweights: [0]\n"
                   "trials: [{plane: disc, mass_radius: 1, angle: 0, readings: [[1, 0]]}]\n");
  const Ending end = twin({"balance", runs});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(linesOf(end.err),
            (Lines{"twin: " + runs + ": weights: must have one > 0",
                   "twin: " + runs +
                       ": trials: must have a run with a mass in every plane, found none in "
                       "'fan'"}));
}

TEST(BalancingRuns, HaveUnits) {
  const TemporaryDirectory folder;
  const auto runs = [&](const std::string& first, const std::string& rest, const std::string& mass,
                        const std::string& angle) {
    return twin(
        {"balance",
         folder.write("runs.yaml", "probes: [a]\nplanes: [disc]\ninitial: [[" + first +
                                       "]]\ntrials:\n  - {plane: disc, mass_radius: " + mass +
                                       ", angle: " + angle + ", readings: [[" + rest + "]]}\n"),
         "--json"});
  };
  const Ending si = runs("6.35e-5, 130", "2.54e-5, 40", "1.5e-5", "60");
  const Ending units =
      runs("2.5 mil, 130 deg", "25.4 um, 0.6981317007977318 rad", "15 g mm", "60 °");
  ASSERT_EQ(units.status, 0) << units.err;
  EXPECT_NEAR(units.json()["correction"]["disc"]["mass_radius"].get<double>(),
              si.json()["correction"]["disc"]["mass_radius"].get<double>(), 1e-15);
  EXPECT_NEAR(units.json()["correction"]["disc"]["angle"].get<double>(),
              si.json()["correction"]["disc"]["angle"].get<double>(), 1e-9);
  EXPECT_EQ(units.json()["amplitude_unit"], "m");
  EXPECT_TRUE(si.json()["amplitude_unit"].is_null());
  EXPECT_NE(runs("2.5 mil, 130", "25.4, 40", "15 g mm", "60")
                .err.find("trials[0].readings[0][0]: must have a unit, as initial[0][0] has"),
            std::string::npos);
  EXPECT_NE(
      runs("2.5 mil, 130", "25.4 mm/s, 40", "15 g mm", "60").err.find("cannot be converted to m"),
      std::string::npos);
  EXPECT_NE(runs("1, 130", "2, 40", "15 g", "60").err.find("mass times radius in kg m"),
            std::string::npos);
}

/// As JSON.
nlohmann::json balanced(const std::string& job) {
  const TemporaryDirectory folder;
  const Ending end = twin({"balance", folder.write("job.yaml", job), "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
  return end.status == 0 ? end.json() : nlohmann::json();
}

void expectMass(const nlohmann::json& plane, double mass_radius, double angle) {
  EXPECT_NEAR(plane["mass_radius"].get<double>(), mass_radius, 1e-4 * mass_radius);
  EXPECT_NEAR(plane["angle"].get<double>(), angle, 1e-2);
}

// A job computed by an independent program: correction masses of 9 at 20 deg and 6 at -105 deg.
const char* const kInitial =
    "probes: [left, right]\nplanes: [near, far]\n"
    "initial: [[0.795912, -154.8225], [0.593511, -28.9511]]\n";
const char* const kWeightsLeftIn =
    "trials:\n"
    "  - {plane: near, mass_radius: 5, angle: 0, left_in: true,\n"
    "     readings: [[0.299344, 177.1405], [0.701201, -19.6672]]}\n"
    "  - {plane: far, mass_radius: 4, angle: 135,\n"
    "     readings: [[0.252447, -155.0948], [1.0927, -46.1104]]}\n";
const char* const kKnownInfluence =
    "influence:\n"
    "  - [[0.11, 40], [0.035, 75]]\n"
    "  - [[0.03, 20], [0.14, 55]]\n";

TEST(Balance, WithTrialMassesLeftInAndByKnownInfluence) {
  for (const char* runs : {kWeightsLeftIn, kKnownInfluence}) {
    const auto report = balanced(std::string(kInitial) + runs);
    expectMass(report["correction"]["near"], 9.0, 20.0);
    expectMass(report["correction"]["far"], 6.0, -105.0);
    EXPECT_NEAR(report["influence"][1][0][0].get<double>(), 0.03, 1e-5);
    EXPECT_NEAR(report["influence"][1][0][1].get<double>(), 20.0, 1e-2);
  }
  // 5 at 0 deg stays in: 9 at 20 deg less 5 at 0 deg.
  const auto rest =
      balanced(std::string(kInitial) + kWeightsLeftIn)["correction_with_trial_masses"];
  const auto near = std::polar(9.0, M_PI / 9.0) - 5.0;
  expectMass(rest["near"], std::abs(near), std::arg(near) * 180.0 / M_PI);
  expectMass(rest["far"], 6.0, -105.0);
}

// Influence coefficients in units are printed as the key of a later job that gives the same masses.
TEST(Balance, PrintsInfluenceCoefficientsForALaterJob) {
  const TemporaryDirectory folder;
  const std::string initial =
      "probes: [a]\nplanes: [disc]\ninitial: [[2.5 mil, 130]]\nphase: lead\n";
  const std::string first =
      initial +
      "trials: [{plane: disc, mass_radius: 15 g mm, angle: 60, readings: [[1 mil, 40]]}]\n";
  const Ending text = twin({"balance", folder.write("job.yaml", first)});
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("mass x radius, g mm"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("vibration, mil"), std::string::npos) << text.out;
  const std::size_t at = text.out.find("\ninfluence:\n");
  ASSERT_NE(at, std::string::npos) << text.out;
  const auto later = balanced(initial + text.out.substr(at));
  const auto then = balanced(first);
  expectMass(later["correction"]["disc"], then["correction"]["disc"]["mass_radius"].get<double>(),
             then["correction"]["disc"]["angle"].get<double>());
}

// Lags with angles in the direction of rotation, leads with them, lags with angles against it: the
// same job in three conventions.
TEST(Balance, HasTheConventionsOfTheReadings) {
  const auto job = [](const std::string& convention, double phase, double angle) {
    return fmt::format(
        "probes: [a]\nplanes: [disc]\n{}initial: [[6, {}]]\n"
        "trials: [{{plane: disc, mass_radius: 1, angle: {}, readings: [[4, {}]]}}]\n",
        convention, 30.0 * phase, 70.0 * angle, 75.0 * phase);
  };
  const auto lag = balanced(job("", 1.0, 1.0))["correction"]["disc"];
  const auto lead = balanced(job("phase: lead\n", -1.0, 1.0))["correction"]["disc"];
  const auto against = balanced(job("angles: against_rotation\n", 1.0, -1.0))["correction"]["disc"];
  const double angle = lag["angle"].get<double>();
  EXPECT_NEAR(lead["angle"].get<double>(), angle, 1e-9);
  EXPECT_NEAR(against["angle"].get<double>(), -angle, 1e-9);
  EXPECT_NEAR(lead["mass_radius"].get<double>(), lag["mass_radius"].get<double>(), 1e-12);
}

TEST(Balance, OfASymmetricRotorNeedsOneTrialRun) {
  // v = [[2, 0.5i], [0.5i, 2]] u, initial unbalances 3 and 1 at 0 deg, a trial mass of 1 in near.
  const auto report = balanced(
      "probes: [left, right]\nplanes: [near, far]\n"
      "symmetric: {probes: [[left, right]], planes: [[near, far]]}\n"
      "initial: [[6.020797289396148, -4.763641690726178], [2.5, -36.86989764584402]]\n"
      "trials: [{plane: near, mass_radius: 1, angle: 0,\n"
      "          readings: [[8.015609770940699, -3.576334374997351], [2.8284271247461903, "
      "-45]]}]\n");
  EXPECT_NEAR(report["correction"]["near"]["mass_radius"].get<double>(), 3.0, 1e-9);
  EXPECT_NEAR(report["correction"]["far"]["mass_radius"].get<double>(), 1.0, 1e-9);
}

// 9 at 20 deg on holes each 30 deg: at 0 and 30 deg, whose vectors add up to it; and a limit.
TEST(Balance, SplitsOverHolesAndKeepsLimits) {
  const std::string job = std::string(kInitial) + kKnownInfluence;
  const auto holes =
      balanced(job + "places: {near: {count: 12}, far: [0, 100, 255]}\n")["correction"];
  ASSERT_EQ(holes["near"]["parts"].size(), 2U);
  const double low = 9.0 * std::sin(M_PI / 18.0) / std::sin(M_PI / 6.0);
  const double high = 9.0 * std::sin(M_PI / 9.0) / std::sin(M_PI / 6.0);
  expectMass(holes["near"]["parts"][0], low, 0.0);
  expectMass(holes["near"]["parts"][1], high, 30.0);
  ASSERT_EQ(holes["far"]["parts"].size(), 1U) << "255 deg is -105 deg";
  const auto limited = balanced(job + "limits: {near: 4}\n");
  EXPECT_NEAR(limited["correction"]["near"]["mass_radius"].get<double>(), 4.0, 1e-9);
  EXPECT_GT(limited["residual_rms"].get<double>(), 0.1);
}

// ISO 21940-11: 40 kg, G 2.5 at 3000 rpm permits 0.31831 g m, half in each plane.
TEST(Balance, JudgesByTheTolerance) {
  const auto job = [](double left, const std::string& more) {
    return fmt::format(
        "probes: [a, b, c]\nplanes: [one, two]\ninitial: [[{} um, 0], [1 um, 90], [1 um, 90]]\n"
        "influence:\n"
        "  - [[10 um/(g m), 0], [0 um/(g m), 0]]\n"
        "  - [[0 um/(g m), 0], [10 um/(g m), 0]]\n"
        "  - [[0 um/(g m), 0], [10 um/(g m), 0]]\n"
        "deviation: 0.3 um\n"
        "tolerance: {{grade: 2.5, mass: 40, speed: 3000 rpm}}\n{}",
        left, more);
  };
  const auto planes = balanced(job(5.0, ""))["tolerance"]["planes"];
  EXPECT_NEAR(planes["one"]["permitted"].get<double>(), 1.59155e-4, 1e-9);
  EXPECT_NEAR(planes["one"]["unbalance"].get<double>(), 5.0e-4, 1e-9);
  EXPECT_NEAR(planes["one"]["grade"].get<double>(), 7.854, 1e-3);
  EXPECT_EQ(planes["one"]["verdict"], "exceeded");
  EXPECT_EQ(planes["one"]["verdict_after"], "within");
  EXPECT_EQ(planes["two"]["verdict"], "within") << "1e-4 +- 4e-5";
  EXPECT_EQ(balanced(job(1.5, ""))["tolerance"]["planes"]["one"]["verdict"], "uncertain");
  EXPECT_EQ(
      balanced(job(5.0, "limits: {one: 0.1 g m}\n"))["tolerance"]["planes"]["one"]["verdict_after"],
      "exceeded");
}

TEST(Balance, NamesWhatIsWrongInEveryKey) {
  const TemporaryDirectory folder;
  const std::string job = folder.write(
      "job.yaml", std::string(kInitial) + kKnownInfluence +
                      "trials: []\nphase: late\nangles: up\nsymmetric: {probes: [[left, up]]}\n"
                      "limits: {near: -1, fan: 2}\nplaces: {near: [0, 10, 20], far: {count: 2}}\n"
                      "tolerance: {grade: 2.5, mass: 40, shares: {near: 0.7}}\n");
  const Ending end = twin({"balance", job});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  for (const char* error :
       {"influence: must not be given beside trials", "phase: must be lag or lead, found 'late'",
        "angles: must be with_rotation or against_rotation, found 'up'",
        "symmetric.probes[0]: must be two of probes, each in one pair, found [left, up]",
        "symmetric.planes: must be a list of pairs of names, found nothing",
        "limits.near: must be mass times radius in kg m, from 1e-12", "limits.fan: unknown plane",
        "places.near: balancing: places must be less than 180 deg apart",
        "places.far.count: must be", "and "}) {
    EXPECT_NE(end.err.find(error), std::string::npos) << error << "\n" << end.err;
  }
}

}  // namespace field_balancing_test
}  // namespace whirl_twin
