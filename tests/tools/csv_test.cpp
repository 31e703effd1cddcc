// --csv: the output of a command as a table of comma-separated values; the numbers are those of
// --json.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "twin_program.h"

namespace whirl_twin {
namespace csv_test {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

Words cellsOf(const std::string& line) {
  Words cells{""};
  bool inQuotes = false;
  for (const char letter : line) {
    if (letter == '"') {
      inQuotes = !inQuotes;
    } else if (letter == ',' && !inQuotes) {
      cells.emplace_back();
    } else {
      cells.back() += letter;
    }
  }
  return cells;
}

/// Rows by the names of their columns.
std::vector<std::map<std::string, std::string>> rowsOf(const std::string& path) {
  const Lines lines = linesOf(contentsOf(path));
  std::vector<std::map<std::string, std::string>> rows;
  if (lines.empty()) {
    ADD_FAILURE() << path << " is empty, or not there";
    return rows;
  }
  const Words columns = cellsOf(lines.front());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Words cells = cellsOf(lines[i]);
    EXPECT_EQ(cells.size(), columns.size()) << path << ": " << lines[i];
    for (std::size_t k = 0; k < std::min(cells.size(), columns.size()); ++k) {
      rows.resize(i);
      rows.back()[columns[k]] = cells[k];
    }
  }
  return rows;
}

/// Runs the command with --json, and again with --csv into a folder.
class Csv : public testing::Test {
 protected:
  Json run(Words arguments) {
    Words with_csv = arguments;
    with_csv.insert(with_csv.end(), {"--csv", folder_.file("table.csv")});
    const Ending plain = twin(with_csv);
    EXPECT_EQ(plain.status, 0) << plain.err;
    EXPECT_NE(plain.out, "") << "the text is printed all the same";
    arguments.emplace_back("--json");
    return twin(arguments).json();
  }
  auto table(const std::string& name = "table") { return rowsOf(folder_.file(name + ".csv")); }
  const TemporaryDirectory& folder() const { return folder_; }

 private:
  TemporaryDirectory folder_;
};

void expectNumber(const std::string& cell, const Json& value) {
  if (value.is_null()) {
    EXPECT_TRUE(cell.empty() || cell == "nan" || cell == "inf") << cell;
  } else {
    EXPECT_EQ(std::stod(cell), value.get<double>()) << "every digit";
  }
}

TEST_F(Csv, CampbellHasEveryPointOfItsBranches) {
  const Json rotor =
      run({"campbell", "friswell_rotor", "--to", "300", "--points", "7"})["systems"]["rotor"];
  const auto rows = table();
  const std::size_t speeds = rotor["speeds"].size();
  ASSERT_EQ(rows.size(), rotor["branches"].size() * speeds);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at("system"), "rotor");
    EXPECT_EQ(std::stoul(rows[i].at("branch")), 1 + i / speeds);
    expectNumber(rows[i].at("speed"), rotor["speeds"][i % speeds]);
    expectNumber(rows[i].at("frequency"), rotor["branches"][i / speeds]["frequency"][i % speeds]);
  }
  const auto crossings = table("table_crossings");
  ASSERT_EQ(crossings.size(), rotor["crossings"].size());
  expectNumber(crossings[0].at("speed"), rotor["crossings"][0]["speed"]);
  EXPECT_EQ(crossings[0].at("direction"), rotor["crossings"][0]["direction"]);
  EXPECT_EQ(table("table_peaks").size(), rotor["response_peaks"].size());
}

TEST_F(Csv, ResponseHasEverySpeedAndOrbitEveryStation) {
  const Json rotor = run({"response", kDemo, "--to", "120"})["systems"]["rotor"];
  const auto rows = table();
  ASSERT_EQ(rows.size(), rotor["speeds"].size());
  EXPECT_GE(rows.size(), 200u);
  const Json& disc = rotor["stations"].front();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    expectNumber(rows[i].at("speed"), rotor["speeds"][i]);
    expectNumber(rows[i].at("major"), disc[i]["major"]);
    expectNumber(rows[i].at("phase_lag"), disc[i]["phase_lag"]);
  }

  const Json orbits = run({"orbit", "friswell_rotor", "--speed", "84"})["systems"]["rotor"];
  EXPECT_EQ(table().size(), orbits["stations"].size());
}

