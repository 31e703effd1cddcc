// Level I stability analysis (API 617), and the report: one page with all results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "../scene/scenes.h"
#include "twin_program.h"

namespace whirl_twin {
namespace rotor_report_test {

using Json = nlohmann::json;

const std::string kFriswell = WHIRL_TWIN_SOURCE "/config/scenes/friswell_rotor.yaml";
const std::string kGyroscopic = WHIRL_TWIN_SOURCE "/config/scenes/gyroscopic.yaml";

Json rotorOf(const Ending& end) {
  EXPECT_EQ(end.status, 0) << end.err;
  return end.status == 0 ? end.json()["systems"]["rotor"] : Json();
}

std::size_t count(const std::string& text, const std::string& words) {
  std::size_t found = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
    ++found;
  }
  return found;
}

// A Jeffcott rotor bears q = c p: 12 N s/m at 60 rad/s. Alford's formula by hand, of 100 W at
// 90 rad/s, 0.5 m and 0.1 m, densities 1.2; an axial stage has half of it, without them.
TEST(Stability, OfAJeffcottRotorStandsAgainstItsStages) {
  const Json rotor =
      rotorOf(twin({"stability", kDemo, "--system", "rotor", "--speed", "90", "--stage", "100",
                    "0.5", "0.1", "1.2", "--axial-stage", "100", "0.5", "0.1", "--json"}));
  EXPECT_NEAR(rotor["threshold_cross_coupling"].get<double>(), 720.0, 1.0e-6);
  const double centrifugal = 3.0 * (100.0 / 90.0) / (0.5 * 0.1) * 1.2;
  const double axial = 1.5 * (100.0 / 90.0) / (0.5 * 0.1);
  ASSERT_EQ(rotor["stages"].size(), 2u);
  EXPECT_NEAR(rotor["stages"][0]["cross_coupling"].get<double>(), centrifugal, 1.0e-9);
  EXPECT_NEAR(rotor["stages"][1]["cross_coupling"].get<double>(), axial, 1.0e-9);
  EXPECT_NEAR(rotor["expected_cross_coupling"].get<double>(), centrifugal + axial, 1.0e-9);
  // m s^2 + c s + k - i q = 0, with m 2, c 12, k 7200: the decrement at Q_A, and level I passes.
  const std::complex<double> i(0.0, 1.0);
  const std::complex<double> s =
      (-12.0 + std::sqrt(144.0 - 8.0 * (7200.0 - i * (centrifugal + axial)))) / 4.0;
  const std::complex<double> forward = s.imag() > 0.0 ? s : -6.0 - s;
  EXPECT_NEAR(rotor["log_decrement_expected"].get<double>(),
              -2.0 * 3.14159265358979323846 * forward.real() / forward.imag(), 1.0e-9);
  EXPECT_TRUE(rotor["level_two"].empty());
  EXPECT_NEAR(rotor["log_decrement"][0].get<double>(),
              2.0 * 3.14159265358979323846 * 0.05 / std::sqrt(1.0 - 0.0025), 1.0e-9);
}

TEST(Stability, AsksForLevelTwoWhereTheStagesHaveTooMuch) {
  const Json rotor = rotorOf(twin({"stability", kDemo, "--system", "rotor", "--speed", "90",
                                   "--stage", "1000", "0.5", "0.05", "1.0", "--json"}));
  EXPECT_EQ(rotor["level_two"].size(), 2u);  // 1333 N/m of 720
  EXPECT_NE(twin({"stability", kDemo, "--speed", "90", "--stage", "1000", "0.5", "0.05", "1.0"})
                .out.find("it applies: Q_0/Q_A = 0.54 is below 2"),
            std::string::npos);
}

const std::string kCases = WHIRL_TWIN_REFERENCE "/rotors/";

void expectLevelOne(const Json& json, double threshold, double decrement, double tolerance) {
  EXPECT_NEAR(json["threshold_cross_coupling"].get<double>(), threshold, tolerance * threshold);
  EXPECT_NEAR(json["log_decrement_expected"].get<double>(), decrement,
              tolerance * std::fabs(decrement));
  EXPECT_FALSE(json["level_two"].empty()) << "level II is required";
}

// Dense finite elements, computed beside the program. Bearings of 5e4 N s/m have roots with a
// damping ratio of 0.9999 and a small imaginary part, which are no whirl.
TEST(Stability, IsOfWhatWhirlsAndNotOfNearlyCriticallyDampedRoots) {
  const std::string scene = kCases + "level_one_overdamped.yaml";
  const Json json = twin({"stability", scene, "--stage", "1000000", "0.4", "0.02", "1.5", "--json"})
                        .json()["systems"]["rotor"];
  EXPECT_NEAR(json["frequency"][0].get<double>(), 760.0, 0.76);
  EXPECT_NEAR(json["log_decrement"][0].get<double>(), 0.1775, 2e-4);
  EXPECT_NEAR(json["expected_cross_coupling"].get<double>(), 5.625e5, 6e2);
  expectLevelOne(json, 9.92e5, 0.0768, 1e-3);
  const Json analyzed = twin({"analyze", scene, "--json"}).json()["systems"]["rotor"];
  EXPECT_NEAR(analyzed["cross_coupling_margin"]["stiffness"].get<double>(), 9.92e5, 1e3)
      << analyzed.dump(1);
  const Json modes =
      twin({"modes", scene, "--speed", "1000", "--json"}).json()["systems"]["rotor"]["modes"];
  bool whirls = true;
  for (const Json& mode : modes) {
    EXPECT_EQ(mode["is_whirl"].get<bool>(), mode["damping_ratio"].get<double>() <= 0.7);
    EXPECT_TRUE(whirls || !mode["is_whirl"].get<bool>()) << "whirls are listed first";
    whirls = mode["is_whirl"].get<bool>();
  }
  EXPECT_LT(modes[0]["damping_ratio"].get<double>(), 0.1);
}

// Dense finite elements: the mode that is forward without Q is backward with it, another is
// forward.
TEST(Stability, IsOfTheModeThatIsForwardAtQAndNotOfTheOneThatWas) {
  const std::string scene = kCases + "level_one.yaml";
  const auto of = [&](const char* power) {
    return twin({"stability", scene, "--stage", power, "0.4", "0.02", "1", "--json"})
        .json()["systems"]["rotor"];
  };
  expectLevelOne(of("27440000"), 8.229e6, -0.234, 2e-3);
  expectLevelOne(of("13832000"), 8.229e6, 0.310, 2e-3);
}

// Q_0 of the rotor between pins is 32 023.93 N/m (finite elements computed beside the program,
// without the rows of the pins). The stiffer its bearings, the nearer it is to that.
TEST(Stability, IsTheSameOnBearingsHoweverStiff) {
  const TemporaryDirectory folder;
  for (const char* stiffness : {"1e+15", "1e+17", "1e+20"}) {
    const std::string scene = folder.write(
        "stiff.yaml",
        std::string("name: stiff\nstep: 0.0005\nsystems:\n  rotor:\n    model: flexible_rotor\n"
                    "    parameters:\n      {youngs_modulus: 2.1e+11, density: 7850, modes: 0, "
                    "speed: 300, stiffness_damping: 1.0e-5, "
                    "elements: [{length: 0.1, outer_diameter: 0.05, count: 8}], "
                    "discs: [{node: 4, mass: 15, polar_inertia: 0.1, transverse_inertia: 0.06}], "
                    "bearings: [{node: 0, kxx: ") +
            stiffness + "}, {node: 8, kxx: " + stiffness + "}]}\n");
    const Json rotor = rotorOf(twin(
        {"stability", scene, "--speed", "300", "--stage", "2000", "0.3", "0.02", "1.2", "--json"}));
    EXPECT_NEAR(rotor["threshold_cross_coupling"].get<double>(), 32023.93, 0.5) << stiffness;
    EXPECT_FALSE(rotor["level_two"].empty()) << "level II is required";
  }
}

TEST(Stability, ActsAtMidSpanByDefault) {
  EXPECT_EQ(rotorOf(twin({"stability", kFriswell, "--json"}))["station"], "node_3");
  const Json at = rotorOf(twin({"stability", kFriswell, "--at", "node_2", "--json"}));
  EXPECT_EQ(at["station"], "node_2");
  // The decrement falls with the cross-coupling, and is zero at the threshold.
  const Json& decrements = at["log_decrement"];
  for (std::size_t i = 0; i + 1 < decrements.size(); ++i) {
    EXPECT_GT(decrements[i].get<double>(), decrements[i + 1].get<double>());
  }
  EXPECT_GT(decrements[0].get<double>(), 0.0);
  EXPECT_LT(decrements.back().get<double>(), 0.0);
  EXPECT_EQ(twin({"stability", kFriswell, "--at", "node_8"}).status, 2);
}

TEST(Report, OfAFlexibleRotorHasEveryPart) {
  const TemporaryDirectory folder;
  const Ending end = twin({"report", kFriswell, "--output", folder.file("pages"), "--stage", "2e5",
                           "0.4", "0.015", "1.6"});
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.out, folder.file("pages") + "/friswell_rotor_rotor.html\n");
  const std::string page = contentsOf(folder.file("pages/friswell_rotor_rotor.html"));
  for (const char* part :
       {"Drawing", "Mass", "At rest under its weight", "Critical speed map", "Whirl modes",
        "Campbell diagram", "Unbalance response", "Stability, level I", "Left out"}) {
    EXPECT_EQ(count(page, std::string("<h2>") + part + "</h2>"), 1u) << part;
  }
  EXPECT_EQ(count(page, "<svg "), 7u);
  EXPECT_EQ(count(page, "</html>"), 1u);
  for (const char* outside : {"http://", "https://", "src=", "nan", " inf", ">inf"}) {
    const bool a_name = std::string(outside) == "http://";  // of SVG's, in every picture
    EXPECT_EQ(count(page, outside), a_name ? count(page, "http://www.w3.org/") : 0u) << outside;
  }
  EXPECT_NE(page.find("AF &lt; 2.5: critically damped"), std::string::npos);
}

