// Units of options and of printed text, values replaced by --set, scenes from standard input, and
// error lists of files that are something else.
#include <gtest/gtest.h>

#include <cmath>

#include "twin_program.h"

namespace whirl_twin {
namespace units_command_test {

constexpr const char* kFriswell = WHIRL_TWIN_SOURCE "/config/scenes/friswell_rotor.yaml";

using Arguments = std::vector<std::string>;

Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

struct TwoSpellings {
  Arguments command, in_units, in_si;
};
class OptionUnits : public testing::TestWithParam<TwoSpellings> {};

TEST_P(OptionUnits, AreThoseOfTheSI) {
  const Ending units = twin(with(GetParam().command, GetParam().in_units));
  EXPECT_EQ(units.status, 0) << units.err;
  EXPECT_EQ(units.out, twin(with(GetParam().command, GetParam().in_si)).out);
}

// 955 rpm are 100.0073... rad/s: 31.831 pi.
const std::string kSpeed = "100.00736613927508";
INSTANTIATE_TEST_SUITE_P(
    Commands, OptionUnits,
    testing::Values(
        TwoSpellings{{"analyze", kDemo}, {"--speed", "955 rpm"}, {"--speed", kSpeed}},
        TwoSpellings{{"orbit", kFriswell}, {"--speed", "955rpm"}, {"--speed", kSpeed}},
        TwoSpellings{{"modes", kFriswell}, {"--speed", "955 r/min"}, {"--speed", kSpeed}},
        TwoSpellings{{"stability", kFriswell}, {"--speed", "9.55e2 RPM"}, {"--speed", kSpeed}},
        TwoSpellings{{"response", kFriswell, "--force", "node_2"},
                     {"--speed", "955 cpm"},
                     {"--speed", kSpeed}},
        TwoSpellings{
            {"campbell", kDemo, "--points", "5"}, {"--to", "10 Hz"}, {"--to", "62.83185307179586"}},
        TwoSpellings{{"response", kDemo, "--points", "5"},
                     {"--from", "60 deg/s", "--to", "20 rps"},
                     {"--from", "1.0471975511965976", "--to", "125.66370614359172"}},
        TwoSpellings{{"map", kFriswell, "--points", "5"},
                     {"--from", "10 N/mm", "--to", "1 MN/mm"},
                     {"--from", "1e4", "--to", "1e9"}},
        TwoSpellings{
            {"stability", kFriswell},
            {"--stage", "0.5 kW", "400 mm", "15mm", "160 %", "--axial-stage", "1 kW", "0.4",
             "12 mm"},
            {"--stage", "500", "0.4", "0.015", "1.6", "--axial-stage", "1000", "0.4", "0.012"}},
        TwoSpellings{{"simulate", kDemo, "--json"},
                     {"--duration", "0.01 min", "--step", "500 us"},
                     {"--duration", "0.6", "--step", "0.0005"}},
        TwoSpellings{{"analyze", kDemo}, {"--at", "500 ms"}, {"--at", "0.5"}}));

struct RefusedNumber {
  Arguments arguments;
  std::string message;
};
class RefusedUnits : public testing::TestWithParam<RefusedNumber> {};

TEST_P(RefusedUnits, SaysWhatItMustBeAndWhatWasFound) {
  const Ending end = twin(GetParam().arguments);
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_EQ(end.err, "twin: " + GetParam().message + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    Commands, RefusedUnits,
    testing::Values(
        RefusedNumber{
            {"orbit", kDemo, "--speed", "3 kg"},
            "--speed: must be a shaft speed from 0 to 1e+06 rad/s, found '3 kg' (a mass)"},
        RefusedNumber{{"orbit", kDemo, "--speed", "8,5 rpm"},
                      "--speed: must be a shaft speed from 0 to 1e+06 rad/s, found '8,5 rpm' (the "
                      "decimal sign is a point)"},
        RefusedNumber{
            {"orbit", kDemo, "--speed", "800 rmp"},
            "--speed: must be a shaft speed from 0 to 1e+06 rad/s, found '800 rmp' (unknown "
            "unit 'rmp')"},
        RefusedNumber{
            {"orbit", kDemo, "--speed", "50 hz"},
            "--speed: must be a shaft speed from 0 to 1e+06 rad/s, found '50 hz' (unknown "
            "unit 'hz'; write 'Hz')"},
        RefusedNumber{{"orbit", kDemo, "--speed", "rpm"},
                      "--speed: must be a shaft speed from 0 to 1e+06 rad/s, found 'rpm'"},
        RefusedNumber{{"orbit", kDemo, "--speed", ""},
                      "--speed: must be a shaft speed from 0 to 1e+06 rad/s, found ''"},
        RefusedNumber{{"orbit", kDemo, "--speed", "1e308 Mrpm"},
                      "--speed: must be a shaft speed from 0 to 1e+06 rad/s, found '1e308 Mrpm'"},
        RefusedNumber{
            {"orbit", kDemo, "--speed", "8 \xff"},
            "--speed: must be a shaft speed from 0 to 1e+06 rad/s, found '8 \\xff' (unknown "
            "unit '\\xff')"},
        RefusedNumber{{"map", kFriswell, "--from", "100 lb/in"},
                      "--from: must be a stiffness above 0, up to 1e+18 N/m, found '100 lb/in' "
                      "('lb/in' cannot be converted to N/m; write 'lbf/in')"},
        RefusedNumber{{"stability", kFriswell, "--stage", "500", "0.4", "-0.015", "1.6"},
                      "--stage: must be a width > 0 m, found -0.015"},
        RefusedNumber{{"report", kFriswell, "--output", "x", "--speed", "3 m"},
                      "--speed: must be a shaft speed above 0, up to 1e+06 rad/s, found '3 m' (a "
                      "length)"},
        RefusedNumber{{"loop", kDemo, "--speed", "3 m"},
                      "--speed: must be a shaft speed from -1e+06 to 1e+06 rad/s, found '3 m' (a "
                      "length)"},
        RefusedNumber{{"simulate", kDemo, "--duration", "3 m"},
                      "--duration: must be from 0 s to 1000000000 s, found '3 m' (a length)"}));

TEST(OptionUnitsUnquoted, AreExplained) {
  const Ending end = twin({"orbit", kDemo, "--speed", "800", "rpm"});
  EXPECT_EQ(end.status, 2);
  EXPECT_NE(end.err.find("a number and its unit must be in quotes: \"800 rpm\""), std::string::npos)
      << end.err;
}

TEST(UnitsCommand, ListsEachUnitWithItsFactor) {
  const Ending text = twin({"units"});
  EXPECT_EQ(text.status, 0);
  EXPECT_NE(text.out.find("\n  thou           2.54e-05\n"), std::string::npos) << text.out;
  const nlohmann::json all = twin({"units", "--json"}).json();
  bool found = false;
  for (const auto& quantity : all["quantities"]) {
    if (quantity["quantity"] == "stiffness") {
      EXPECT_EQ(quantity["unit"], "N/m");
      EXPECT_NEAR(quantity["factors"]["lbf/in"].get<double>(), 175.126835, 1e-6);
      found = true;
    }
  }
  EXPECT_TRUE(found);
}

/// Number in a row of a text that begins with `start`, the `place`-th from 0.
double numberIn(const std::string& text, const std::string& start, std::size_t place) {
  for (const std::string& line : linesOf(text)) {
    if (line.rfind(start, 0) == 0) {
      std::istringstream cells(line.substr(start.size()));
      std::string cell;
      for (std::size_t i = 0; i <= place; ++i) {
        cells >> cell;
      }
      return std::stod(cell);
    }
  }
  ADD_FAILURE() << start << " in\n" << text;
  return 0.0;
}

TEST(ShownUnits, AreThoseOfTheOption) {
  const Arguments orbit{"orbit", kDemo, "--speed", "500 rpm"};
  const std::string si = twin(orbit).out;
  const std::string shown = twin(with(orbit, {"--units", "rpm, mil pp, rad"})).out;
  EXPECT_NE(shown.find("orbits at 500 rpm"), std::string::npos) << shown;
  EXPECT_NE(shown.find("major, mil pp"), std::string::npos) << shown;
  EXPECT_NEAR(numberIn(shown, "    disc", 0), 2.0 * numberIn(si, "    disc", 0) / 2.54e-5,
              1e-4 * numberIn(shown, "    disc", 0));
  EXPECT_EQ(twin(with(orbit, {"--units", "rpm", "--json"})).out, twin(with(orbit, {"--json"})).out);
}

TEST(ShownUnits, OfEveryReport) {
  for (const Arguments& command :
       std::vector<Arguments>{{"analyze", kFriswell},
                              {"campbell", kFriswell, "--points", "20"},
                              {"response", kFriswell, "--points", "20"},
                              {"response", kFriswell, "--force", "node_2"},
                              {"modes", kFriswell},
                              {"map", kFriswell, "--points", "5"},
                              {"stability", kFriswell}}) {
    const Ending shown = twin(with(command, {"--units", "cpm, Hz, um, deg, N/mm"}));
    EXPECT_EQ(shown.status, 0) << shown.err;
    EXPECT_NE(shown.out.find("cpm"), std::string::npos) << shown.out;
    EXPECT_NE(shown.out, twin(command).out) << command.front();
    EXPECT_EQ(twin(with(command, {"--units", ""})).out, twin(command).out) << command.front();
  }
}

TEST(ShownUnits, OfTheUsersFileAreTheDefault) {
  const TemporaryDirectory folder;
  std::filesystem::create_directories(folder.file("whirl_twin"));
  folder.write("whirl_twin/units", "# as on the machine\nrpm\nmil pp  # by the probes\n");
  ::setenv("XDG_CONFIG_HOME", folder.file("").c_str(), 1);
  const Ending shown = twin({"orbit", kDemo, "--speed", "500 rpm"});
  const Ending other = twin({"orbit", kDemo, "--speed", "500 rpm", "--units", "Hz"});
  folder.write("whirl_twin/units", "parsec\n");
  const Ending wrong = twin({"orbit", kDemo, "--speed", "500 rpm"});
  ::unsetenv("XDG_CONFIG_HOME");
  EXPECT_NE(shown.out.find("major, mil pp"), std::string::npos) << shown.out;
  EXPECT_NE(other.out.find("orbits at 8.33333 Hz"), std::string::npos) << other.out;
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("whirl_twin/units: must be a list of units"), std::string::npos)
      << wrong.err;
}

TEST(ShownUnits, ThatAreNoneAreRefused) {
  for (const char* wrong : {"furlong", "kg", "rpm, ", "mil xx", "\xff", "5 mil"}) {
    const Ending end = twin({"orbit", kDemo, "--speed", "5", "--units", wrong});
    EXPECT_EQ(end.status, 2) << wrong;
    EXPECT_EQ(end.err.rfind("twin: --units: must be a list of units", 0), 0u) << end.err;
  }
}

// --set is as an edited file, for every command that takes a scene.

std::string edited() {
  std::string text = contentsOf(kDemo);
  const std::size_t at = text.find("damping: 12.0");
  return text.replace(at, 13, "damping: 8.0 ");
}

class SetValues : public testing::TestWithParam<Arguments> {};

TEST_P(SetValues, AreThoseOfAnEditedFile) {
  const TemporaryDirectory folder;
  const std::string file = folder.write("demo.yaml", edited());
  const std::string original = folder.write("original.yaml", contentsOf(kDemo));
  Arguments of_file = GetParam(), of_option = GetParam();
  of_file.insert(of_file.begin() + 1, file);
  of_option.insert(of_option.begin() + 1, original);
  const Ending end = twin(with(of_option, {"--set", "rotor.damping=8 N s/m"}));
  EXPECT_EQ(end.status, 0) << end.err;
  std::string expected = twin(of_file).out;
  for (std::size_t at; (at = expected.find(file)) != std::string::npos;) {
    expected.replace(at, file.size(), original);
  }
  EXPECT_EQ(end.out, expected);
  EXPECT_NE(end.out, twin(with(of_option, {})).out);
}

INSTANTIATE_TEST_SUITE_P(Commands, SetValues,
                         testing::Values(Arguments{"analyze", "--json"},
                                         Arguments{"campbell", "--json", "--points", "5"},
                                         Arguments{"response", "--json", "--points", "5"},
                                         Arguments{"orbit", "--json", "--speed", "20"},
                                         Arguments{"modes", "--json"},
                                         Arguments{"stability", "--json"},
                                         Arguments{"simulate", "--json", "--duration", "1"}));

TEST(SetOption, IsAnOptionOfEveryCommandWithAScene) {
  for (const char* command :
       {"check", "simulate", "plot", "analyze", "campbell", "response", "orbit", "map", "stability",
        "report", "loop", "modes", "balance", "tradeoff", "monitor", "follow"}) {
    EXPECT_NE(twin({command, "--help"}).out.find("--set PATH=VALUE"), std::string::npos) << command;
  }
}

TEST(SetOption, IsRecordedInTheLog) {
  const TemporaryDirectory folder;
  const std::string log = folder.file("demo.lcmlog");
  EXPECT_EQ(
      twin({"simulate", kDemo, "--set", "rotor.damping=8", "--duration", "0.1", "--output", log})
          .status,
      0);
  EXPECT_NE(contentsOf(log).find(std::string("damping: 8\0", 11)), std::string::npos);
}

TEST(SetOption, IsNamedByItsErrors) {
  const Ending end = twin({"check", kDemo, "--set", "rotor.damping=8 kg"});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.err,
            "--set rotor.damping=8 kg: systems.rotor.parameters.damping: must be >= 0 N s/m, found "
            "'8 kg': 'kg' cannot be converted to N s/m\n");
  EXPECT_EQ(twin({"check", kDemo, "--set", "roter.damping=8"}).err,
            "twin: --set roter.damping=8: there is no system, controller, drive or sensor 'roter'; "
            "did you mean 'rotor'?\n");
}

// Standard input, from a file and from a pipe.

Ending twinWithInput(const std::string& text, const Arguments& arguments) {
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  EXPECT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(ends[1]);
  const int before = ::dup(STDIN_FILENO);
  ::dup2(ends[0], STDIN_FILENO);
  ::close(ends[0]);
  const Ending end = twin(arguments);
  ::dup2(before, STDIN_FILENO);
  ::close(before);
  return end;
}

TEST(StandardInput, IsAScene) {
  const std::string demo = contentsOf(kDemo);
  const std::string expected = twin({"simulate", kDemo, "--duration", "0.5", "--json"}).out;
  for (const char* name : {"-", "/dev/stdin"}) {
    const Ending end = twinWithInput(demo, {"simulate", name, "--duration", "0.5", "--json"});
    EXPECT_EQ(end.status, 0) << end.err;
    EXPECT_EQ(end.out, expected);
  }
  EXPECT_EQ(twinWithInput(demo, {"orbit", "-", "--speed", "5", "--set", "rotor.damping=8"}).out,
            twin({"orbit", kDemo, "--speed", "5", "--set", "rotor.damping=8"}).out);
  const TemporaryDirectory folder;
  EXPECT_EQ(twinWithInput(
                demo, {"simulate", "-", "--duration", "0.1", "--output", folder.file("a.lcmlog")})
                .status,
            0);
}

TEST(StandardInput, IsNamedInErrors) {
  EXPECT_EQ(twinWithInput("", {"check", "-"}).err,
            "standard input: empty: a scene has a step and at least one system\n");
  const Ending wrong = twinWithInput("step: 1 kg\nsystems: {}\n", {"check", "-"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(wrong.err.rfind("standard input: step: must be from 1e-09 to 10 s", 0), 0u)
      << wrong.err;
}

// Files that are something else.

TEST(OtherFiles, AreToldInThreeLines) {
  const TemporaryDirectory folder;
  std::string csv = "t,x\n", keys, binary(1000, '\0');
  for (int i = 0; i < 1000; ++i) {
    csv += std::to_string(i) + ",0.5\n";
    keys += "key_" + std::to_string(i) + ": {a: 1, b: [1, 2]}\n";
  }
  const std::string monitor = contentsOf(WHIRL_TWIN_SOURCE "/config/monitor.yaml");
  for (const std::string& text : {csv, keys, binary, monitor, std::string("{\"a\": 1, \"b\": [1]}"),
                                  std::string("<html>\n<body>: x\n</html>\n")}) {
    const std::string file = folder.write("other.yaml", text);
    for (const Arguments& command : std::vector<Arguments>{
             {"check", file}, {"sweep", file}, {"balance", file}, {"fit", file}}) {
      const Ending end = twin(command);
      EXPECT_EQ(end.status, 2) << command.front();
      EXPECT_LE(linesOf(end.err).size(), 3u) << command.front() << ": " << end.err;
      EXPECT_NE(end.err.find("other.yaml"), std::string::npos) << end.err;
    }
  }
}

TEST(OtherFiles, HaveAtMostTenErrors) {
  const TemporaryDirectory folder;
  std::string scene = contentsOf(kDemo);
  for (int i = 0; i < 500; ++i) {
    scene += "key_" + std::to_string(i) + ": 1\n";
  }
  const Ending end = twin({"check", folder.write("much.yaml", scene)});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(linesOf(end.err).size(), 11u) << end.err;
  EXPECT_EQ(linesOf(end.err).back(), "and 490 more");
}

}  // namespace units_command_test
}  // namespace whirl_twin
