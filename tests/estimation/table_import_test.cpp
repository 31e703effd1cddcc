// Tables and UFF files of a machine as its messages: displacements from volts, pulses from the
// voltage of a keyphasor at instants known in closed form.
#include "estimation/table_import.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "../tools/twin_program.h"
#include "algebra/constants.h"
#include "estimation/uff_file.h"
#include "messages/input_error.h"
#include "scene/scene_reader.h"
#include "scene/yaml_file.h"

namespace whirl_twin {
namespace table_import_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

const char* const kScene = R"(
name: machine
step: 0.001
drives: {shaft: {speed: 50.0}}
systems:
  rotor: {model: jeffcott_rotor, drive: shaft, parameters: {mass: 10.0, stiffness: 1.44e+5, damping: 120.0, eccentricity: 3.0e-5}}
sensors:
  probes:
    rate: 1000.0
    channels:
      x: {measures: rotor.x, noise: 3.0e-7}
      y: {measures: rotor.y, noise: 3.0e-7}
  tacho: {keyphasor: shaft}
)";

std::vector<EstimatorSource> sources() {
  return estimatorSources(
      readScene(readYamlText(kScene, "machine.yaml", "a scene", "systems"), "machine.yaml"), {});
}

constexpr int kRows = 3000;
constexpr double kRate = 1000.0;    // Hz
constexpr double kSpeed = 6.1;      // turns per second
constexpr double kRadius = 2.0e-5;  // m

double turnsAt(int row) {
  return kSpeed * row / kRate + 0.3;
}
double xAt(int row) {
  return kRadius * std::cos(kTwoPi * turnsAt(row));
}
double yAt(int row) {
  return kRadius * std::sin(kTwoPi * turnsAt(row));
}
/// Falls from -2 V to -10 V within a hundredth of a turn, at -6 V where the turn begins, and rises
/// after a tenth of one.
double voltsAt(int row) {
  const double part = turnsAt(row) - std::round(turnsAt(row));
  const double slope = std::min(std::max((part + 0.005) / 0.01, 0.0), 1.0);
  return part > 0.1 ? -2.0 : -2.0 - 8.0 * slope;
}

/// In um, with a tachometer in V.
std::string plainTable() {
  std::string text = "time,x [um],y [um],keyphasor [V]\n";
  for (int row = 0; row < kRows; ++row) {
    text += fmt::format("{:.3f},{:.4f},{:.4f},{:.3f}\n", row / kRate, 1.0e6 * xAt(row),
                        1.0e6 * yAt(row), voltsAt(row));
  }
  return text;
}

struct Imported {
  std::vector<std::int64_t> pulses, instants;  // ns
  std::vector<double> x, y;                    // m
  std::vector<std::uint8_t> valid;             // of x
  std::vector<std::string> remarks;
};

Imported import(const std::string& text, const std::string& settings = "",
                const std::string& name = "run.csv") {
  const TemporaryDirectory folder;
  TableImport table(folder.write(name, text),
                    settings.empty() ? ImportSettings()
                                     : readImportSettings(folder.write("import.yaml", settings)),
                    sources());
  Imported all;
  for (auto messages = table.next(); !messages.empty(); messages = table.next()) {
    for (const state::Measurement& message : messages) {
      for (std::int64_t i = 0; i < message.samples; ++i) {
        if (message.source == "tacho") {
          all.pulses.push_back(message.instantOf(i));
          continue;
        }
        const auto at = static_cast<std::size_t>(2 * i);
        all.instants.push_back(message.instantOf(i));
        all.x.push_back(message.value[at]);
        all.y.push_back(message.value[at + 1]);
        all.valid.push_back(message.valid[at]);
        EXPECT_THAT(message.unit, ElementsAre("m", "m"));
        EXPECT_NEAR(message.deviation[0], 3.0e-7, 1.0e-12);
      }
    }
  }
  all.remarks = table.remarks();
  return all;
}

