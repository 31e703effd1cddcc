// Inputs in scene files: numbers, harmonics, tables from files beside the scene, and their errors,
// each with key, unit, file, line and column.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene/input_reader.h"
#include "scenes.h"

namespace whirl_twin {
namespace scene_inputs_test {

using Errors = std::vector<std::string>;

class SceneInputs : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() /
        ("whirl_twin_inputs_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
         "_" + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path) << text;
    return path;
  }
  /// A scene of arms with these inputs, in a file of the folder.
  std::string scene(const std::string& inputs) const {
    return write("scene.yaml",
                 "{step: 0.001, systems: {arms: {model: double_pendulum, inputs: " + inputs +
                     ", parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}}}}");
  }
  SystemSpec read(const std::string& inputs) const {
    return readSceneFile(scene(inputs)).systems.front();
  }
  /// Without the name of the file.
  Errors errorsOf(const std::string& inputs) const {
    try {
      read(inputs);
    } catch (const SceneError& error) {
      Errors all;
      for (const std::string& one : error.errors()) {
        all.push_back(one.substr((folder_ / "scene.yaml: ").string().size()));
      }
      return all;
    }
    return {};
  }
  std::string in(const std::string& file) const { return (folder_ / file).string(); }

  std::filesystem::path folder_;
};

TEST_F(SceneInputs, AreNumbersHarmonicsAndTables) {
  write("torque.csv", "time, tau, other\r\n0.0,1.5,9\r\n0.25,-2,9\r\n\r\n1,3e-1,9\r\n");
  const SystemSpec spec = read(
      "{torque1: {amplitude: 2, frequency: 61.0, phase: 0.4},"
      " torque2: {table: torque.csv, value: tau, hold: true}}");
  ASSERT_EQ(spec.inputs.size(), 2u);
  const InputSignal& harmonic = spec.inputs.at("torque1");
  EXPECT_EQ(harmonic.kind, InputSignal::Kind::kHarmonic);
  EXPECT_EQ(harmonic.amplitude, 2.0);
  EXPECT_EQ(harmonic.frequency, 61.0);
  EXPECT_EQ(harmonic.phase, 0.4);
  const InputSignal& table = spec.inputs.at("torque2");
  EXPECT_EQ(table.kind, InputSignal::Kind::kTable);
  EXPECT_TRUE(table.hold);
  EXPECT_EQ(table.instants, (std::vector<std::int64_t>{0, 250000000, 1000000000}));
  EXPECT_EQ(table.values, (std::vector<double>{1.5, -2.0, 0.3}));

  const SystemSpec constant = read("{torque2: -3.5}");
  EXPECT_EQ(constant.inputs.at("torque2").value, -3.5);
  const auto signals =
      signalsOf({{"torque1", "N m", {}, ""}, {"torque2", "N m", {}, ""}}, constant.inputs);
  EXPECT_EQ(signals[0].kind, InputSignal::Kind::kNone);
  EXPECT_EQ(signals[1].value, -3.5);
  EXPECT_THROW(signalsOf({{"force", "N", {}, ""}}, constant.inputs), std::logic_error);
  EXPECT_TRUE(read("{}").inputs.empty());
}

TEST_F(SceneInputs, OfMatricesAreNamedAfterTheCoordinates) {
  const Scene scene = sceneOf(
      "{step: 0.001, systems: {two: {model: linear_system, inputs: {force_b: 2},"
      " parameters: {mass: [[1, 0], [0, 1]], stiffness: [[2, 0], [0, 2]], names: [a, b]}}}}");
  EXPECT_EQ(scene.systems.front().inputs.at("force_b").value, 2.0);
}

TEST_F(SceneInputs, OneMayLackWhatItNeeds) {
  EXPECT_EQ(
      errorsOf("{torque1: {frequency: 2}, torque2: {amplitude: .inf, frequency: 1e9}}"),
      (Errors{"systems.arms.inputs.torque1.amplitude: missing; must be a finite number in N m",
              "systems.arms.inputs.torque2.amplitude: must be a finite number in N m, found "
              "'.inf'",
              "systems.arms.inputs.torque2.frequency: must be from -1e+06 to 1e+06 rad/s, "
              "found 1e9"}));
  EXPECT_EQ(errorsOf("{torqe1: 1}"),
            (Errors{"systems.arms.inputs.torqe1: unknown input of this model; did you mean "
                    "'torque1'?"}));
  EXPECT_EQ(errorsOf("{torque1: [1, 2]}"),
            (Errors{"systems.arms.inputs.torque1: must be a number (N m), {amplitude, frequency, "
                    "phase}, {times, values, hold} or {table, time, value, hold}, found a list"}));
  EXPECT_EQ(errorsOf("{torque1: {amplitude: 1, frequncy: 2, frequency: 1}}"),
            (Errors{"systems.arms.inputs.torque1.frequncy: unknown key of a harmonic; did you mean "
                    "'frequency'?"}));
}

