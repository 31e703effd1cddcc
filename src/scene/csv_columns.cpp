#include "scene/csv_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "messages/names.h"
#include "messages/refusal.h"
#include "scene/node_reader.h"

namespace whirl_twin {

namespace {

constexpr std::uintmax_t kMaxCsvSize = 64u << 20;  // bytes; two million rows of two numbers

constexpr std::size_t kMostTold = 10;  // names that stand twice, and columns of each

/// Without the blanks around it, the quotes around that, and a byte order mark.
std::string trimmed(std::string text) {
  const std::string blanks = " \t\r";
  if (text.rfind("\xef\xbb\xbf", 0) == 0) {
    text.erase(0, 3);
  }
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) {
    return "";
  }
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  const bool in_quotes = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return in_quotes ? text.substr(1, text.size() - 2) : text;
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> all;
  std::size_t from = 0;
  while (true) {
    const std::size_t comma = line.find(',', from);
    all.push_back(trimmed(line.substr(from, comma - from)));
    if (comma == std::string::npos) {
      return all;
    }
    from = comma + 1;
  }
}

/// "2 and 4", "2, 4 and 5"; of many the first ones.
std::string listed(const std::vector<std::size_t>& numbers) {
  const std::size_t last = std::min(numbers.size(), kMostTold) - 1;
  const std::size_t more = numbers.size() - last - 1;
  return fmt::format(
      "{} and {}", fmt::join(numbers.begin(), numbers.begin() + last, ", "),
      more == 0 ? fmt::format("{}", numbers[last]) : fmt::format("{} more", more + 1));
}

/// A name that stands over two columns does not say which is meant. Columns without a name do not
/// matter: nobody can ask for them.
void requireDifferent(const std::vector<std::string>& header) {
  std::map<std::string, std::vector<std::size_t>> columns;  // that a name stands over, from 1 on
  for (std::size_t i = 0; i < header.size(); ++i) {
    columns[header[i]].push_back(i + 1);
  }
  std::vector<std::string> repeated;
  for (const auto& [name, numbers] : columns) {
    if (!name.empty() && numbers.size() > 1) {
      repeated.push_back(
          fmt::format("columns {} are named {}", listed(numbers), whirl_twin::quoted(name)));
    }
  }
  if (repeated.size() > kMostTold) {
    const std::size_t more = repeated.size() - kMostTold;
    repeated.resize(kMostTold);
    repeated.push_back(fmt::format("and {} more such names", more));
  }
  if (!repeated.empty()) {
    throw Refusal(
        fmt::format("line 1: column names must be unique; {}", fmt::join(repeated, "; ")));
  }
}

/// A value without a name makes it doubtful which value belongs to which name. A comma at the end
/// of a line is none.
void requireNames(std::size_t names, const std::vector<std::string>& values, std::size_t line) {
  const auto extra =
      std::find_if(values.begin() + static_cast<std::ptrdiff_t>(std::min(names, values.size())),
                   values.end(), [](const std::string& value) { return !value.empty(); });
  if (extra != values.end()) {
    throw Refusal(
        fmt::format("line {}: expected at most {} {}, as many as line 1 has names, found {}", line,
                    names, names == 1 ? "value" : "values", values.size()));
  }
}

void requireFile(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw Refusal("no such file");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    throw Refusal("not a file");
  }
  if (std::filesystem::file_size(path, error) > kMaxCsvSize) {
    throw Refusal("larger than 64 MiB, the limit of an input table");
  }
}

}  // namespace

std::vector<std::vector<double>> csvColumns(const std::string& path,
                                            const std::vector<std::string>& names) {
  requireFile(path);
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line)) {
    throw Refusal("empty: the first line names the columns");
  }
  const std::vector<std::string> header = fields(line);
  requireDifferent(header);
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) {
      throw Refusal(
          fmt::format("no column {}{}", whirl_twin::quoted(name), printable(hint(name, header))));
    }
    places.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  std::vector<std::vector<double>> columns(names.size());
  for (std::size_t row = 2; std::getline(file, line); ++row) {
    if (trimmed(line).empty()) {
      continue;
    }
    const std::vector<std::string> values = fields(line);
    requireNames(header.size(), values, row);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::optional<double> value =
          places[i] < values.size() ? parseNumber(values[places[i]]) : std::nullopt;
      if (!value) {
        throw Refusal(fmt::format("line {}: {} must be a finite number, found {}", row,
                                  printable(names[i]),
                                  places[i] < values.size() ? whirl_twin::quoted(values[places[i]])
                                                            : std::string("nothing")));
      }
      columns[i].push_back(*value);
    }
  }
  if (columns.front().empty()) {
    throw Refusal("no rows below the names of the columns");
  }
  return columns;
}

}  // namespace whirl_twin
