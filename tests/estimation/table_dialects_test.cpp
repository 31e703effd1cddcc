// One swing as other programs write it: every dialect gives the numbers of the plain table, and a
// table that cannot be read is rejected with its line, column and dialect.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "../tools/twin_program.h"
#include "estimation/measured_run.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace table_dialects_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr int kRows = 60;
constexpr double kStep = 0.005;  // s

double angleAt(int row) {
  return std::round(1.0e6 * 0.3 * std::sin(0.2 * row)) * 1.0e-6;
}

using Cell = std::function<std::string(int)>;

const Cell kSeconds = [](int row) { return fmt::format("{:.3f}", kStep * row); };
const Cell kAngle = [](int row) { return fmt::format("{:.6f}", angleAt(row)); };

Cell withComma(const Cell& cell) {
  return [cell](int row) {
    std::string text = cell(row);
    std::replace(text.begin(), text.end(), '.', ',');
    return text;
  };
}

std::string table(const std::string& head, const Cell& time, const Cell& angle,
                  const std::string& separator, const std::string& end = "\n") {
  std::string text = head;
  for (int row = 0; row < kRows; ++row) {
    text += time(row) + separator + angle(row) + end;
  }
  return text;
}

MeasuredRun read(const std::string& text, const TableSettings& settings = {},
                 const std::string& column = "angle") {
  const TemporaryDirectory folder;
  return readMeasuredRun(folder.write("swing.csv", text), settings, {{column}});
}