TEST_F(SceneInputs, TablesStandInTheSceneToo) {
  const InputSignal table =
      read("{torque1: {times: [0.5, 1, 2.25], values: [0, 3, -1]}}").inputs.at("torque1");
  EXPECT_EQ(table.kind, InputSignal::Kind::kTable);
  EXPECT_FALSE(table.hold);
  EXPECT_EQ(table.instants, (std::vector<std::int64_t>{500000000, 1000000000, 2250000000}));
  EXPECT_EQ(table.values, (std::vector<double>{0.0, 3.0, -1.0}));
  const std::string at = "systems.arms.inputs.torque1.";
  EXPECT_EQ(errorsOf("{torque1: {times: [0, x], values: []}}"),
            (Errors{at + "times[1]: must be a finite number in s, found 'x'",
                    at + "values: must be a list of numbers in N m, found an empty one"}));
  EXPECT_EQ(errorsOf("{torque1: {times: [0, 1]}}"),
            (Errors{at + "values: must be a list of numbers in N m, found nothing"}));
  EXPECT_EQ(errorsOf("{torque1: {times: [0, 1], values: [1, 2, 3]}}"),
            (Errors{at + "values: must have as many entries as times, 2, found 3"}));
  EXPECT_EQ(
      errorsOf("{torque1: {times: [0, 1, 1], values: [1, 2, 3]}}"),
      (Errors{at +
              "times: row 3: the time must increase from row to row by at least 1 ns, found 1 s"}));
}

// ZV without damping: half at once, half after half a period, pi / 2 s at 2 rad/s.
TEST_F(SceneInputs, GoThroughAShaper) {
  const std::string table = "{torque1: {times: [0, 1], values: [0, 4], hold: true, shaper: ";
  const InputSignal shaped = read(table + "{type: zv, frequency: 2}}}").inputs.at("torque1");
  EXPECT_EQ(shaped.instants, (std::vector<std::int64_t>{0, 1000000000, 1570796327, 2570796327}));
  EXPECT_EQ(shaped.values, (std::vector<double>{0.0, 2.0, 2.0, 4.0}));
  EXPECT_EQ(read(table + "{type: zvd, frequency: 2, damping_ratio: 0.1}}}")
                .inputs.at("torque1")
                .instants.size(),
            6u);
  const std::string at = "systems.arms.inputs.torque1.shaper.";
  EXPECT_EQ(errorsOf(table + "{type: zw, damping_ratio: 1}}}"),
            (Errors{at + "type: must be a shaper, found 'zw'; did you mean 'zv'?",
                    at + "frequency: missing; must be from 1e-06 to 1e+06 rad/s",
                    at + "damping_ratio: must be from 0 to 0.999, found 1"}));
}

TEST_F(SceneInputs, TableMayBeWrong) {
  const auto errors = [&](const std::string& text) {
    write("torque.csv", text);
    const Errors all = errorsOf("{torque2: {table: torque.csv, time: t, value: tau}}");
    const std::string start = "systems.arms.inputs.torque2.table: " + in("torque.csv") + ": ";
    EXPECT_EQ(all.size(), 1u);
    EXPECT_EQ(all.front().substr(0, start.size()), start);
    return all.front().substr(start.size());
  };
  EXPECT_EQ(errors(""),
            "must have the names of the columns in its first line, found an empty file");
  EXPECT_EQ(errors("t,taw\n0,1\n"), "no column 'tau'; did you mean 'taw'?");
  EXPECT_EQ(errors("t,tau,,x, tau,x,\"tau\",\n0,1,2,3,4,5,6,7\n"),
            "line 1: column names must be unique; columns 2, 5 and 7 are named 'tau'; columns 4 "
            "and 6 are named 'x'");
  std::string many = "t,tau";
  for (int i = 0; i < 5000; ++i) {
    many += fmt::format(",c{},x,c{}", i, i);
  }
  EXPECT_LT(errors(many + "\n").size(), 1000u);
  EXPECT_EQ(errors("t,tau\n"), "no rows below the names of the columns");
  EXPECT_EQ(errors("t,tau\n0,1\n1,abc\n"), "line 3: tau must be a finite number, found 'abc'");
  EXPECT_EQ(errors("t,tau\n0,1\n1\n"), "line 3: tau must be a finite number, found nothing");
  EXPECT_EQ(errors("t,tau\n0,1\n0.5,1\n0.5,2\n"),
            "row 3: t must increase from row to row by at least 1 ns, found 0.5 s");
  EXPECT_EQ(errors("t,tau\n1e12,1\n"), "row 1: t must be within +-1e9 s, found 1000000000000 s");
  EXPECT_EQ(errorsOf("{torque2: {table: none.csv}}"),
            (Errors{"systems.arms.inputs.torque2.table: " + in("none.csv") + ": no such file"}));
}

TEST_F(SceneInputs, SceneWithoutAFolderNeedsAbsolutePaths) {
  const std::string path = write("torque.csv", "time,value\n0,1\n");
  const auto scene = [](const std::string& table) {
    return sceneOf(
        "{step: 0.001, systems: {arms: {model: double_pendulum, inputs: {torque1: {table: " +
        table + "}}, parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}}}}");
  };
  EXPECT_EQ(scene(path).systems.front().inputs.at("torque1").values.size(), 1u);
  EXPECT_THROW(scene("torque.csv"), SceneError);
}

}  // namespace scene_inputs_test
}  // namespace whirl_twin