std::string inputError(const std::string& text, const std::string& settings = "") {
  try {
    import(text, settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expectMotion(const Imported& all) {
  ASSERT_EQ(all.x.size(), static_cast<std::size_t>(kRows));
  for (int row = 0; row < kRows; ++row) {
    const auto i = static_cast<std::size_t>(row);
    ASSERT_EQ(all.instants[i], row * std::int64_t{1'000'000});
    ASSERT_NEAR(all.x[i], xAt(row), 1.0e-9);
    ASSERT_NEAR(all.y[i], yAt(row), 1.0e-9);
  }
}

/// Each turn, at the instant when the voltage passes -6 V: known to the slope between two samples.
void expectPulses(const Imported& all) {
  ASSERT_THAT(all.pulses, SizeIs(18));
  for (std::size_t k = 0; k < all.pulses.size(); ++k) {
    const double instant = (static_cast<double>(k) + 1.0 - 0.3) / kSpeed;
    EXPECT_NEAR(1.0e-9 * static_cast<double>(all.pulses[k]), instant, 4.0e-4) << k;
  }
}

TEST(TableImport, AMachineWithItsKeyphasor) {
  const Imported all = import(plainTable());
  expectMotion(all);
  expectPulses(all);
  EXPECT_THAT(
      all.remarks.back(),
      HasSubstr("tacho from column 'keyphasor [V]': falling through -6 V, hysteresis 1.6 V: "
                "18 pulses"));
}

TEST(TableImport, VoltsWithAScaleAndAGap) {
  std::string text = "sample;CH1 (mV);CH2;once\n";
  for (int row = 0; row < kRows; ++row) {  // 200 mV/mil is 7.874 V/mm
    text +=
        fmt::format("{};{:.4f};{:.7f};{:.3f}\n", row, -9500.0 + 1.0e3 * xAt(row) * 0.2 / 2.54e-5,
                    -8.0 + yAt(row) * 0.2 / 2.54e-5, voltsAt(row));
  }
  const std::string settings =
      "time: sample\nrate: 1 kHz\ncolumns:\n"
      "  x: {column: CH1, scale: 200 mV/mil, gap: -9.5 V}\n"
      "  probes/y: {column: CH2, scale: 0.2 V/mil, gap: -8 V}\n";
  const Imported all = import(
      text,
      settings + "keyphasor: {column: once, threshold: -6 V, slope: falling, hysteresis: 1 V}\n");
  expectMotion(all);
  expectPulses(all);
  EXPECT_TRUE(import(text, settings).pulses.empty());  // `once` has no name of a keyphasor
  EXPECT_THAT(inputError(text, settings + "keyphasor: {column: CH2}\n"),
              HasSubstr("column 'CH2': the voltage of a keyphasor must have two levels"));
  EXPECT_THAT(inputError(text, "rate: 1000\ncolumns: {x: CH1, y: CH2}\n"),
              HasSubstr("column 'CH1 (mV)': must be in m or another unit of that kind, or be a "
                        "voltage with `scale`"));
}

TEST(TableImport, APulseNeedsToPassTheHysteresis) {
  std::string text = "time,x,y,tacho\n";
  for (int row = 0; row < kRows; ++row) {  // noise of 1.5 V about the levels and on the edges
    text += fmt::format("{:.3f},0,{},{:.3f}\n", row / kRate, row % 3,
                        voltsAt(row) + 1.5 * std::sin(1.7 * row * row));
  }
  expectPulses(import(text, "keyphasor: {hysteresis: 3.5 V, threshold: -6 V}\n"));
}

TEST(TableImport, GapsAreNotValidAndRowsAreInTheOrderOfTime) {
  Lines lines = linesOf(plainTable());
  for (std::size_t i = 1; i < lines.size(); i += 10) {
    lines[i].replace(lines[i].find(',') + 1, lines[i].find(',', 7) - lines[i].find(',') - 1, "nan");
  }
  std::string text = lines.front() + "\n";
  for (std::size_t i = lines.size(); --i > 0;) {
    text += lines[i] + "\n";  // from the newest row to the oldest
  }
  const Imported all = import(text);
  ASSERT_THAT(all.instants, SizeIs(kRows));
  EXPECT_TRUE(std::is_sorted(all.instants.begin(), all.instants.end()));
  for (int row = 0; row < kRows; ++row) {
    const auto i = static_cast<std::size_t>(row);
    ASSERT_EQ(all.valid[i], row % 10 == 0 ? 0 : 1);
    ASSERT_NEAR(all.y[i], yAt(row), 1.0e-9);
  }
  expectPulses(all);
}

TEST(TableImport, WhatIsMissingIsReportedWithWhatThereIs) {
  EXPECT_THAT(inputError("time,x,keyphasor\n0,1,2\n1,1,2\n"), HasSubstr("no column 'y'"));
  EXPECT_THAT(inputError("time,a,b\n0,1,2\n1,1,2\n"),
              HasSubstr("must have columns with the names of the scene's channels, probes/x, "
                        "probes/y, tacho; there are: time, a, b"));
  EXPECT_THAT(inputError(plainTable(), "columns: {z: x}\n"),
              HasSubstr("the scene has no channel 'z'"));
  EXPECT_THAT(inputError(plainTable(), "colums: {x: x}\n"), HasSubstr("did you mean 'columns'?"));
  std::string text = "time,x,y\n";
  for (int row = 0; row < 100; ++row) {
    text += fmt::format("{},1e-6,{}e-6\n", 0.001 * row, row % 4);
  }
  EXPECT_THAT(import(text).remarks.front(), HasSubstr("no column for tacho"));
}

/// A data set 58 of real values, as its definition has it.
std::string response(const std::string& id, int node, int direction, const std::string& unit,
                     const std::function<double(int)>& value, bool even = true, int function = 1) {
  std::string text = fmt::format("    -1\n    58\n{}\nNONE\n01-MAR-26 12:00:00\nNONE\nNONE\n", id);
  text += fmt::format("{:5d}{:10d}{:5d}{:10d} {:<10}{:10d}{:4d} {:<10}{:10d}{:4d}\n", function, 0,
                      0, 0, "NONE", node, direction, "NONE", 0, 0);
  text += fmt::format("{:10d}{:10d}{:10d}{:13.5e}{:13.5e}{:13.5e}\n", even ? 2 : 4, kRows,
                      even ? 1 : 0, 0.0, even ? 1.0 / kRate : 0.0, 0.0);
  const char* const axis = "{:10d}{:5d}{:5d}{:5d} {:<20} {:<20}\n";
  text += fmt::format(fmt::runtime(axis), 17, 0, 0, 0, "Time", "s");
  text += fmt::format(fmt::runtime(axis), 8, 0, 0, 0, "Displacement", unit);
  text += fmt::format(fmt::runtime(axis), 0, 0, 0, 0, "NONE", "NONE");
  text += fmt::format(fmt::runtime(axis), 0, 0, 0, 0, "NONE", "NONE");
  for (int row = 0; row < kRows; ++row) {
    text += even ? fmt::format("{:13.5e}", value(row))
                 : fmt::format("{:13.5e}{:20.12e}", row / kRate, value(row));
    text += row + 1 == kRows || row % (even ? 6 : 2) == (even ? 5 : 1) ? "\n" : "";
  }
  return text + "    -1\n";
}

TEST(UffFile, HasTheColumnsOfATable) {
  const std::string other = "    -1\n   151\nmodel\n    -1\n";
  const auto micro = [](double (*of)(int)) { return [of](int row) { return 1.0e6 * of(row); }; };
  for (const bool even : {true, false}) {
    SCOPED_TRACE(even);
    const Imported all = import(other + response("x", 1, 1, "um", micro(xAt), even) +
                                    response("probe y", 2, 2, "um", micro(yAt), even) +
                                    response("spectrum", 2, 2, "um", micro(yAt), even, 4) +
                                    response("tacho", 3, 0, "V", voltsAt, even),
                                "columns: {y: 2+Y}\n", "run.uff");
    expectMotion(all);
    expectPulses(all);
    EXPECT_THAT(all.remarks.front(), HasSubstr("1 of 4 data sets 58 are not real time responses"));
  }
}

TEST(UffFile, ThatIsCorruptIsRejectedWithItsLine) {
  const auto error = [](const std::string& text) {
    const TemporaryDirectory folder;
    try {
      openUffFile(folder.write("run.unv", text));
    } catch (const InputError& why) {
      return std::string(why.what());
    }
    return std::string();
  };
  const std::string whole = response("x", 1, 1, "um", xAt);
  EXPECT_EQ(error(whole), "");
  EXPECT_THAT(error(whole.substr(0, 2000)), HasSubstr("read as a universal file (UFF 58)"));
  EXPECT_THAT(error("    -1\n   151\nmodel\n    -1\n"), HasSubstr("must have a time response"));
  std::string text = whole;
  text.replace(whole.size() / 2, 13, "       abc   ");
  EXPECT_THAT(error(text), HasSubstr("expected a number in columns"));
}

}  // namespace table_import_test
}  // namespace whirl_twin
