#include "scene/table_dialect.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxReported = 10;  // duplicate names, and columns of each, in a message

bool startsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

std::string nameOf(char separator) {
  return separator == '\t' ? "a tab" : separator == ' ' ? "blanks" : fmt::format("'{}'", separator);
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
void requireDifferent(const TableDialect& dialect) {
  std::map<std::string, std::vector<std::size_t>> columns;  // column numbers of a name, from 1
  for (std::size_t i = 0; i < dialect.columns.size(); ++i) {
    columns[dialect.columns[i].heading].push_back(i + 1);
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
    throw InputError(fmt::format("line {}: column names must be unique; {}", dialect.names_line,
                                 fmt::join(repeated, "; ")));
  }
}

/// Number of cells of a row of numbers; 0: there is another cell, or no number.
std::size_t numbersIn(const std::vector<std::string_view>& cells, char decimal) {
  bool any = false;
  for (const std::string_view cell : cells) {
    const std::optional<double> number = cellNumber(cell, decimal);
    if (!number && !isoInstant(cell)) {
      return 0;
    }
    any = any || !number || std::isfinite(*number);
  }
  return any ? cells.size() : 0;
}

struct Way {
  char separator, decimal;
};
constexpr std::array<Way, 9> kWays = {{{',', '.'},
                                       {';', '.'},
                                       {'\t', '.'},
                                       {';', ','},
                                       {'\t', ','},
                                       {' ', '.'},
                                       {' ', ','},
                                       {',', ','},
                                       {'|', '.'}}};

/// Of a way to read the lines: how many are rows of numbers, of as many as most of them have, or
/// the more of two counts that are as frequent.
struct Fit {
  std::size_t rows = 0, cells = 0;

  bool operator<(const Fit& other) const {
    return std::pair(cells > 1, rows) < std::pair(other.cells > 1, other.rows);
  }
};

Fit fitOf(const Way& way, const std::vector<std::string>& lines, const TableDialect& dialect,
          std::size_t skip) {
  std::map<std::size_t, std::size_t> rows;  // of each count of cells
  std::vector<std::string_view> cells;
  for (std::size_t i = skip; i < lines.size(); ++i) {
    if (!dialect.isComment(lines[i])) {
      splitCells(lines[i], way.separator, cells);
      ++rows[numbersIn(cells, way.decimal)];
    }
  }
  rows.erase(0);
  Fit best;
  for (const auto& [count, times] : rows) {
    best = times >= best.rows ? Fit{times, count} : best;
  }
  return best;
}

/// In a table without numbers that which divides its first line most.
char separatorOf(const std::vector<std::string>& lines, std::size_t skip) {
  std::vector<std::string_view> cells;
  char separator = ',';
  std::size_t most = 1;
  for (const char one : {',', ';', '\t'}) {
    splitCells(skip < lines.size() ? lines[skip] : "", one, cells);
    if (cells.size() > most) {
      separator = one;
      most = cells.size();
    }
  }
  return separator;
}

/// The names of a line; of one in blanks, a unit in brackets belongs to the name before it.
std::vector<std::string> headingsOf(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  splitCells(line, separator, cells);
  std::vector<std::string> headings;
  for (const std::string_view cell : cells) {
    if (separator == ' ' && !headings.empty() && !cell.empty() &&
        (cell.front() == '(' || cell.front() == '[')) {
      headings.back() += " " + std::string(cell);
    } else {
      headings.emplace_back(cell);
    }
  }
  while (headings.size() > 1 && headings.back().empty()) {
    headings.pop_back();
  }
  return headings;
}

/// Finds the lines of names and units.
class Headings {
 public:
  Headings(const std::vector<std::string>& lines, std::size_t skip, std::size_t cells,
           TableDialect& dialect)
      : lines_(lines), dialect_(dialect), first_(skip) {
    while (first_ < lines.size() && !isRow(first_, cells)) {
      ++first_;
    }
    std::optional<std::size_t> names = before(first_, skip);
    if (first_ == lines.size()) {  // no row of numbers: the first line has the names
      names = std::nullopt;
      for (std::size_t i = skip; !names && i < lines.size(); ++i) {
        names = isText(i) ? std::optional(i) : std::nullopt;
      }
    }
    if (names) {
      const std::optional<std::size_t> above = before(*names, skip);
      if (above && first_ < lines.size() && isUnits(*names) &&
          headingsOf(lines[*above], dialect.separator).size() >=
              headingsOf(lines[*names], dialect.separator).size()) {
        setUnits(*names);
        names = above;
      }
    } else {
      names = commented(skip, cells);
    }
    if (names) {
      setNames(*names);
    }
    dialect_.rows_after = std::max(names ? *names + 1 : skip, dialect_.units_line);
    if (!names) {
      for (std::size_t i = 0; i < cells; ++i) {
        dialect_.columns.push_back(columnOfHeading(std::to_string(i + 1)));
      }
    }
    for (std::size_t i = 0; i < std::min(units_.size(), dialect_.columns.size()); ++i) {
      if (!unitIn(units_[i]).empty()) {
        dialect_.columns[i].name = dialect_.columns[i].heading;
        dialect_.columns[i].unit = unitIn(units_[i]);
      }
    }
  }

 private:
  bool isBlank(std::size_t line) const { return withoutBlanks(lines_[line]).empty(); }
  bool isRow(std::size_t line, std::size_t count) const {
    std::vector<std::string_view> cells;
    if (dialect_.isComment(lines_[line])) {
      return false;
    }
    splitCells(lines_[line], dialect_.separator, cells);
    const std::size_t numbers = numbersIn(cells, dialect_.decimal);
    return numbers > (count > 1 ? 1u : 0u);
  }
  /// Its first cell is a text.
  bool isText(std::size_t line) const {
    std::vector<std::string_view> cells;
    if (isBlank(line) || dialect_.isComment(lines_[line])) {
      return false;
    }
    splitCells(lines_[line], dialect_.separator, cells);
    const auto first = std::find_if(cells.begin(), cells.end(),
                                    [](std::string_view cell) { return !cell.empty(); });
    return first != cells.end() && !cellNumber(*first, dialect_.decimal) && !isoInstant(*first);
  }
  std::optional<std::size_t> before(std::size_t line, std::size_t skip) const {
    for (std::size_t i = line; i-- > skip;) {
      if (isText(i)) {
        return i;
      }
    }
    return std::nullopt;
  }
  bool isUnits(std::size_t line) const {
    const std::vector<std::string> cells = headingsOf(lines_[line], dialect_.separator);
    return std::all_of(cells.begin(), cells.end(), [](const std::string& cell) {
      return cell.empty() || cell == "-" || !unitIn(cell).empty();
    });
  }
  /// The last comment before the rows, with as many words as a row has numbers: `# t x y`.
  std::optional<std::size_t> commented(std::size_t skip, std::size_t cells) const {
    std::optional<std::size_t> last;
    for (std::size_t i = skip; i < first_ && first_ < lines_.size(); ++i) {
      last = isBlank(i) ? last : std::optional(i);
    }
    return last && headingsOf(uncommented(lines_[*last]), dialect_.separator).size() == cells
               ? last
               : std::nullopt;
  }
  static std::string_view uncommented(std::string_view line) {
    line = withoutBlanks(line);
    while (!line.empty() && (line.front() == '#' || line.front() == '%' || line.front() == '/')) {
      line.remove_prefix(1);
    }
    return withoutBlanks(line);
  }
  void setUnits(std::size_t line) {
    dialect_.units_line = line + 1;
    units_ = headingsOf(lines_[line], dialect_.separator);
  }
  void setNames(std::size_t line) {
    dialect_.names_line = line + 1;
    const std::string_view text =
        dialect_.isComment(lines_[line]) ? uncommented(lines_[line]) : lines_[line];
    for (const std::string& heading : headingsOf(text, dialect_.separator)) {
      dialect_.columns.push_back(columnOfHeading(heading));
    }
  }

  const std::vector<std::string>& lines_;
  TableDialect& dialect_;
  std::size_t first_;  // row of numbers
  std::vector<std::string> units_;
};

}  // namespace

