// Values of a scene that a command line replaces.
#include "scene/scene_changes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "messages/input_error.h"
#include "messages/units.h"
#include "scene/error_list.h"
#include "scene/node_reader.h"
#include "scene/scene_error.h"
#include "scenes.h"

namespace whirl_twin {
namespace scene_changes_test {

constexpr const char* kScene = R"(
step: 0.001
drives:
  shaft: {speed: 10.0, profile: [{speed: 20.0, max_acceleration: 5.0}, {speed: 30.0, max_acceleration: 6.0}]}
systems:
  rotor: &rotor
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4}
  twin: *rotor
  shaft_2:
    model: flexible_rotor
    parameters:
      speed: 100.0
      youngs_modulus: 2.1e11
      density: 7850.0
      elements: [{length: 0.25, outer_diameter: 0.03}, {length: 0.25, outer_diameter: 0.03}]
      discs: [{node: 1, mass: 1.0, polar_inertia: 0.01, transverse_inertia: 0.005}]
      bearings: [{node: 0, kxx: 1.0e6}, {node: 2, kxx: 1.0e6}]
)";

Scene changed(const std::vector<std::string>& changes) {
  YAML::Node tree = YAML::Load(kScene);
  const std::vector<SceneChange> made = changeScene(tree, changes);
  return readChangedScene(tree, "file.yaml", made);
}

