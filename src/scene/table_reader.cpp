#include "scene/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kBuffer = 1u << 18;             // bytes
constexpr std::size_t kMaxLine = 1u << 20;            // bytes
constexpr std::size_t kHeadLines = 400;               // from which the dialect is found
constexpr std::uintmax_t kMaxSceneTable = 64u << 20;  // bytes; two million rows of two numbers
constexpr double kLatest = 9.0e18;                    // ns
constexpr std::size_t kMaxHint = 300;                 // characters

bool isTimeName(const std::string& name) {
  std::string word;
  for (const char c : name) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  static const std::vector<std::string> words = {
      "t",     "time",   "timestamp", "zeit", "timevalue", "xvalue",   "stamp",
      "times", "timems", "timeus",    "tms",  "tus",       "datetime", "elapsedtime"};
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// "ms" of `time_ms`.
std::string unitAfterUnderscore(const std::string& name) {
  const std::size_t at = name.rfind('_');
  const std::string unit = at == std::string::npos ? "" : name.substr(at + 1);
  return !unit.empty() && unitScale(unit, "s") != 0.0 ? unit : "";
}

}  // namespace

LineReader::LineReader(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw InputError("no such file");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError("not a file");
  }
  size_ = std::filesystem::file_size(path, error);
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) {
    throw InputError("cannot be read");
  }
  buffer_.resize(kBuffer);
}

bool LineReader::fill() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ == buffer_.size()) {
    if (end_ > kMaxLine) {
      throw InputError(fmt::format(
          "line {}: must be at most 1 MiB long: is this a table, with an end after each row?",
          number_ + 1));
    }
    buffer_.resize(2 * buffer_.size());
  }
  const std::size_t got = std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  end_ += got;
  return got > 0;
}

bool LineReader::next(std::string_view& line) {
  const auto endFrom = [this](std::size_t at) {
    return static_cast<const char*>(std::memchr(buffer_.data() + at, '\n', end_ - at));
  };
  const char* end = endFrom(begin_);
  for (std::size_t length = end_ - begin_; end == nullptr && fill(); length = end_ - begin_) {
    end = endFrom(begin_ + length);
  }
  const char* const from = buffer_.data() + begin_;
  cut_ = end == nullptr;
  const std::size_t length = cut_ ? end_ - begin_ : static_cast<std::size_t>(end - from);
  if (cut_ && length == 0) {
    return false;
  }
  line = std::string_view(from, length);
  begin_ += length + (cut_ ? 0 : 1);
  offset_ += length + (cut_ ? 0 : 1);
  if (number_++ == 0 && line.substr(0, 3) == "\xef\xbb\xbf") {
    line.remove_prefix(3);
  }
  return true;
}

TableReader::TableReader(const std::string& path, TableSettings settings)
    : settings_(std::move(settings)), lines_(path) {
  std::vector<std::string> head;
  {
    LineReader lines(path);
    std::string_view line;
    while (head.size() < settings_.skip + kHeadLines && lines.next(line)) {
      if (head.empty() && (line.substr(0, 2) == "\xff\xfe" || line.substr(0, 2) == "\xfe\xff")) {
        throw InputError("must be in UTF-8 or ASCII, found UTF-16: save it as CSV in UTF-8");
      }
      head.emplace_back(line);
    }
  }
  if (head.empty()) {
    throw InputError("must have the names of the columns in its first line, found an empty file");
  }
  dialect_ = dialectOf(head, settings_);
  std::string_view line;
  for (std::size_t i = 0; i < dialect_.rows_after && lines_.next(line); ++i) {
  }
}

std::optional<std::size_t> NumberTable::findColumn(const std::string& name) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < columns().size(); ++i) {
    if (columns()[i].heading == name) {
      return i;
    }
    if (columns()[i].name == name) {
      found.push_back(i);
    }
  }
  if (found.size() > 1) {
    throw InputError(fmt::format("more than one column {}: give its whole heading{}",
                                 whirl_twin::inQuotes(name), how()));
  }
  return found.empty() ? std::nullopt : std::optional(found.front());
}

std::size_t NumberTable::column(const std::string& name) const {
  if (const std::optional<std::size_t> found = findColumn(name)) {
    return *found;
  }
  std::vector<std::string> headings;
  for (const TableColumn& one : columns()) {
    headings.push_back(one.heading);
  }
  throw InputError(fmt::format("no column {}{}{}", whirl_twin::inQuotes(name),
                               printable(hint(name, headings), kMaxHint), how()));
}

std::string TableReader::place() const {
  return fmt::format("line {}", lines_.number());
}

std::string TableReader::how() const {
  return dialect_.isPlain() ? "" : "; read with " + dialect_.text();
}

