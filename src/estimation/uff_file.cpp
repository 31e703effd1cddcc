#include "estimation/uff_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>

#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxUffNumbers = 100'000'000;  // of all responses, in memory
constexpr int kReal = 2, kDouble = 4;                // types of ordinates
constexpr double kSameInstant = 1.0e-6;              // of a step
constexpr double kLatestUff = 9.0e9;                 // s

struct Response {
  TableColumn column;
  std::vector<double> instants, values;  // [s]
};

/// A field of fixed width; column from 0 on.
std::string field(const std::string& line, std::size_t column, std::size_t width) {
  return column < line.size()
             ? std::string(withoutBlanks(std::string_view(line).substr(column, width)))
             : "";
}

double number(const std::string& line, std::size_t column, std::size_t width) {
  std::string text = field(line, column, width);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
  const std::optional<double> value = cellNumber(text, '.');
  if (!value || std::isnan(*value)) {
    throw InputError(fmt::format("expected a number in columns {} to {}, found {}", column + 1,
                                 column + width, inQuotes(text)));
  }
  return *value;
}

/// Blanks are 0, as in FORTRAN.
int integer(const std::string& line, std::size_t column, std::size_t width) {
  constexpr double kMaxInteger = 2.0e9;
  return field(line, column, width).empty()
             ? 0
             : static_cast<int>(std::clamp(number(line, column, width), -kMaxInteger, kMaxInteger));
}

class UffScan {
 public:
  explicit UffScan(const std::string& path) : in_(path, std::ios::binary) {}

  /// Of the data sets 58; `others`: how many are none that is read.
  std::vector<Response> responses(std::size_t& others) try {
    std::vector<Response> all;
    while (more()) {
      if (withoutBlanks(line()) != "-1" || !more()) {
        continue;
      }
      const std::string kind = field(line(), 0, 7);
      if (kind == "58b") {
        throw InputError("a binary data set, 58b, is not read: export it as ASCII");
      }
      if (kind == "58") {
        readResponse(all, others);
      }
      while (more() && withoutBlanks(line()) != "-1") {
      }
    }
    return all;
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("line {}: {}; read as a universal file (UFF 58)", number_, error.what()));
  }

 private:
  bool more() { return in_.peek() != std::char_traits<char>::eof(); }
  std::string line() {
    std::string text;
    if (!std::getline(in_, text)) {
      throw InputError("the file ends within a data set");
    }
    ++number_;
    return text;
  }

  void readResponse(std::vector<Response>& all, std::size_t& others) {
    Response response;
    const std::string id(withoutBlanks(line()));
    for (int i = 0; i < 4; ++i) {
      line();
    }
    const std::string of = line();  // function and response
    const int function = integer(of, 0, 5), direction = integer(of, 51, 4);
    constexpr std::array<const char*, 7> kDirections = {"-Z", "-Y", "-X", "", "+X", "+Y", "+Z"};
    const std::string entity = field(of, 31, 10);
    response.column.name =
        (entity == "NONE" ? "" : entity) + field(of, 41, 10) +
        (std::abs(direction) <= 3 ? kDirections[static_cast<std::size_t>(direction + 3)] : "");
    response.column.heading = id.empty() || id == "NONE" ? response.column.name : id;
    const std::string form = line();
    const int type = integer(form, 0, 10), count = integer(form, 10, 10);
    const bool even = integer(form, 20, 10) == 1;
    const double first = number(form, 30, 13), step = number(form, 43, 13);
    const std::string abscissa = unitIn(field(line(), 47, 20));
    response.column.unit = unitIn(field(line(), 47, 20));
    line();
    line();
    if (function > 1 || (type != kReal && type != kDouble)) {
      ++others;
      return;
    }
    numbers_ += 2 * static_cast<std::size_t>(std::max(1, count));
    const double scale = unitScale(abscissa, "s");
    if (count < 1 || numbers_ > kMaxUffNumbers || scale == 0.0) {
      throw InputError(fmt::format(
          "{} must have from 1 to {} values over a time in s, found {} over {}",
          inQuotes(response.column.heading), kMaxUffNumbers / 2, count, inQuotes(abscissa)));
    }
    readNumbers(static_cast<std::size_t>(count), even, type == kReal ? 13 : 20, response);
    for (int i = 0; even && i < count; ++i) {
      response.instants.push_back(first + step * i);
    }
    for (double& instant : response.instants) {
      instant *= scale;
    }
    all.push_back(std::move(response));
  }

  /// Fields have a fixed width, maybe without a blank between them.
  void readNumbers(std::size_t count, bool even, std::size_t width, Response& response) {
    constexpr std::size_t kAbscissa = 13;
    std::vector<double>& values = response.values;
    while (values.size() < count) {
      const std::string text = line();
      const std::size_t length = text.find_last_not_of(" \t\r") + 1;
      if (length == 0 || withoutBlanks(text) == "-1") {
        throw InputError(fmt::format("expected {} values, found {}", count, values.size()));
      }
      for (std::size_t at = 0; at < length && values.size() < count; at += width) {
        if (!even) {
          response.instants.push_back(number(text, at, kAbscissa));
          at += kAbscissa;
        }
        values.push_back(number(text, at, width));
      }
    }
  }

  std::ifstream in_;
  std::size_t number_ = 0, numbers_ = 0;
};

