// Corrupt files of measurements: each is read as a run that can be used in a fit, or rejected with
// an error text. 3,000 of them; 100,000 with WHIRL_TWIN_EXTREMES=full.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "../tools/twin_program.h"
#include "estimation/measured_run.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace measured_run_fuzz_test {

/// The same run in three notations.
std::string soundFile(int notation) {
  const auto row = [](double t) {
    return std::vector<std::string>{std::to_string(t), std::to_string(std::cos(3.0 * t)),
                                    std::to_string(10.0 * t)};
  };
  std::string text;
  if (notation == 2) {
    for (std::size_t column = 1; column < 3; ++column) {
      const std::string name = column == 1 ? "theta" : "torque";
      text += "    -1\n    58\n" + name + "\n\n\n\n\n    1" + std::string(50, ' ') +
              "\n         2        40         1  0.00000E+00  1.00000E-02  0.00000E+00\n\n\n\n\n";
      for (int k = 0; k < 40; ++k) {
        text += std::string(5, ' ') + row(0.01 * k)[column].substr(0, 8) + (k % 6 == 5 ? "\n" : "");
      }
      text += "\n    -1\n";
    }
    return text;
  }
  const std::string separator = notation == 0 ? "," : ";";
  text = "time" + separator + "theta" + separator + "torque\n";
  for (int k = 0; k < 40; ++k) {
    const std::vector<std::string> cells = row(0.01 * k);
    std::string line = cells[0] + separator + cells[1] + separator + cells[2] + "\n";
    if (notation == 1) {
      std::replace(line.begin(), line.end(), '.', ',');
    }
    text += line;
  }
  return text;
}

const std::vector<std::string> kPieces = {"nan",
                                          "inf",
                                          "-inf",
                                          "1e999",
                                          "-1e999",
                                          "1e-320",
                                          "0x1p3",
                                          "1,2",
                                          ",",
                                          "\n",
                                          "\r\n",
                                          "\r",
                                          "\t",
                                          " ",
                                          "\"",
                                          "\"\"",
                                          ";",
                                          "#",
                                          "time",
                                          "theta",
                                          "\xEF\xBB\xBF",
                                          std::string(1, '\0'),
                                          "\xFF\xFE",
                                          std::string(5000, '9'),
                                          std::string(5000, ','),
                                          "1.0.0",
                                          "--1",
                                          "+",
                                          ".",
                                          "e5",
                                          "9007199254740993",
                                          "0.05\n0.05\n",
                                          "-0.0"};

class Breaker {
 public:
  explicit Breaker(unsigned seed) : random_(seed) {}

  std::string broken(std::string text) {
    for (std::size_t times = 1 + below(4); times > 0; --times) {
      breakOnce(text);
    }
    return text;
  }

 private:
  std::size_t below(std::size_t n) { return random_() % n; }
  void breakOnce(std::string& text) {
    if (text.empty()) {
      text = kPieces[below(kPieces.size())];
      return;
    }
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(text.size() - at, 1 + below(60));
    switch (below(6)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, kPieces[below(kPieces.size())]);
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 4:
        text.resize(at);
        break;
      default:
        text.replace(at, length, kPieces[below(kPieces.size())]);
    }
  }

  std::mt19937 random_;
};

void expectUsable(const MeasuredRun& run, const std::string& text) {
  ASSERT_GE(run.time.size(), 5u) << text;
  for (std::size_t row = 0; row < run.time.size(); ++row) {
    ASSERT_TRUE(std::isfinite(run.time[row])) << text;
    ASSERT_TRUE(row == 0 || run.time[row] > run.time[row - 1]) << text;
  }
  for (const MeasuredColumn& column : run.columns) {
    ASSERT_EQ(column.values.size(), run.time.size()) << text;
    ASSERT_TRUE(std::all_of(column.values.begin(), column.values.end(), [](double value) {
      return std::isfinite(value);
    })) << text;
  }
}

TEST(MeasuredRunFuzz, EveryBrokenFileIsARunOrRefusedInWords) {
  const char* length = std::getenv("WHIRL_TWIN_EXTREMES");
  const int files = length != nullptr && std::string(length) == "full" ? 100000 : 3000;
  const TemporaryDirectory directory;
  int read = 0, refused = 0;
  for (int i = 0; i < files; ++i) {
    const std::string text = Breaker(static_cast<unsigned>(i + 1)).broken(soundFile(i % 3));
    const std::string path = directory.write("run.csv", text);
    try {
      expectUsable(readMeasuredRun(path, {}, {{"theta"}, {"torque"}}), text);
      ++read;
    } catch (const InputError& why) {
      const std::string said = why.what();
      ASSERT_FALSE(said.empty()) << text;
      ASSERT_LT(said.size(), 4000u) << said;
      ++refused;
    }
    if (HasFatalFailure()) {
      return;
    }
  }
  EXPECT_GT(read, files / 50);
  EXPECT_GT(refused, files / 5);
}

}  // namespace measured_run_fuzz_test
}  // namespace whirl_twin
