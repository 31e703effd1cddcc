// The adapters of examples/acquisition: every row of a file that grows during reading arrives once,
// with its instant, and so does every row of a pipe.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "event_log_sample.h"
#include "transport/lcm_decode.h"

namespace whirl_twin {
namespace acquisition_test {

constexpr std::int64_t kBegin = 1'700'000'000'000'000'000;  // [ns], of a clock on a wall
constexpr std::int64_t kPeriod = 500'001;                   // [ns]
constexpr int kRows = 1500;
constexpr const char* kNames = "time,probe_x[m],probe_y[m],torque\n";

struct Row {
  std::int64_t instant;
  std::array<double, 3> value;  // NaN: not valid
};

bool operator==(const Row& a, const Row& b) {
  bool same = a.instant == b.instant;
  for (std::size_t i = 0; i < 3; ++i) {
    same = same && (a.value[i] == b.value[i] || (std::isnan(a.value[i]) && std::isnan(b.value[i])));
  }
  return same;
}

std::vector<Row> allRows() {
  std::vector<Row> rows;
  for (int k = 0; k < kRows; ++k) {
    rows.push_back(
        {kBegin + k * kPeriod,
         {1e-6 * k, k % 100 == 7 ? std::nan("") : -1e-7 * k, k % 50 == 3 ? std::nan("") : 0.5}});
  }
  return rows;
}

/// As a program writes it: with an invalid value, a missing one, and now and then a duplicate row.
std::string textOf(const Row& row, int k) {
  char text[200];
  std::snprintf(text, sizeof(text), "%.17g", row.value[1]);  // or "nan"
  const std::string second = text;
  std::snprintf(text, sizeof(text), "%lld.%09lld,%.17g,%s,%s\n",
                static_cast<long long>(row.instant / 1'000'000'000),
                static_cast<long long>(row.instant % 1'000'000'000), row.value[0], second.c_str(),
                std::isnan(row.value[2]) ? "" : "0.5");
  const std::string line = text;
  return k % 400 == 9 ? line + line : line;
}

std::vector<std::string> allTexts() {
  std::vector<std::string> texts{kNames};
  const std::vector<Row> rows = allRows();
  for (int k = 0; k < kRows; ++k) {
    texts.push_back(textOf(rows[static_cast<std::size_t>(k)], k));
  }
  return texts;
}

/// Runs the command while the file grows, by pieces that end anywhere in a line.
int runBeside(const std::string& file, const std::string& command) {
  std::ofstream out(file, std::ios::trunc);
  std::string all;
  for (const std::string& text : allTexts()) {
    all += text;
  }
  out << all.substr(0, 10000) << std::flush;
  int status = -1;
  std::thread adapter([&] { status = std::system(command.c_str()); });
  constexpr std::size_t kPiece = 3001;
  for (std::size_t at = 10000; at < all.size(); at += kPiece) {
    std::this_thread::sleep_for(std::chrono::milliseconds(15));
    out << all.substr(at, kPiece) << std::flush;
  }
  adapter.join();
  return status;
}

void take(const state::Measurement& block, std::vector<Row>& rows) {
  EXPECT_EQ(block.source, "probes");
  EXPECT_EQ(block.channel, (std::vector<std::string>{"probe_x", "probe_y", "torque"}));
  EXPECT_EQ(block.unit, (std::vector<std::string>{"m", "m", ""}));
  for (std::size_t k = 0; k < block.instant.size(); ++k) {
    Row row{block.instant[k], {}};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(block.valid[3 * k + i] != 0, std::isfinite(block.value[3 * k + i]));
      row.value[i] = block.value[3 * k + i];
    }
    rows.push_back(row);
  }
}

/// The contents of a log; its blocks are numbered without a gap.
std::vector<Row> rowsOf(const std::string& path) {
  std::vector<Row> rows;
  lcm::LogFile log(path, "r");
  std::int64_t step = 0;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    const Message message =
        decodeEvent(event->channel, event->data, static_cast<std::size_t>(event->datalen));
    const auto& block = std::get<state::Measurement>(message);
    EXPECT_EQ(event->channel, "TWIN_PROBES_MEASUREMENT");
    EXPECT_EQ(block.at.step, step++);
    take(block, rows);
  }
  EXPECT_GT(step, 3);  // as it grew, not all at its end
  return rows;
}

/// The output of the Python adapter, one block per line.
std::vector<Row> rowsOfJson(const std::string& path) {
  std::vector<Row> rows;
  std::ifstream lines(path);
  std::int64_t step = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json["step"], step++);
    state::Measurement block;
    block.source = json["source"];
    block.channel = json["channel"].get<std::vector<std::string>>();
    block.unit = json["unit"].get<std::vector<std::string>>();
    block.instant = json["instant"].get<std::vector<std::int64_t>>();
    for (const auto& value : json["value"]) {
      block.value.push_back(value.is_null() ? std::nan("") : value.get<double>());
    }
    for (const bool valid : json["valid"]) {
      block.valid.push_back(valid ? 1 : 0);
    }
    take(block, rows);
  }
  EXPECT_GT(step, 3);
  return rows;
}

