#include "scene/csv_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "messages/input_error.h"
#include "messages/names.h"
#include "scene/node_reader.h"

namespace whirl_twin {

namespace {

constexpr std::uintmax_t kMaxCsvSize = 64u << 20;  // bytes; two million rows of two numbers

constexpr std::size_t kMaxReported = 10;  // duplicate names, and columns of each, in a message

/// Removes surrounding blanks, quotes, and a byte order mark.
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

/// "2 and 4", "2, 4 and 5"; long lists are truncated.
std::string listed(const std::vector<std::size_t>& numbers) {
  const std::size_t last = std::min(numbers.size(), kMaxReported) - 1;
  const std::size_t more = numbers.size() - last - 1;
  return fmt::format(
      "{} and {}", fmt::join(numbers.begin(), numbers.begin() + last, ", "),
      more == 0 ? fmt::format("{}", numbers[last]) : fmt::format("{} more", more + 1));
}

/// A duplicate column name is ambiguous. Columns without a name cannot be requested and are
/// ignored.
void requireDifferent(const std::vector<std::string>& header) {
  std::map<std::string, std::vector<std::size_t>> columns;  // column numbers of a name, from 1
  for (std::size_t i = 0; i < header.size(); ++i) {
    columns[header[i]].push_back(i + 1);
  }
  std::vector<std::string> repeated;
  for (const auto& [name, numbers] : columns) {
    if (!name.empty() && numbers.size() > 1) {
      repeated.push_back(
          fmt::format("columns {} are named {}", listed(numbers), whirl_twin::inQuotes(name)));
    }
  }
  if (repeated.size() > kMaxReported) {
    const std::size_t more = repeated.size() - kMaxReported;
    repeated.resize(kMaxReported);
    repeated.push_back(fmt::format("and {} more such names", more));
  }
  if (!repeated.empty()) {
    throw InputError(
        fmt::format("line 1: column names must be unique; {}", fmt::join(repeated, "; ")));
  }
}

/// A value beyond the named columns makes the assignment of values to names ambiguous. A trailing
/// comma is not a value.
void requireNames(std::size_t names, const std::vector<std::string>& values, std::size_t line) {
  const auto extra =
      std::find_if(values.begin() + static_cast<std::ptrdiff_t>(std::min(names, values.size())),
                   values.end(), [](const std::string& value) { return !value.empty(); });
  if (extra != values.end()) {
    throw InputError(
        fmt::format("line {}: expected at most {} {}, as many as line 1 has names, found {}", line,
                    names, names == 1 ? "value" : "values", values.size()));
  }
}

void requireFile(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw InputError("no such file");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError("not a file");
  }
  if (std::filesystem::file_size(path, error) > kMaxCsvSize) {
    throw InputError("larger than 64 MiB, the limit of an input table");
  }
}

}  // namespace

std::vector<std::string> csvCells(const std::string& line) {
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

std::vector<std::vector<double>> csvColumns(const std::string& path,
                                            const std::vector<std::string>& names, bool* cut) {
  requireFile(path);
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line)) {
    throw InputError("must have the names of the columns in its first line, found an empty file");
  }
  const std::vector<std::string> header = csvCells(line);
  requireDifferent(header);
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) {
      throw InputError(
          fmt::format("no column {}{}", whirl_twin::inQuotes(name), printable(hint(name, header))));
    }
    places.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  std::vector<std::vector<double>> columns(names.size());
  for (std::size_t row = 2; std::getline(file, line); ++row) {
    if (trimmed(line).empty()) {
      continue;
    }
    if (cut != nullptr && file.eof()) {
      *cut = true;
      break;
    }
    const std::vector<std::string> values = csvCells(line);
    requireNames(header.size(), values, row);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::optional<double> value =
          places[i] < values.size() ? parseNumber(values[places[i]]) : std::nullopt;
      if (!value) {
        throw InputError(
            fmt::format("line {}: {} must be a finite number, found {}", row, printable(names[i]),
                        places[i] < values.size() ? whirl_twin::inQuotes(values[places[i]])
                                                  : std::string("nothing")));
      }
      columns[i].push_back(*value);
    }
  }
  if (columns.front().empty()) {
    throw InputError("no rows below the names of the columns");
  }
  return columns;
}

}  // namespace whirl_twin
