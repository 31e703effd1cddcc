// A growing CSV file, or what an acquisition card's program writes into a pipe, as Measurement on
// LCM: csv_to_lcm FILE SOURCE [URL [QUIET]], or CARD_PROGRAM | csv_to_lcm - SOURCE.
// The first line has names with units, time,probe_x[m],probe_y[m]; time: s of the machine's clock.
// What is no number is sent as invalid; a row not later than the one before is left out, and said;
// two columns of one name end it at once.
// It ends with the pipe, or when the file has not grown for QUIET seconds, which may be left out.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <lcm/lcm-cpp.hpp>
#include <sstream>
#include <thread>
#include <whirl_twin/measurement_t.hpp>

using Clock = std::chrono::steady_clock;
constexpr std::int64_t kLongest = 50'000'000;  // [ns], of a block
constexpr std::size_t kMaxRows = 500;         // of a block

/// False where two columns have one name, and that is said.
bool takeNames(std::istringstream columns, whirl_twin::measurement_t& block) {
  std::string name;
  for (std::getline(columns, name, ','); std::getline(columns, name, ','); ++block.channels) {
    const std::size_t unit = name.find('[');
    block.channel.push_back(name.substr(0, unit));
    block.unit.push_back(unit == name.npos ? "" : name.substr(unit + 1, name.find(']') - unit - 1));
    block.deviation.push_back(std::nan(""));  // not known: put your probe's here
  }
  bool different = true;
  for (auto name_at = block.channel.begin(); name_at != block.channel.end(); ++name_at) {
    const auto first = std::find(block.channel.begin(), name_at, *name_at);
    if (first != name_at && !name_at->empty()) {
      std::cerr << "line 1: columns " << first - block.channel.begin() + 2 << " and "
                << name_at - block.channel.begin() + 2 << " are called " << *name_at << "\n";
      different = false;
    }
  }
  return different;
}

/// False for a row without a time, or not later than the one before.
bool takeRow(std::istringstream columns, std::int64_t& newest, whirl_twin::measurement_t& block) {
  std::string text;
  std::getline(columns, text, ',');
  char* end = nullptr;
  const std::int64_t instant = std::llround(std::strtold(text.c_str(), &end) * 1e9L);
  if (end == text.c_str() || instant <= newest) {
    return false;
  }
  block.instant.push_back(newest = instant);
  for (int i = 0; i < block.channels; ++i) {
    if (!std::getline(columns, text, ',')) {
      text.clear();
    }
    const double value = std::strtod(text.c_str(), &end);
    const bool number = end != text.c_str() && std::isfinite(value);
    block.value.push_back(number ? value : std::nan(""));
    block.valid.push_back(number);
  }
  return true;
}

void send(lcm::LCM& link, const std::string& channel, whirl_twin::measurement_t& block) {
  block.samples = block.instants = static_cast<int>(block.instant.size());
  block.values = static_cast<int>(block.value.size());
  block.first_instant = block.instant.front();
  block.time = 1e-9 * static_cast<double>(block.instant.back());
  block.utime = std::llround(block.time * 1e6);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  block.stamp = std::chrono::nanoseconds(now).count();
  link.publish(channel, &block);
  ++block.step;  // the number of the next block: who listens sees what is lost
  block.instant.clear();
  block.value.clear();
  block.valid.clear();
}

int main(int argc, char** argv) {
  const std::string path = argc > 1 ? argv[1] : "", source = argc > 2 ? argv[2] : "";
  const std::chrono::duration<double> quiet(path == "-" ? 0.0
                                            : argc > 4  ? std::stod(argv[4])
                                                        : 1e9);
  std::ifstream file(path == "-" ? "/dev/stdin" : path);
  lcm::LCM link(argc > 3 ? argv[3] : "udpm://239.255.76.67:7667?ttl=0");
  if (source.empty() || !file || !link.good()) {
    std::cerr << "usage: csv_to_lcm FILE|- SOURCE [URL [QUIET]]; file and link have to open\n";
    return 2;
  }
  std::string channel = "TWIN_" + source + "_MEASUREMENT", line, part;
  for (char& c : channel) {
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  whirl_twin::measurement_t block{};
  block.source = source;
  std::int64_t newest = INT64_MIN, sent = 0;  // [ns]
  for (auto grown = Clock::now(); !file.eof() || Clock::now() - grown < quiet;) {
    file.clear();
    std::getline(file, part);
    line += part;  // one that is still being written goes on when the file has grown
    if (!file.eof()) {
      grown = Clock::now();
      if (block.channels == 0) {
        if (!takeNames(std::istringstream(line), block)) {
          return 2;
        }
      } else if (!takeRow(std::istringstream(line), newest, block)) {
        std::cerr << "left out, without a time or not later than the row before: " << line << "\n";
      }
      line.clear();
    }
    const bool full = newest - sent >= kLongest || block.instant.size() >= kMaxRows;
    if (!block.instant.empty() && (file.eof() || full)) {
      send(link, channel, block);
      sent = newest;
    }
    if (file.eof()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
}
