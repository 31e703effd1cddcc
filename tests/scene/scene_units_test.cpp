// Numbers of a scene with explicit units: converted once, where they are read.
#include <gtest/gtest.h>

#include <set>

#include "controllers/controller_registry.h"
#include "messages/units.h"
#include "models/model_registry.h"
#include "scene/node_reader.h"
#include "scenes.h"

namespace whirl_twin {
namespace scene_units_test {

TEST(SceneUnits, AMachineInItsDrawingsUnitsIsTheMachineInSI) {
  const Scene drawn = sceneOf(
      "{step: 1 ms, drives: {shaft: {speed: 3000 rpm, profile: [{speed: 50 Hz, max_acceleration: "
      "100 rpm/s, max_jerk: 1 rad/s^3, dwell: 2 min}]}}, systems: {rotor: {model: jeffcott_rotor, "
      "drive: shaft, parameters: {mass: 2200 g, stiffness: 10 kN/mm, damping: 2 lbf s/in, "
      "eccentricity: 50um}, initial: {x: 0.1 mm, y_rate: -2 mm/s}}}}");
  const Scene si = sceneOf(
      "{step: 0.001, drives: {shaft: {speed: 314.1592653589793, profile: [{speed: "
      "314.1592653589793, max_acceleration: 10.471975511965978, max_jerk: 1, dwell: 120}]}}, "
      "systems: {rotor: {model: jeffcott_rotor, drive: shaft, parameters: {mass: 2.2, stiffness: "
      "1e7, damping: 350.25367, eccentricity: 5e-5}, initial: {x: 1e-4, y_rate: -2e-3}}}}");
  EXPECT_EQ(drawn.step, si.step);
  for (const auto& [name, value] : si.systems[0].parameters) {
    EXPECT_NEAR(drawn.systems[0].parameters.at(name), value, 1e-8 * std::abs(value)) << name;
  }
  EXPECT_DOUBLE_EQ(drawn.systems[0].q[0], si.systems[0].q[0]);
  EXPECT_DOUBLE_EQ(drawn.systems[0].v[1], si.systems[0].v[1]);
  EXPECT_DOUBLE_EQ(drawn.drives[0].speed, si.drives[0].speed);
  EXPECT_DOUBLE_EQ(drawn.drives[0].profile[0].speed, si.drives[0].profile[0].speed);
  EXPECT_DOUBLE_EQ(drawn.drives[0].profile[0].max_acceleration,
                   si.drives[0].profile[0].max_acceleration);
  EXPECT_DOUBLE_EQ(drawn.drives[0].profile[0].dwell, si.drives[0].profile[0].dwell);
}

TEST(SceneUnits, StandInTablesAndMatrices) {
  const Scene scene = sceneOf(
      "{step: 0.001, systems: {s: {model: linear_system, parameters: {names: [x], mass: [[500 g]], "
      "stiffness: [[2 N/mm]]}}, r: {model: flexible_rotor, parameters: {speed: 3000 rpm, "
      "youngs_modulus: 210 "
      "GPa, density: 7.8 g/cm^3, elements: [{length: 250 mm, outer_diameter: 30 mm}, {length: 10 "
      "in, outer_diameter: 30 mm}], bearings: [{node: 0, kxx: 1e3 lbf/in}, {node: 2, kxx: "
      "1 kN/mm}]}}}}");
  EXPECT_DOUBLE_EQ(scene.systems[0].settings.matrices.at("mass")(0, 0), 0.5);
  EXPECT_DOUBLE_EQ(scene.systems[0].settings.matrices.at("stiffness")(0, 0), 2000.0);
  const auto& elements = scene.systems[1].settings.tables.at("elements");
  EXPECT_DOUBLE_EQ(elements[0].numbers.at("length"), 0.25);
  EXPECT_DOUBLE_EQ(elements[1].numbers.at("length"), 0.254);
  const auto& bearings = scene.systems[1].settings.tables.at("bearings");
  EXPECT_NEAR(bearings[0].numbers.at("kxx"), 175126.8, 0.05);
  EXPECT_DOUBLE_EQ(bearings[0].numbers.at("kyy"), bearings[0].numbers.at("kxx")) << "follows";
  EXPECT_DOUBLE_EQ(scene.systems[1].speed.value(), 3000.0 * M_PI / 30.0);
}

TEST(SceneUnits, ThatDoNotFitAreToldAsSuch) {
  try {
    sceneOf(
        "{step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: {mass: 2 lbf, "
        "stiffness: 100 N/mn, damping_ratio: 5 mm, speed: 50 1/s, eccentricity: 1 2}}}}");
    FAIL();
  } catch (const SceneError& error) {
    std::string all;
    for (const std::string& one : error.errors()) {
      all += one + "\n";
    }
    EXPECT_NE(all.find("found '2 lbf': 'lbf' cannot be converted to kg"), std::string::npos) << all;
    EXPECT_NE(all.find("found '100 N/mn': unknown unit 'N/mn'"), std::string::npos) << all;
    EXPECT_NE(all.find("found '50 1/s': '1/s' cannot be converted to rad/s"), std::string::npos)
        << all;
    EXPECT_NE(all.find("found '1 2': unknown unit '2'"), std::string::npos) << all;
  }
}

TEST(SceneUnits, ARangeIsThatOfTheConvertedNumber) {
  const auto speed = [](const std::string& written) {
    return sceneOf(
               "{step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: {mass: 1, "
               "stiffness: 100, speed: " +
               written + "}}}}")
        .systems[0]
        .speed.value();
  };
  EXPECT_DOUBLE_EQ(speed("9 Mrpm"), 9e6 * M_PI / 30.0);
  EXPECT_THROW(speed("10 Mrpm"), SceneError) << "beyond 1e6 rad/s";
  EXPECT_THROW(speed("1e308 Mrpm"), SceneError);
}

/// Units of numbers that models and controllers take.
std::set<std::string> units() {
  std::set<std::string> all;
  const auto add = [&](const auto& info) {
    for (const ParameterInfo& parameter : info.parameters) {
      all.insert(parameter.unit);
    }
    for (const SettingInfo& setting : info.settings) {
      for (const ColumnInfo& column : setting.columns) {
        all.insert(column.unit);
      }
    }
  };
  for (const ModelInfo& model : models()) {
    add(model);
  }
  for (const ControllerInfo& controller : controllers()) {
    add(controller);
  }
  return all;
}

TEST(SceneUnits, EveryUnitThatIsAskedForCanBeWritten) {
  for (const std::string& unit : units()) {
    const bool of_signals = unit.find("measured") != std::string::npos ||
                            unit.find("output") != std::string::npos || unit == "-";
    if (!of_signals) {
      EXPECT_TRUE(isUnit(unit)) << unit;
      EXPECT_EQ(parseQuantity("2.5 " + unit, unit), 2.5) << unit;
    }
    EXPECT_EQ(parseQuantity("2.5", unit), 2.5) << unit;
  }
}

}  // namespace scene_units_test
}  // namespace whirl_twin