TEST_F(Csv, AnalysisHasModesCriticalSpeedsAndMargins) {
  const Json rotor = run({"analyze", kDemo, "--system", "rotor"})["systems"]["rotor"];
  ASSERT_EQ(table().size(), rotor["natural_frequencies"].size());
  expectNumber(table()[0].at("natural_frequency"), rotor["natural_frequencies"][0]);
  EXPECT_EQ(table("table_eigenvalues").size(), 4u);
  ASSERT_EQ(table("table_critical_speeds").size(), rotor["critical_speeds"].size());
  expectNumber(table("table_critical_speeds")[0].at("speed"), rotor["critical_speeds"][0]["speed"]);
  EXPECT_EQ(table("table_parameters").size(), rotor["parameter_margins"]["parameters"].size());
}

TEST_F(Csv, ModesOfARotor) {
  const Json modes = run({"modes", "balancing", "--speed", "70"})["systems"]["rotor"]["modes"];
  ASSERT_EQ(table().size(), modes.size());
  expectNumber(table()[0].at("decay_rate"), modes[0]["decay_rate"]);
}

TEST_F(Csv, ChannelsAndAlertsOfALog) {
  const std::string log = folder().file("demo.lcmlog");
  ASSERT_EQ(twin({"simulate", kDemo, "--duration", "8", "--output", log}).status, 0);
  const Json channels = run({"log", log})["channels"];
  ASSERT_EQ(table().size(), channels.size());
  for (const auto& row : table()) {
    expectNumber(row.at("events"), channels[row.at("channel")]["events"]);
  }
  const Json alerts = run({"monitor", kDemo, log})["alerts"];
  ASSERT_GT(alerts.size(), 0u) << "it runs up into its critical band";
  ASSERT_EQ(table().size(), alerts.size());
  EXPECT_EQ(table()[0].at("text"), alerts[0]["text"]) << "commas and all";
}

TEST_F(Csv, ParametersOfModels) {
  const Json models = run({"models", "pendulum", "governor"})["models"];
  std::size_t parameters = 0;
  for (const auto& [name, model] : models.items()) {
    parameters += model["parameters"].size();
  }
  ASSERT_EQ(table().size(), parameters);
  for (const auto& row : table()) {
    EXPECT_EQ(row.at("meaning"),
              models[row.at("model")]["parameters"][row.at("parameter")]["meaning"]);
  }
}

TEST_F(Csv, MassesThatBalance) {
  const std::string runs = folder().write(
      "runs.yaml",
      "probes: [left]\nplanes: [disc]\ninitial: [[4.0e-6, 0]]\n"
      "trials: [{plane: disc, mass_radius: 1.0e-4, angle: 0, readings: [[2.0e-6, 0]]}]\n");
  run({"balance", runs});  // a trial mass that halves it: twice as much takes it away
  ASSERT_EQ(table().size(), 1u);
  EXPECT_EQ(table()[0].at("plane"), "disc");
  EXPECT_NEAR(std::stod(table()[0].at("mass_radius")), 2.0e-4, 1.0e-18);
}

TEST_F(Csv, NeedsANameThatSaysSo) {
  const Ending end = twin({"campbell", kDemo, "--csv", folder().file("table.txt")});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_NE(end.err.find("--csv: expected a name that ends in .csv, found "), std::string::npos);
  EXPECT_EQ(twin({"routh", "1", "2", "--csv", "/no/such/folder/roots.csv"}).status, 1);
}

TEST_F(Csv, RouthsTableAndRoots) {
  const Json judged = run({"routh", "1", "1/3", "5"});
  ASSERT_EQ(table().size(), 3u);
  EXPECT_EQ(table()[1].at("entry_1"), "1/3");
  ASSERT_EQ(table("table_roots").size(), 2u);
  expectNumber(table("table_roots")[0].at("im"), judged["roots"][0][1]);
}

}  // namespace csv_test
}  // namespace whirl_twin