void TableReader::selectOverTime(const std::vector<std::size_t>& columns) {
  select(columns);
  if (!settings_.time.empty()) {
    time_ = column(settings_.time);
  } else {
    for (std::size_t i = 0; i < dialect_.columns.size() && time_ == kNone; ++i) {
      const TableColumn& one = dialect_.columns[i];
      time_ = isTimeName(one.name) && settings_.rate == 0.0 ? i : kNone;
    }
  }
  if (settings_.rate > 0.0) {
    nanoseconds_ = 1.0e9 / settings_.rate;
  } else if (time_ == kNone && dialect_.names_line == 0 && settings_.names.empty()) {
    time_ = 0;
  } else if (time_ == kNone) {
    static_cast<void>(column("time"));  // reports what there is
  } else {
    const TableColumn& one = dialect_.columns[time_];
    const std::string unit = !settings_.time_unit.empty() ? settings_.time_unit
                             : !one.unit.empty()          ? one.unit
                                                          : unitAfterUnderscore(one.name);
    const double scale = unitScale(unit, "s");
    if (scale == 0.0) {
      throw InputError(
          fmt::format("column {}: the time must be in s or another unit of time, found "
                      "{}",
                      whirl_twin::inQuotes(one.heading), printable(unit)));
    }
    nanoseconds_ = 1.0e9 * scale;
  }
}

double TableReader::number(std::size_t column) const {
  if (column >= cells_.size()) {
    return kNaN;
  }
  const std::optional<double> value = cellNumber(cells_[column], dialect_.decimal);
  if (!value) {
    throw InputError(fmt::format("{}: {} must be a finite number, found {}{}", place(),
                                 printable(columns()[column].heading),
                                 whirl_twin::inQuotes(std::string(cells_[column])), how()));
  }
  return *value;
}

void TableReader::readInstant() {
  has_instant_ = true;
  if (time_ != kNone && time_ < cells_.size()) {
    if (const std::optional<std::int64_t> instant = isoInstant(cells_[time_])) {
      instant_ = *instant;
      return;
    }
  }
  const double value = nanoseconds_ * (time_ == kNone ? static_cast<double>(row_) : number(time_));
  ++row_;
  has_instant_ = !std::isnan(value);
  if (has_instant_ && !(std::fabs(value) < kLatest)) {
    throw InputError(fmt::format("{}: the time must be within {:g} s, found {:g} s{}", place(),
                                 1.0e-9 * kLatest, 1.0e-9 * value, how()));
  }
  instant_ = has_instant_ ? std::llround(value) : instant_;
}

bool TableReader::nextRow(std::vector<double>& values, bool complete) {
  std::string_view text;
  while (lines_.next(text)) {
    if (withoutBlanks(text).empty() || dialect_.isComment(text)) {
      continue;
    }
    if (complete && lines_.cut()) {
      left_out_ = true;
      return false;
    }
    splitCells(text, dialect_.separator, cells_);
    for (std::size_t i = columns().size(); i < cells_.size(); ++i) {
      if (!cells_[i].empty()) {  // a separator at the end is not a value
        throw InputError(fmt::format("{}: expected at most {} {}, as many as {} names, found {}{}",
                                     place(), columns().size(),
                                     columns().size() == 1 ? "value" : "values",
                                     dialect_.names_line == 0 || !settings_.names.empty()
                                         ? std::string("there are")
                                         : fmt::format("line {} has", dialect_.names_line),
                                     cells_.size(), how()));
      }
    }
    values.clear();
    for (const std::size_t column : selected_) {
      values.push_back(number(column));
    }
    if (time_ != kNone || settings_.rate > 0.0) {
      readInstant();
    }
    return true;
  }
  return false;
}

std::vector<std::string> TableReader::remarks() const {
  std::vector<std::string> remarks;
  if (!dialect_.isPlain()) {
    remarks.push_back("read as a table with " + dialect_.text());
  }
  if (left_out_) {
    remarks.emplace_back("the file ends within a line: its last row is left out");
  }
  return remarks;
}

std::vector<std::vector<double>> tableColumns(
    const std::string& path, const std::vector<std::pair<std::string, std::string>>& wanted) {
  std::error_code error;
  if (std::filesystem::file_size(path, error) > kMaxSceneTable && !error) {
    throw InputError("larger than 64 MiB, the limit of an input table");
  }
  TableReader table(path, {});
  std::vector<std::size_t> places;
  std::vector<double> scales;
  for (const auto& [name, unit] : wanted) {
    places.push_back(table.column(name));
    const std::string& of_table = table.columns()[places.back()].unit;
    scales.push_back(unitScale(of_table, unit));
    if (scales.back() == 0.0) {
      throw InputError(
          fmt::format("column {}: must be in {} or another unit of that kind, found {}",
                      whirl_twin::inQuotes(name), unit, printable(of_table)));
    }
  }
  table.select(places);
  std::vector<std::vector<double>> columns(wanted.size());
  std::vector<double> row;
  while (table.nextRow(row, false)) {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (std::isnan(row[i])) {
        throw InputError(fmt::format("{}: {} must be a finite number, found nothing{}",
                                     table.place(), printable(wanted[i].first), table.how()));
      }
      columns[i].push_back(scales[i] * row[i]);
    }
  }
  if (columns.front().empty()) {
    throw InputError("no rows below the names of the columns");
  }
  return columns;
}

}  // namespace whirl_twin
