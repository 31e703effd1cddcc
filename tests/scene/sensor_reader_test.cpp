// The sensors of a scene: valid settings, and rejected ones with their error texts.
#include "scene/sensor_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "scene/scene_error.h"
#include "scenes.h"

namespace whirl_twin {
namespace sensor_reader_test {

Scene with(const std::string& sensors) {
  return sceneOf(std::string(kThreeSystems) + "sensors: " + sensors + "\n");
}

std::string diagnosticsOf(const std::string& sensors) {
  try {
    with(sensors);
  } catch (const SceneError& error) {
    return fmt::format("{}", fmt::join(error.errors(), "\n"));
  }
  return "";
}

TEST(SensorReader, ReadsWhatIsSaid) {
  const Scene scene = with(
      "{probes: {rate: 2000.0, seed: 5, block: 0.2, channels: {a: {measures: rotor, direction: "
      "0.8, "
      "noise: 3.0e-6, resolution: 1.0e-7, range: 1.0e-3, bandwidth: 500.0, delay: 1.0e-4, run_out: "
      "1.0e-5, run_out_angle: 0.4}, b: {measures: arms.theta2_rate}}}, tacho: {keyphasor: shaft, "
      "mark: 0.2, jitter: 1.0e-6}}");
  ASSERT_EQ(scene.sensors.size(), 2u);
  const SensorSpec& probes = scene.sensors[0];
  EXPECT_EQ(probes.rate, 2000.0);
  EXPECT_EQ(probes.seed, 5u);
  EXPECT_EQ(probes.block, 0.2);
  ASSERT_EQ(probes.channels.size(), 2u);
  EXPECT_EQ(probes.channels[0].signal.direction, 0.8);
  EXPECT_EQ(probes.channels[0].sensor.delay, 1.0e-4);
  EXPECT_EQ(probes.channels[0].run_out.angle, 0.4);
  EXPECT_EQ(probes.channels[1].signal.kind, SignalSpec::Kind::kRate);
  EXPECT_EQ(probes.channels[1].signal.system, 2u);
  EXPECT_EQ(probes.channels[1].signal.unit, "rad/s");
  ASSERT_TRUE(scene.sensors[1].keyphasor.has_value());
  EXPECT_EQ(scene.sensors[1].keyphasor->mark, 0.2);
}

TEST(SensorReader, NamesEveryMistakeAtOnce) {
  const std::string all = diagnosticsOf(
      "{probes: {rat: 2000.0, channels: {a: {measures: rotr.x, nois: 1.0}, b: {measures: "
      "governor.theta, run_out: 1.0e-5}, c: {}}}, tacho: {keyphasor: shat, rate: 5.0}, Probes: "
      "{rate: 0.0, channels: {}}}");
  for (const char* part :
       {"sensors.probes.rat: unknown key of sensors; did you mean 'rate'?",
        "sensors.probes.rate: missing",
        "sensors.probes.channels.a.measures: must be SYSTEM.COORDINATE, SYSTEM.COORDINATE_rate, "
        "SYSTEM or SYSTEM.STATION (a displacement, also with .x or .y), found 'rotr.x'; did you "
        "mean 'rotor.x'?",
        "sensors.probes.channels.a.nois: unknown key of a sensor; did you mean 'noise'?",
        "sensors.probes.channels.b.run_out: needs a displacement probe on a rotor",
        "sensors.probes.channels.c.measures: missing",
        "sensors.tacho.keyphasor: must be a drive of the scene, found 'shat'; did you mean "
        "'shaft'?",
        "sensors.tacho.rate: must not be given with a keyphasor",
        "sensors.Probes: duplicate: other sensors have this name (upper and lower case are the "
        "same)",
        "sensors.Probes.rate: must be from 0.001",
        "sensors.Probes.channels: sensors need at least"}) {
    EXPECT_NE(all.find(part), std::string::npos) << part << "\n" << all;
  }
}

// Whole turns and nanoseconds are counted in 64 bits.
TEST(SensorReader, AKeyphasorMarksATurnAndStampsAnInstant) {
  for (const std::string& key : {std::string("mark"), std::string("jitter")}) {
    try {
      sceneOf(
          "{step: 0.001, drives: {shaft: {speed: 50}}, systems: {rotor: {model: jeffcott_rotor, "
          "drive: shaft, parameters: {mass: 1, stiffness: 1.0e+4}}}, sensors: {tacho: {keyphasor: "
          "shaft, " +
          key + ": 1.0e+300}}}");
      FAIL() << key;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find("sensors.tacho." + key + ": must be from "),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(SensorReader, StationsHaveNamesThatNoSystemHas) {
  const std::string shaft =
      "{step: 0.001, systems: {rotor: {model: flexible_rotor, parameters: {youngs_modulus: "
      "2.1e+11, "
      "density: 7800, speed: 50, modes: 4, elements: [{length: 0.1, outer_diameter: 0.05, count: "
      "4}], "
      "bearings: "
      "[{node: 0, kxx: 1.0e+7, kyy: 1.0e+7}, {node: 4, kxx: 1.0e+7, kyy: 1.0e+7}], stations: "
      "[{node: "
      "1}, {node: 3}]}}";
  EXPECT_NO_THROW(sceneOf(shaft + "}}"));
  try {
    sceneOf(shaft +
            ", Rotor_node_3: {model: double_pendulum, parameters: {mass1: 1, mass2: 1, "
            "length1: 1, length2: 1}}}}");
    FAIL() << "two systems of one name";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("systems.rotor.parameters.stations: is published as "
                        "rotor_node_3"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace sensor_reader_test
}  // namespace whirl_twin