/// [s] without growth of a file after which the adapters end.
const std::string kQuiet = "2.5";
const std::string kPython = "python3 " WHIRL_TWIN_SOURCE "/examples/acquisition/csv_to_ros.py ";

TEST(Acquisition, OfAGrowingFileEveryRowArrivesOnceByLcm) {
  const TemporaryLog file, log;
  const std::string command = std::string(CSV_TO_LCM) + " " + file.path() + " probes 'file://" +
                              log.path() + "?mode=w' " + kQuiet + " 2>/dev/null";
  ASSERT_EQ(runBeside(file.path(), command), 0);
  EXPECT_EQ(rowsOf(log.path()), allRows());
}

TEST(Acquisition, OfAGrowingFileEveryRowArrivesOnceInPython) {
  const TemporaryLog file, output;
  const std::string command = kPython + file.path() + " probes --plain --quiet " + kQuiet + " > " +
                              output.path() + " 2>/dev/null";
  ASSERT_EQ(runBeside(file.path(), command), 0);
  EXPECT_EQ(rowsOfJson(output.path()), allRows());
}

TEST(Acquisition, OfAPipeEveryRowArrivesOnce) {
  const TemporaryLog file, log, output;
  {
    std::ofstream out(file.path());
    for (const std::string& text : allTexts()) {
      out << text;
    }
  }
  const std::string cat = "cat " + file.path() + " | ";
  ASSERT_EQ(
      std::system(
          (cat + CSV_TO_LCM + " - probes 'file://" + log.path() + "?mode=w' 2>/dev/null").c_str()),
      0);
  EXPECT_EQ(rowsOf(log.path()), allRows());
  ASSERT_EQ(
      std::system((cat + kPython + "- probes --plain > " + output.path() + " 2>/dev/null").c_str()),
      0);
  EXPECT_EQ(rowsOfJson(output.path()), allRows());
}

TEST(Acquisition, TwoColumnsOfOneNameEndTheAdapters) {
  const TemporaryLog file, log, output;
  std::ofstream(file.path()) << "time,x[m],y[m],x[mm],y[m]\n0,1,2,3,4\n";
  const std::string to = " 'file://" + log.path() + "?mode=w'";
  for (const std::string& command : {std::string(CSV_TO_LCM) + " " + file.path() + " probes" + to,
                                     kPython + file.path() + " probes --plain"}) {
    const int status = std::system((command + " > /dev/null 2> " + output.path()).c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2) << command;
    std::stringstream said;
    said << std::ifstream(output.path()).rdbuf();
    EXPECT_EQ(said.str(),
              "line 1: columns 2 and 4 are called x\nline 1: columns 3 and 5 are called y\n");
  }
}

}  // namespace acquisition_test
}  // namespace whirl_twin