class UffTable : public NumberTable {
 public:
  explicit UffTable(const std::string& path) {
    std::size_t others = 0;
    responses_ = UffScan(path).responses(others);
    if (responses_.empty()) {
      throw InputError(
          "must have a time response (data set 58, function 0 or 1, real), found none");
    }
    if (others > 0) {
      remarks_.push_back(fmt::format("{} of {} data sets 58 are not real time responses: left out",
                                     others, others + responses_.size()));
    }
    const std::vector<double>& first = responses_.front().instants;
    const double slack =
        kSameInstant * std::fabs(first.back() - first.front()) / static_cast<double>(first.size());
    for (const Response& response : responses_) {
      if (!std::equal(first.begin(), first.end(), response.instants.begin(),
                      response.instants.end(),
                      [&](double a, double b) { return std::fabs(a - b) <= slack; })) {
        throw InputError(fmt::format("{} must have the instants of {}, found others",
                                     inQuotes(response.column.heading),
                                     inQuotes(responses_.front().column.heading)));
      }
      columns_.push_back(response.column);
    }
  }

  const std::vector<TableColumn>& columns() const override { return columns_; }
  void selectOverTime(const std::vector<std::size_t>& columns) override { selected_ = columns; }
  bool next(std::vector<double>& values) override {
    if (row_ == size()) {
      return false;
    }
    values.clear();
    for (const std::size_t column : selected_) {
      values.push_back(responses_[column].values[row_]);
    }
    const double time = responses_.front().instants[row_++];
    has_instant_ = std::fabs(time) < kLatestUff;
    instant_ = has_instant_ ? std::llround(1.0e9 * time) : 0;
    return true;
  }
  std::string place() const override { return fmt::format("value {}", row_); }
  std::uint64_t offset() const override { return row_; }
  std::uint64_t size() const override { return responses_.front().values.size(); }
  std::vector<std::string> remarks() const override { return remarks_; }

 private:
  std::vector<Response> responses_;
  std::vector<TableColumn> columns_;
  std::vector<std::size_t> selected_;
  std::vector<std::string> remarks_;
  std::size_t row_ = 0;
};

}  // namespace

bool isUffFile(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return false;  // a pipe would wait for its writer
  }
  std::ifstream in(path, std::ios::binary);
  std::array<char, 80> begin{};
  in.getline(begin.data(), begin.size());
  return withoutBlanks(begin.data()) == "-1" && begin[0] == ' ';
}

std::unique_ptr<NumberTable> openUffFile(const std::string& path) {
  return std::make_unique<UffTable>(path);
}

std::unique_ptr<NumberTable> openNumberTable(const std::string& path,
                                             const TableSettings& settings) {
  if (isUffFile(path)) {
    return openUffFile(path);
  }
  return std::make_unique<TableReader>(path, settings);
}

}  // namespace whirl_twin