const std::vector<std::string>& tableKeys() {
  static const std::vector<std::string> keys = {"separator", "decimal", "comment", "skip",
                                                "names",     "time",    "rate"};
  return keys;
}

TableSettings readTableSettings(const MapReader& map, Diagnostics& diagnostics) {
  TableSettings settings;
  const std::string separator =
      map.choice("separator", {",", ";", "\t", " ", "|", "tab", "blank"}, "a separator", "");
  if (!separator.empty()) {
    settings.separator = separator == "tab" ? '\t' : separator == "blank" ? ' ' : separator.front();
  }
  const std::string decimal = map.choice("decimal", {".", ","}, "a decimal mark", "");
  if (!decimal.empty()) {
    settings.decimal = decimal.front();
  }
  settings.comment = map.text("comment", "");
  settings.skip = static_cast<std::size_t>(map.integer("skip", 0, 10'000, 0));
  if (map.has("names")) {
    const YAML::Node names = map.at("names");
    if (!names.IsSequence() || names.size() == 0) {
      diagnostics.add(map.key("names"), "must be a list of names, one for each column");
    } else {
      for (const YAML::Node& name : names) {
        settings.names.push_back(name.IsScalar() ? name.Scalar() : "");
      }
    }
  }
  if (map.has("time") && map.at("time").IsMap()) {
    const MapReader time(map.at("time"), map.key("time"), {"column", "unit"}, "key of the time",
                         diagnostics);
    settings.time = time.text("column", "");
    settings.time_unit = time.text("unit", "");
    if (!settings.time_unit.empty() && unitScale(settings.time_unit, "s") == 0.0) {
      diagnostics.add(time.key("unit"), fmt::format("must be a unit of time, found {}",
                                                    whirl_twin::inQuotes(settings.time_unit)));
    }
  } else {
    settings.time = map.text("time", "");
  }
  settings.rate = map.has("rate") ? map.number("rate", Range::kPositive, "Hz", 0.0) : 0.0;
  return settings;
}

std::string TableDialect::text() const {
  std::string out = fmt::format("separator {}, decimal '{}'", nameOf(separator), decimal);
  if (names_line != 1) {
    out += names_line == 0 ? std::string(", no names: columns by number")
                           : fmt::format(", names in line {}", names_line);
  }
  return units_line == 0 ? out : fmt::format("{}, units in line {}", out, units_line);
}

bool TableDialect::isPlain() const {
  return separator == ',' && decimal == '.' && names_line == 1 && units_line == 0;
}

bool TableDialect::isComment(std::string_view line) const {
  line = withoutBlanks(line);
  if (!comment.empty()) {
    return startsWith(line, comment);
  }
  if (!line.empty() && line.front() == '"') {
    line.remove_prefix(1);
  }
  return startsWith(line, "#") || startsWith(line, "%") || startsWith(line, "//");
}

TableDialect dialectOf(const std::vector<std::string>& lines, const TableSettings& settings) {
  TableDialect dialect;
  dialect.comment = settings.comment;
  Fit best;
  for (const Way& way : kWays) {
    if (settings.separator.value_or(way.separator) != way.separator ||
        settings.decimal.value_or(way.decimal) != way.decimal) {
      continue;
    }
    const Fit fit = fitOf(way, lines, dialect, settings.skip);
    if (best < fit) {
      best = fit;
      dialect.separator = way.separator;
      dialect.decimal = way.decimal;
    }
  }
  if (best.rows == 0) {
    dialect.separator = settings.separator.value_or(separatorOf(lines, settings.skip));
    dialect.decimal = settings.decimal.value_or('.');
  }
  Headings(lines, settings.skip, best.cells, dialect);
  if (!settings.names.empty()) {
    dialect.columns.clear();
    for (const std::string& name : settings.names) {
      dialect.columns.push_back(columnOfHeading(name));
    }
  }
  requireDifferent(dialect);
  return dialect;
}

}  // namespace whirl_twin