// Clip paths and markers of a figure have names, which must be unique on a page.
TEST(Report, HasNoNameTwice) {
  const TemporaryDirectory folder;
  ASSERT_EQ(twin({"report", kFriswell, "--output", folder.file("pages")}).status, 0);
  const std::string page = contentsOf(folder.file("pages/friswell_rotor_rotor.html"));
  std::vector<std::string> names;
  for (std::size_t at = page.find(" id=\""); at != std::string::npos;
       at = page.find(" id=\"", at + 1)) {
    names.push_back(page.substr(at + 5, page.find('"', at + 5) - at - 5));
  }
  ASSERT_GT(names.size(), 20u);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(Report, OfARigidDiscTellsWhatItLacks) {
  const TemporaryDirectory folder;
  const Ending end = twin({"report", kGyroscopic, "--output", folder.file("pages")});
  ASSERT_EQ(end.status, 0) << end.err;
  const std::string page = contentsOf(linesOf(end.out).front());
  EXPECT_EQ(count(page, "<h2>Drawing</h2>"), 0u);
  EXPECT_EQ(count(page, "<h2>Campbell diagram</h2>"), 1u);
  EXPECT_NE(page.find("critical speed map: only of a flexible_rotor"), std::string::npos);
}

TEST(Report, OfAPendulumIsRefusedAndLeavesNothing) {
  const TemporaryDirectory folder;
  const Ending end = twin({"report", WHIRL_TWIN_SOURCE "/config/scenes/rod_slider.yaml", "--output",
                           folder.file("pages")});
  EXPECT_EQ(end.status, 2);
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace rotor_report_test
}  // namespace whirl_twin
