// An invalid scene is rejected with all its errors, each with the file, the key, the expected value
// with its unit, and the value found.
#include <gtest/gtest.h>

#include <ostream>

#include "models/model_registry.h"
#include "scenes.h"

namespace whirl_twin {
namespace broken_scene_test {

using Errors = std::vector<std::string>;

Errors errorsOf(const std::string& yaml) {
  try {
    sceneOf(yaml);
  } catch (const SceneError& error) {
    return error.errors();
  }
  return {};
}

/// A scene of one rotor: its parameters, further keys of the rotor, further keys of the scene.
std::string rotorScene(const std::string& parameters, const std::string& rotor = "",
                       const std::string& scene = "") {
  return "{step: 0.001" + scene + ", systems: {rotor: {model: jeffcott_rotor" + rotor +
         ", parameters: {" + parameters + "}}}}";
}
const std::string kGood = "mass: 1, stiffness: 100, speed: 5";
const std::string kNoSpeed = "mass: 1, stiffness: 100";
const std::string kShaft = ", drives: {shaft: {speed: 1}}";

/// The names a scene can choose from.
std::string modelNames() {
  std::string names;
  for (const ModelInfo& model : models()) {
    names += (names.empty() ? "" : ", ") + model.name;
  }
  return names;
}

struct Broken {
  const char* name;
  std::string yaml;
  Errors errors;  // without "test.yaml: "
};

void PrintTo(const Broken& b, std::ostream* out) {
  *out << b.yaml;
}

class BrokenScene : public testing::TestWithParam<Broken> {};

TEST_P(BrokenScene, IsRefusedWithItsErrors) {
  Errors expected;
  for (const std::string& error : GetParam().errors) {
    expected.push_back("test.yaml: " + error);
  }
  EXPECT_EQ(errorsOf(GetParam().yaml), expected);
}

const auto kNames = [](const auto& test) { return test.param.name; };

INSTANTIATE_TEST_SUITE_P(
    Numbers, BrokenScene,
    testing::Values(
        Broken{"Negative",
               rotorScene("mass: -1, stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found -1"}},
        Broken{"Zero",
               rotorScene("mass: 0, stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found 0"}},
        Broken{"NegativeDamping",
               rotorScene(kGood + ", damping: -2.5"),
               {"systems.rotor.parameters.damping: must be >= 0 N s/m, found -2.5"}},
        Broken{"NaN",
               rotorScene(kGood + ", damping: .nan"),
               {"systems.rotor.parameters.damping: must be >= 0 N s/m, found '.nan'"}},
        Broken{"NaNSpelt",
               rotorScene(kGood + ", eccentricity_angle: nan"),
               {"systems.rotor.parameters.eccentricity_angle: must be a finite number in rad, "
                "found 'nan'"}},
        Broken{"Infinite",
               rotorScene("mass: .inf, stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found '.inf'"}},
        Broken{"InfiniteSpelt",
               rotorScene(kGood + ", damping: infinity"),
               {"systems.rotor.parameters.damping: must be >= 0 N s/m, found 'infinity'"}},
        Broken{"Overflow",
               rotorScene("mass: 1e999, stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found '1e999'"}},
        Broken{"Text",
               rotorScene("mass: heavy, stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found 'heavy'"}},
        Broken{"WithUnit",
               rotorScene("mass: 1 lbf, stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found '1 lbf': 'lbf' cannot be "
                "converted to kg; write 'lb'"}},
        Broken{
            "NamesOfOtherPrograms",
            "{step: 0.001, systems: {r: {model: flexible_rotor, parameters: {E: 2e11, density: "
            "7800, speed: 1, elements: [{L: 1, outer_diameter: 0.1}], bearings: [{node: 0, "
            "n_link: 2}]}}}}",
            {"systems.r.parameters.E: unknown parameter of flexible_rotor; write 'youngs_modulus'",
             "systems.r.parameters.youngs_modulus: missing; must be > 0 Pa",
             "systems.r.parameters.elements[0].L: unknown key of elements; write 'length'",
             "systems.r.parameters.elements[0].length: missing; must be > 0 m",
             "systems.r.parameters.bearings[0].n_link: unknown key of bearings; write "
             "'pedestals'"}},
        Broken{"Hexadecimal",
               rotorScene("mass: 0x10, stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found '0x10': unknown unit 'x10'"}},
        Broken{"List",
               rotorScene("mass: [1], stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found a list"}},
        Broken{"Map",
               rotorScene("mass: {value: 1}, stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found a map"}},
        Broken{"Nothing",
               rotorScene("mass: , stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found nothing"}},
        Broken{"SpeedTooHigh",
               rotorScene(kNoSpeed + ", speed: 2e6"),
               {"systems.rotor.parameters.speed: must be from -1e+06 to 1e+06 rad/s, found 2e6"}},
        Broken{"StepTooSmall",
               "{step: 1e-10, systems: {a: {model: double_pendulum, parameters: "
               "{mass1: 1, mass2: 1, length1: 1, length2: 1}}}}",
               {"step: must be from 1e-09 to 10 s, found 1e-10"}},
        Broken{"StepNotWholeNanoseconds",
               "{step: 1.0000005e-3, systems: {a: {model: double_pendulum, parameters: "
               "{mass1: 1, mass2: 1, length1: 1, length2: 1}}}}",
               {"step: must be a whole number of nanoseconds, found 0.0010000005 s; nearest "
                "0.001000001 s"}},
        Broken{"Gravity",
               rotorScene(kGood, "", ", gravity: -9.8"),
               {"gravity: must be >= 0 m/s^2, found -9.8"}},
        Broken{"Substeps",
               rotorScene(kGood, ", substeps: 1.5"),
               {"systems.rotor.substeps: must be a whole number from 1 to 1000000, found 1.5"}},
        Broken{"NoSubsteps",
               rotorScene(kGood, ", substeps: 0"),
               {"systems.rotor.substeps: must be a whole number from 1 to 1000000, found 0"}},
        Broken{"Tolerance",
               rotorScene(kGood, ", tolerance: 0"),
               {"systems.rotor.tolerance: must be > 0, found 0"}},
        Broken{"Initial",
               rotorScene(kGood, ", initial: {x: here}"),
               {"systems.rotor.initial.x: must be a finite number in m, found 'here'"}},
        Broken{"ControlCharacters",
               rotorScene("mass: \"\\e[31m\", stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: must be > 0 kg, found '\\x1b[31m'"}}),
    kNames);

INSTANTIATE_TEST_SUITE_P(
    Keys, BrokenScene,
    testing::Values(
        Broken{"MisspeltParameter",
               rotorScene(kGood + ", dampin: 1"),
               {"systems.rotor.parameters.dampin: unknown parameter of jeffcott_rotor; did you "
                "mean 'damping'?"}},
        Broken{"ParameterOfAnotherModel",
               rotorScene(kGood + ", pole_count: 1"),
               {"systems.rotor.parameters.pole_count: unknown parameter of jeffcott_rotor"}},
        Broken{"MisspeltKeyOfSystem",
               rotorScene(kGood, ", integrater: auto"),
               {"systems.rotor.integrater: unknown key of a system; did you mean 'integrator'?"}},
        Broken{"MisspeltKeyOfScene",
               rotorScene(kGood, "", ", gravitiy: 9.8"),
               {"gravitiy: unknown key of a scene; did you mean 'gravity'?"}},
        Broken{"MisspeltCoordinate",
               rotorScene(kGood, ", initial: {x_rat: 1}"),
               {"systems.rotor.initial.x_rat: unknown coordinate of jeffcott_rotor; did you mean "
                "'x_rate'?"}},
        Broken{"Missing",
               rotorScene("mass: 1, speed: 5"),
               {"systems.rotor.parameters.stiffness: missing; must be > 0 N/m"}},
        Broken{"MissingStep",
               "{systems: {a: {model: jeffcott_rotor, parameters: {" + kGood + "}}}}",
               {"step: missing; must be from 1e-09 to 10 s"}},
        Broken{
            "MissingModel",
            "{step: 1, systems: {a: {parameters: {mass: 1}}}}",
            {"systems.a.model: missing; must be the name of a model, as listed by `twin models`"}},
        Broken{"Twice",
               rotorScene("mass: 1, mass: 2, stiffness: 100, speed: 5"),
               {"systems.rotor.parameters.mass: duplicate key"}},
        Broken{"KeyIsAList",
               rotorScene(kGood, "", ", [1, 2]: 3"),
               {"a key must be a name, found a list"}},
        Broken{"UnknownModel",
               "{step: 1, systems: {a: {model: jeffcot_rotor}}}",
               {"systems.a.model: must be the name of a model, found 'jeffcot_rotor'; did you mean "
                "'jeffcott_rotor'?"}},
        Broken{"UnheardOfModel",
               "{step: 1, systems: {a: {model: gyroscope}}}",
               {"systems.a.model: must be the name of a model, found 'gyroscope'; there are: " +
                modelNames()}},
        Broken{"UnknownIntegrator",
               rotorScene(kGood, ", integrator: rungekutta4"),
               {"systems.rotor.integrator: must be the name of an integrator, found 'rungekutta4'; "
                "did you mean 'runge_kutta_4'?"}},
        Broken{"NoSystems", "{step: 1}", {"systems: missing; a scene needs at least one system"}},
        Broken{"EmptySystems",
               "{step: 1, systems: {}}",
               {"systems: a scene needs at least one system, found none"}},
        Broken{"SystemsAreAList",
               "{step: 1, systems: [1, 2]}",
               {"systems: must be a map of keys and values, found a list"}},
        Broken{"SystemIsANumber",
               "{step: 1, systems: {a: 3}}",
               {"systems.a: must be a map of keys and values, found 3"}},
        Broken{"SceneIsAList", "[1, 2]", {"must be a map of keys and values, found a list"}},
        Broken{"BadName",
               "{step: 1, systems: {2a: {model: jeffcott_rotor, parameters: {" + kGood + "}}}}",
               {"systems.2a: the name of a system must have at most 48 letters, digits and _, a "
                "letter first"}},
        Broken{"NamesThatDifferInCaseOnly",
               "{step: 1, systems: {Rotor: &r {model: jeffcott_rotor, parameters: {" + kGood +
                   "}}, rotor: *r}}",
               {"systems.rotor: duplicate: another system has this name (upper and lower case are "
                "the same)"}}),
    kNames);

INSTANTIATE_TEST_SUITE_P(
    Drives, BrokenScene,
    testing::Values(
        Broken{"NeitherSpeedNorDrive",
               rotorScene(kNoSpeed),
               {"systems.rotor.parameters.speed: missing; must be a finite number in rad/s, unless "
                "the key drive of the system names one"}},
        Broken{"BothSpeedAndDrive",
               rotorScene(kGood, ", drive: shaft", kShaft),
               {"systems.rotor.parameters.speed: the drive sets the speed: give drive or speed, "
                "not both"}},
        Broken{"UnknownDrive",
               rotorScene(kNoSpeed, ", drive: shift", kShaft),
               {"systems.rotor.drive: must be a drive of the scene, found 'shift'; did you mean "
                "'shaft'?"}},
        Broken{"NoDrives",
               rotorScene(kNoSpeed, ", drive: shaft"),
               {"systems.rotor.drive: the scene has no drives"}},
        Broken{"NoShaft",
               "{step: 1, drives: {shaft: {}}, systems: {a: {model: double_pendulum, drive: shaft, "
               "parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}}}}",
               {"systems.a.drive: double_pendulum has no shaft to drive"}},
        Broken{"SpeedWithoutShaft",
               "{step: 1, systems: {a: {model: double_pendulum, "
               "parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1, speed: 3}}}}",
               {"systems.a.parameters.speed: unknown parameter of double_pendulum"}},
        Broken{"ProfileIsAMap",
               rotorScene(kNoSpeed, ", drive: shaft", ", drives: {shaft: {profile: {speed: 1}}}"),
               {"drives.shaft.profile: must be a list of moves, found a map"}},
        Broken{
            "MoveWithoutLimit",
            rotorScene(kNoSpeed, ", drive: shaft",
                       ", drives: {shaft: {profile: [{speed: 1, max_acceleration: 0}, {speed: 2, "
                       "max_acceleration: 1, max_jerk: -1, dwell: -2}]}}"),
            {"drives.shaft.profile[0].max_acceleration: must be > 0 rad/s^2, found 0",
             "drives.shaft.profile[1].max_jerk: must be > 0 rad/s^3, found -1",
             "drives.shaft.profile[1].dwell: must be from 0 to 1e+09 s, found -2"}},
        Broken{"Avoid",
               rotorScene(kNoSpeed, ", drive: shaft",
                          ", drives: {shaft: {speed: 101, profile: [{speed: 20, max_acceleration: "
                          "1}, {speed: 53, max_acceleration: 5, max_jerk: 2}], avoid: {bands: "
                          "[{from: 100, to: 120}, {from: 40, to: 50}, {from: 56, to: 70}]}}}"),
               {"drives.shaft.speed: must be outside the barred speed range from 100 to 120 rad/s, "
                "found 101",
                "drives.shaft.profile[1].speed: must be outside the barred speed range from 40 to "
                "70 rad/s, found 53"}},
        Broken{"AvoidWhatIsNoBand",
               rotorScene(kNoSpeed, ", drive: shaft",
                          ", drives: {shaft: {avoid: {bands: [{from: 0, to: 5}, {from: 7, to: 6}, "
                          "{from: 1}], margin: 2, critical_speed: true}}}"),
               {"drives.shaft.avoid.critical_speed: unknown key of barred speeds; did you mean "
                "'critical_speeds'?",
                "drives.shaft.avoid.bands[0].from: must be > 0 rad/s, found 0",
                "drives.shaft.avoid.bands[1].to: must be greater than from, 7 rad/s, found 6",
                "drives.shaft.avoid.bands[2].to: missing; must be from 0 to 1e+06 rad/s",
                "drives.shaft.avoid.margin: must be from 0.001 to 0.9 of a critical speed, found 2",
                "drives.shaft.avoid.margin: needs critical_speeds: true"}},
        Broken{"MotorAvoids",
               rotorScene(kNoSpeed + ", polar_inertia: 1", ", drive: shaft",
                          ", drives: {shaft: {motor: {torque: 1}, avoid: {bands: []}}}"),
               {"drives.shaft.avoid: must not be given with a motor, whose speed is not "
                "prescribed: give avoid or critical_speeds to a controller of type speed"}},
        Broken{"Motor",
               rotorScene(kNoSpeed, ", drive: shaft", ", drives: {shaft: {motor: {torque: 1}}}"),
               {"systems.rotor.parameters.polar_inertia: must be > 0 kg m^2 with a motor"}},
        Broken{"ExponentialForAPendulum",
               "{step: 1, systems: {a: {model: spinning_pendulum, integrator: exponential, "
               "parameters: {mass: 1, length: 1, speed: 1}}}}",
               {"systems.a.integrator: exponential is for linear systems; spinning_pendulum is not "
                "linear"}},
        Broken{"ExponentialInTheTurningFrameOfADrive",
               "{step: 0.001, drives: {shaft: {speed: 1}}, systems: {rotor: {model: "
               "rigid_disc_rotor, drive: shaft, integrator: exponential, parameters: {mass: 1, "
               "polar_inertia: 1, transverse_inertia: 1, stiffness_displacement: 1, "
               "stiffness_rotation: 1, frame: rotating}}}}",
               {"systems.rotor.integrator: exponential needs matrices independent of the drive's "
                "speed; use gauss_legendre_6 or runge_kutta_4"}}),
    kNames);

TEST(BrokenSceneWithManyErrors, NamesThemAllAtOnce) {
  const Errors errors = errorsOf(
      "{stepp: 1, gravity: -1, drives: {d: {speed: fast}}, systems: {a: {model: jeffcott_rotor, "
      "parameters: {mass: 0, speed: 1}}, b: {model: nothing}}}");
  EXPECT_EQ(errors,
            (Errors{"test.yaml: stepp: unknown key of a scene; did you mean 'step'?",
                    "test.yaml: step: missing; must be from 1e-09 to 10 s",
                    "test.yaml: gravity: must be >= 0 m/s^2, found -1",
                    "test.yaml: drives.d.speed: must be from -1e+06 to 1e+06 rad/s, found 'fast'",
                    "test.yaml: systems.a.parameters.mass: must be > 0 kg, found 0",
                    "test.yaml: systems.a.parameters.stiffness: missing; must be > 0 N/m",
                    "test.yaml: systems.b.model: must be the name of a model, found 'nothing'; "
                    "there are: " +
                        modelNames()}));
}

}  // namespace broken_scene_test
}  // namespace whirl_twin