std::string inputError(const std::string& text, const TableSettings& settings = {},
                       const std::string& column = "angle") {
  try {
    read(text, settings, column);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expectSwing(const MeasuredRun& run, double scale = 1.0) {
  ASSERT_EQ(run.time.size(), static_cast<std::size_t>(kRows));
  for (int row = 0; row < kRows; ++row) {
    const auto i = static_cast<std::size_t>(row);
    ASSERT_NEAR(run.time[i], kStep * row, 1.0e-9) << row;
    ASSERT_NEAR(scale * run.columns[0].values[i], angleAt(row), 1.0e-9) << row;
  }
}

TableSettings timeOf(const std::string& column) {
  TableSettings settings;
  settings.time = column;
  return settings;
}

TEST(TableDialects, SeparatorsAndDecimalMarks) {
  for (const std::string separator : {",", ";", "\t", "  ", " ", " , ", "|"}) {
    SCOPED_TRACE(separator);
    expectSwing(read(table("time" + separator + "angle\n", kSeconds, kAngle, separator)));
  }
  for (const std::string separator : {";", "\t", "   "}) {
    SCOPED_TRACE(separator);
    const MeasuredRun run = read(
        table("time" + separator + "angle\n", withComma(kSeconds), withComma(kAngle), separator));
    expectSwing(run);
    EXPECT_THAT(run.remarks.back(), HasSubstr("decimal ','"));
  }
  const auto quoted = [](const Cell& cell) {
    return [cell](int row) { return '"' + cell(row) + '"'; };
  };
  expectSwing(read(
      table("\"time\",\"angle\"\n", quoted(withComma(kSeconds)), quoted(withComma(kAngle)), ",")));
}

TEST(TableDialects, EndsOfLinesMarksAndBlanks) {
  expectSwing(read(table("\xEF\xBB\xBFtime,angle\r\n", kSeconds, kAngle, ",", "\r\n")));
  expectSwing(read(table("time,angle,\n", kSeconds, kAngle, ",", ",\n")));
  expectSwing(read(table("\n\ntime,angle\n\n", kSeconds, kAngle, ",", "\n\n")));
  expectSwing(read(table("time,angle\n# begin\n", kSeconds, kAngle, ",", "\n% x,y\n")));
}

TEST(TableDialects, NamesAndUnits) {
  EXPECT_THAT(read(table("time,angle\n", kSeconds, kAngle, ",")).remarks, ElementsAre());
  expectSwing(read(table("# rig 3\n// 200 Hz\ntime,angle\n", kSeconds, kAngle, ",")));
  expectSwing(read(table("# time angle\n", kSeconds, kAngle, " ")));
  expectSwing(read(
      table("Operator;Smith\nRig;3\n\nZeit;Winkel\n", withComma(kSeconds), withComma(kAngle), ";"),
      {}, "Winkel"));
  const MeasuredRun units = read(table("time,angle\ns,rad\n", kSeconds, kAngle, ","));
  expectSwing(units);
  EXPECT_EQ(units.columns[0].unit, "rad");
  EXPECT_THAT(units.remarks.back(), HasSubstr("units in line 2"));
  expectSwing(read(table("\"Time, s\",\"Angle, rad\"\n", kSeconds, kAngle, ","), {}, "Angle, rad"));
  for (const char* heading :
       {"angle [deg]", "angle[deg]", "angle (deg)", "angle / deg", "angle (\xC2\xB0)"}) {
    SCOPED_TRACE(heading);
    const MeasuredRun run = read(table(fmt::format("time,{}\n", heading), kSeconds, kAngle, ","));
    expectSwing(run);
    EXPECT_EQ(run.columns[0].unit, "deg");
  }
  expectSwing(read(table("Time (s) angle (rad)\n", kSeconds, kAngle, " ")));
  const MeasuredRun numbers = read(table("", kSeconds, kAngle, ","), timeOf("1"), "2");
  expectSwing(numbers);
  EXPECT_THAT(numbers.remarks.back(), HasSubstr("columns by number"));
  expectSwing(read(table("", kSeconds, kAngle, ","), {}, "2"));
  TableSettings named;
  named.names = {"t [s]", "q"};
  expectSwing(read(table("", kSeconds, kAngle, ","), named, "q"));
}

TEST(TableDialects, Times) {
  const auto number = [](double scale) {
    return [scale](int row) { return fmt::format("{:.0f}", scale * kStep * row); };
  };
  for (const char* heading : {"t[ms]", "time (ms)", "time_ms", "Time, ms"}) {
    SCOPED_TRACE(heading);
    expectSwing(read(table(fmt::format("\"{}\";angle\n", heading), number(1.0e3), kAngle, ";")));
  }
  expectSwing(read(table("t [\xC2\xB5s],angle\n", number(1.0e6), kAngle, ",")));
  expectSwing(read(table("time,angle\nus,rad\n", number(1.0e6), kAngle, ",")));
  TableSettings settings = timeOf("when");
  settings.time_unit = "us";
  expectSwing(read(table("when,angle\n", number(1.0e6), kAngle, ","), settings));
  settings = timeOf("sample");
  settings.rate = 200.0;
  expectSwing(read(table("sample,angle\n", number(200.0), kAngle, ","), settings));
  settings.time = "";
  expectSwing(read(table("angle,other\n", kAngle, kSeconds, ","), settings));
  for (const char* zone : {"", "Z", "+00:00", "+0000"}) {
    const auto calendar = [&](int row) {
      return fmt::format("2026-02-28T23:59:{:06.3f}{}", 59.0 + 0.001 * std::floor(5.0 * row), zone);
    };
    expectSwing(read(table("time,angle\n", calendar, kAngle, ",")));
  }
  const auto over_midnight = [](int row) {
    const int ms = 5 * row - 100;
    return ms < 0 ? fmt::format("2024-02-29 23:59:59.{:03d}", 1000 + ms)
                  : fmt::format("2024-03-01 00:00:00.{:03d}", ms);
  };
  expectSwing(read(table("time,angle\n", over_midnight, kAngle, ",")));
}

TEST(TableDialects, ACellWithoutANumberIsAGap) {
  for (const char* gap : {"", "nan", "NaN", "NA", "null", "inf", "-nan"}) {
    SCOPED_TRACE(gap);
    const auto some = [&](int row) { return row % 7 == 3 ? gap : kAngle(row); };
    const MeasuredRun run = read(table("time,angle\n", kSeconds, some, ","));
    EXPECT_EQ(run.time.size(), 51u);
    EXPECT_NEAR(run.column("angle")[3], angleAt(4), 1.0e-9);
    EXPECT_THAT(run.remarks.back(), HasSubstr("9 of 60 rows are left out"));
  }
  EXPECT_THAT(inputError(table(
                  "time,angle\n", kSeconds, [](int) { return ""; }, ",")),
              HasSubstr("must have 5 rows"));
}

// Rows of two sources: a torque every fifth row, between the angles.
TEST(TableDialects, AnInputIsInterpolatedInItsGaps) {
  const TemporaryDirectory folder;
  std::string text = "time,angle,torque\n";
  for (int row = 0; row < kRows; ++row) {
    text += fmt::format("{},{},{}\n", kSeconds(row), row % 5 == 0 ? "" : kAngle(row),
                        row % 5 == 0 ? fmt::format("{:g}", 2.0 * row) : "");
  }
  const std::string path = folder.write("run.csv", text);
  for (const auto gap : {WantedColumn::Gap::kInterpolated, WantedColumn::Gap::kHeld}) {
    const MeasuredRun run = readMeasuredRun(path, {}, {{"angle"}, {"torque", gap}});
    ASSERT_EQ(run.time.size(), 48u);
    const double between = gap == WantedColumn::Gap::kHeld ? 10.0 : 14.0;
    EXPECT_NEAR(run.time[5], 7 * kStep, 1.0e-9);
    EXPECT_NEAR(run.column("torque")[5], between, 1.0e-9);
  }
}

TEST(TableDialects, WhatCannotBeReadIsReportedWithItsPlaceAndDialect) {
  const auto three = [](int row) { return "0.5;" + kAngle(row); };
  EXPECT_THAT(inputError(table("time;angle\n", kSeconds, three, ";")),
              HasSubstr("line 2: expected at most 2 values, as many as line 1 has names, found 3; "
                        "read with separator ';', decimal '.'"));
  const auto bad = [](int row) { return row == 40 ? std::string("0.3x") : kAngle(row); };
  EXPECT_THAT(inputError(table("time;angle\n", kSeconds, bad, ";")),
              HasSubstr("line 42: angle must be a finite number, found '0.3x'; read with separator "
                        "';', decimal '.'"));
  EXPECT_THAT(inputError(table("time;angel\n", kSeconds, kAngle, ";")),
              HasSubstr("no column 'angle'; did you mean 'angel'?; read with separator ';'"));
  EXPECT_THAT(inputError("\xFF\xFEt\0,\0"), HasSubstr("UTF-16"));
  EXPECT_THAT(inputError("time,angle\n" + std::string(2u << 20, '1')), HasSubstr("1 MiB"));
  EXPECT_THAT(inputError(table("time [kg],angle\n", kSeconds, kAngle, ",")),
              HasSubstr("the time must be in s or another unit of time, found kg"));
  EXPECT_THAT(inputError(table("when,angle\n", kSeconds, kAngle, ",")),
              HasSubstr("no column 'time'"));
  // A number in another notation than the first rows have is no gap.
  const auto late = [](int row) { return row < 59 ? kAngle(row) : std::string("0,5"); };
  EXPECT_THAT(inputError(table("time;angle\n", kSeconds, late, ";")), HasSubstr("line 61"));
  EXPECT_THAT(inputError(table("time;angle\n", kSeconds, late, ";")), Not(HasSubstr("left out")));
}

}  // namespace table_dialects_test
}  // namespace whirl_twin