std::string refusal(const std::vector<std::string>& changes) {
  try {
    static_cast<void>(changed(changes));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneChanges, AreAsIfWrittenInTheFile) {
  const Scene scene =
      changed({"rotor.damping=8", "rotor.mass = 500 g", "shaft.speed=600 rpm", "step=2 ms",
               "shaft.profile[1].speed=-1e1", "shaft.max_acceleration=7", "rotor.initial.x=0.1 mm",
               "shaft_2.discs[0].mass=2 lb", "shaft_2.speed=50 Hz", "systems.rotor.horizon=3",
               "rotor.integrator=runge_kutta_4", "shaft_2.bearings[1]={node: 2, kxx: 1 kN/mm}"});
  EXPECT_EQ(scene.step, 2000000);
  EXPECT_EQ(scene.systems[0].parameters.at("damping"), 8.0);
  EXPECT_EQ(scene.systems[0].parameters.at("mass"), 0.5);
  EXPECT_EQ(scene.systems[0].q[0], 1e-4);
  EXPECT_EQ(scene.systems[0].horizon, 3.0);
  EXPECT_EQ(scene.systems[0].integrator, "runge_kutta_4");
  EXPECT_DOUBLE_EQ(scene.drives[0].speed, 20.0 * M_PI);
  EXPECT_EQ(scene.drives[0].profile[0].speed, 20.0);
  EXPECT_EQ(scene.drives[0].profile[1].speed, -10.0);
  EXPECT_EQ(scene.drives[0].profile[0].max_acceleration, 7.0);
  EXPECT_EQ(scene.drives[0].profile[1].max_acceleration, 7.0);
  EXPECT_DOUBLE_EQ(scene.systems[2].settings.tables.at("discs")[0].numbers.at("mass"), 0.90718474);
  EXPECT_DOUBLE_EQ(scene.systems[2].settings.tables.at("bearings")[1].numbers.at("kxx"), 1e6);
  EXPECT_DOUBLE_EQ(*scene.systems[2].speed, 100.0 * M_PI);
  EXPECT_EQ(scene.systems[1].parameters.at("damping"), 12.0) << "an alias of a system is not it";
}

TEST(SceneChanges, TheLastOfAPlaceHolds) {
  EXPECT_EQ(changed({"rotor.damping=8", "rotor.damping=9"}).systems[0].parameters.at("damping"),
            9.0);
}

TEST(SceneChanges, AnErrorNamesTheChangeAndItsPlace) {
  EXPECT_EQ(refusal({"rotor.damping=8 kg"}),
            "--set rotor.damping=8 kg: systems.rotor.parameters.damping: must be >= 0 N s/m, found "
            "'8 kg': 'kg' cannot be converted to N s/m");
  EXPECT_NE(refusal({"rotor.dampin=8"})
                .find("--set rotor.dampin=8: systems.rotor.parameters.dampin: unknown parameter of "
                      "jeffcott_rotor; did you mean 'damping'?"),
            std::string::npos)
      << refusal({"rotor.dampin=8"});
  EXPECT_NE(refusal({"shaft_2.bearings[1].kxx=79 lb/in"}).find("write 'lbf/in'"),
            std::string::npos);
  EXPECT_NE(refusal({"rotor.damping="}).find("--set rotor.damping=: systems."), std::string::npos);
}

TEST(SceneChanges, ThatLeadNowhereAreRefused) {
  EXPECT_EQ(
      refusal({"roter.damping=8"}),
      "--set roter.damping=8: there is no system, controller, drive or sensor 'roter'; did you "
      "mean 'rotor'?");
  EXPECT_EQ(
      refusal({"shaft_2.discs[5].mass=8"}),
      "--set shaft_2.discs[5].mass=8: systems.shaft_2.parameters.discs has 1 entries, counted "
      "from 0");
  EXPECT_EQ(refusal({"rotor.damping"}),
            "--set rotor.damping: must be PATH=VALUE, such as rotor.damping=8");
  EXPECT_EQ(refusal({"rotor.damping.x=1"}),
            "--set rotor.damping.x=1: systems.rotor.parameters.damping is 12.0, which has no 'x'");
  for (const char* wrong :
       {"=8", "rotor..damping=8", "rotor=8", "rotor.discs[=8", "[0]=8", "rotor.discs[-1].mass=1",
        ".=1", "shaft.profile[2].speed=1", "rotor.damping=[", "\xff\xfe.\x80=1"}) {
    EXPECT_EQ(refusal({wrong}).rfind("--set ", 0), 0u) << wrong << ": " << refusal({wrong});
  }
}

// The reader of all numbers: options, scenes, studies, settings.

TEST(Quantities, InAnyUnitAreThoseInTheSI) {
  std::mt19937 random(46);
  std::uniform_real_distribution<double> mantissa(-10.0, 10.0);
  std::uniform_int_distribution<int> exponent(-12, 12);
  for (const QuantityUnits& quantity : unitsByQuantity()) {
    for (const char* unit : quantity.units) {
      for (int i = 0; i < 50; ++i) {
        const double number = mantissa(random) * std::pow(10.0, exponent(random));
        const double si = number * unitScale(unit, quantity.unit);
        for (const char* between : {" ", "", "  "}) {
          if (*between == '\0' && unit[0] == '1') {
            continue;  // "51/min"
          }
          const auto read =
              parseQuantity(fmt::format("{}{}{}", number, between, unit), quantity.unit);
          ASSERT_TRUE(read) << number << between << unit;
          EXPECT_NEAR(*read, si, 1e-15 * std::fabs(si)) << number << between << unit;
        }
      }
    }
  }
}

TEST(Quantities, ThatAreNoneAreRefused) {
  EXPECT_DOUBLE_EQ(parseQuantity("800rpm", "rad/s").value(), 800.0 * M_PI / 30.0);
  EXPECT_DOUBLE_EQ(parseQuantity("-8e2 rpm", "rad/s").value(), -800.0 * M_PI / 30.0);
  EXPECT_DOUBLE_EQ(parseQuantity("+.8e+3 r/min", "rad/s").value(), 800.0 * M_PI / 30.0);
  for (const char* wrong : {"",
                            " ",
                            "rpm",
                            "800 rpm 2",
                            "800 rpm rpm",
                            "8,5 rpm",
                            "800 rpm, 900 rpm",
                            "1e308 Mrpm",
                            "1e999",
                            "nan rpm",
                            "inf",
                            "0x10 rpm",
                            "800 kg",
                            "--8 rpm",
                            "8 8 rpm",
                            "8 \xff",
                            "\xc3(",
                            "8 \xc2",
                            "8 \xe2\x80\xaerpm",
                            "1/2 rpm",
                            "8 rpm\n",
                            "8\trpm"}) {
    EXPECT_FALSE(parseQuantity(wrong, "rad/s")) << wrong;
  }
}

TEST(ErrorLists, AreLimited) {
  EXPECT_EQ(errorList({"a", "b"}), "a\nb");
  const std::vector<std::string> many(kMaxErrorsShown + 3, "e");
  const std::string list = errorList(many, "\ntwin: ");
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), static_cast<long>(kMaxErrorsShown));
  EXPECT_EQ(list.substr(list.rfind('\n')), "\ntwin: and 3 more");
  EXPECT_EQ(errorList(std::vector<std::string>(kMaxErrorsShown, "e")).find("more"),
            std::string::npos);
}

TEST(ErrorLists, OfAFileThatIsSomethingElseAreOneLine) {
  for (const char* other :
       {"{alarms: 1, amplitude: {}, zones: {}, delays: {}, rub: 1, voting: 2}",
        "{study: {scene: a.yaml}, vary: {}, design: {}, run: analyze, measure: {}}", "[1, 2, 3]",
        "t,x,y 0,1,2 3,4,5"}) {
    try {
      sceneOf(other);
      ADD_FAILURE() << other;
    } catch (const SceneError& error) {
      EXPECT_EQ(error.errors().size(), 1u) << error.what();
    }
  }
}

}  // namespace scene_changes_test
}  // namespace whirl_twin
