#include "scene/table_cells.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <ctime>
#include <limits>
#include <utility>

#include "messages/units.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMaxNumberLength = 400;
constexpr double kGapValue = std::numeric_limits<double>::quiet_NaN();

bool isGapWord(std::string_view cell) {
  constexpr std::size_t kLongest = 4;
  if (cell.empty()) {
    return true;
  }
  if (cell.front() == '-' || cell.front() == '+') {
    cell.remove_prefix(1);
  }
  if (cell.size() < 2 || cell.size() > kLongest) {
    return false;
  }
  std::string word(cell);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<const char*, 6> kWords = {"nan", "na", "n/a", "null", "none", "inf"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

/// Of micro and degree signs, in UTF-8 or Latin-1, the letters that units are written in here.
std::string inLetters(std::string unit) {
  for (const auto& [sign, letters] :
       {std::pair("\xc2\xb5", "u"), std::pair("\xce\xbc", "u"), std::pair("\xc2\xb0", "deg "),
        std::pair("\xb5", "u"), std::pair("\xb0", "deg ")}) {
    for (std::size_t at = unit.find(sign); at != std::string::npos; at = unit.find(sign)) {
      unit.replace(at, std::string_view(sign).size(), letters);
    }
  }
  return std::string(withoutBlanks(unit));
}

}  // namespace

std::string_view withoutBlanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string_view::npos
             ? std::string_view()
             : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string unitIn(std::string_view text) {
  text = withoutBlanks(text);
  if (text.size() > 1 && ((text.front() == '[' && text.back() == ']') ||
                          (text.front() == '(' && text.back() == ')'))) {
    text = text.substr(1, text.size() - 2);
  }
  const std::string unit = inLetters(std::string(text));
  return !unit.empty() && std::isalpha(static_cast<unsigned char>(unit.front())) != 0 &&
                 isUnit(unit)
             ? unit
             : "";
}

TableColumn columnOfHeading(const std::string& heading) {
  const auto split = [&](std::size_t at, std::size_t skip) {
    TableColumn column{heading, std::string(withoutBlanks(heading.substr(0, at))),
                       unitIn(heading.substr(at + skip))};
    return column;
  };
  std::vector<TableColumn> ways;
  if (!heading.empty() && (heading.back() == ']' || heading.back() == ')')) {
    ways.push_back(
        split(std::min(heading.rfind(heading.back() == ']' ? '[' : '('), heading.size() - 1), 0));
  }
  for (const char mark : {',', '/'}) {
    if (const std::size_t at = heading.find(mark); at != std::string::npos) {
      ways.push_back(split(at, 1));
    }
  }
  for (const TableColumn& way : ways) {
    if (!way.unit.empty() && !way.name.empty()) {
      return way;
    }
  }
  return {heading, heading, ""};
}

void splitCells(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  const bool blanks = separator == ' ';
  const bool quotes = line.find('"') != std::string_view::npos;
  line = blanks ? withoutBlanks(line) : line;
  std::size_t from = 0;
  while (true) {
    if (quotes) {
      const std::size_t open = line.find_first_not_of(" \t", from);
      if (open != std::string_view::npos && line[open] == '"' && separator != line[open]) {
        std::size_t close = line.find('"', open + 1);
        while (close != std::string_view::npos && close + 1 < line.size() &&
               line[close + 1] == '"') {
          close = line.find('"', close + 2);
        }
        const std::size_t next = close == std::string_view::npos ? close
                                 : blanks                        ? line.find_first_of(" \t", close)
                                                                 : line.find(separator, close);
        const std::string_view rest = close == std::string_view::npos
                                          ? std::string_view("x")
                                          : line.substr(close + 1, next - close - 1);
        if (withoutBlanks(rest).empty()) {
          cells.push_back(withoutBlanks(line.substr(open + 1, close - open - 1)));
          if (next == std::string_view::npos) {
            return;
          }
          from = blanks ? line.find_first_not_of(" \t", next) : next + 1;
          continue;
        }
      }
    }
    const std::size_t end = blanks ? line.find_first_of(" \t", from) : line.find(separator, from);
    cells.push_back(withoutBlanks(line.substr(from, end - from)));
    if (end == std::string_view::npos) {
      return;
    }
    from = blanks ? line.find_first_not_of(" \t", end) : end + 1;
  }
}

std::optional<double> cellNumber(std::string_view cell, char decimal) {
  std::array<char, kMaxNumberLength> copy;
  if (!cell.empty() && cell.front() == '+' && cell.size() > 1 && cell[1] != '-') {
    cell.remove_prefix(1);
  }
  if (decimal != '.') {
    if (cell.size() > copy.size() || cell.find('.') != std::string_view::npos) {
      return std::nullopt;
    }
    std::replace_copy(cell.begin(), cell.end(), copy.begin(), decimal, '.');
    cell = std::string_view(copy.data(), cell.size());
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error == std::errc() && end == cell.data() + cell.size() && std::isfinite(value)) {
    return value;
  }
  return isGapWord(cell) ? std::optional(kGapValue) : std::nullopt;
}

std::optional<std::int64_t> isoInstant(std::string_view cell) {
  constexpr std::size_t kDateAndTime = 19, kMaxIso = 40;  // characters
  if (cell.size() < kDateAndTime || cell.size() > kMaxIso || cell[4] != '-' || cell[13] != ':' ||
      (cell[10] != 'T' && cell[10] != ' ')) {
    return std::nullopt;
  }
  const std::string text(cell);
  std::tm date{}, zone{};
  const char* rest =
      ::strptime(text.c_str(), cell[10] == 'T' ? "%Y-%m-%dT%H:%M:%S" : "%Y-%m-%d %H:%M:%S", &date);
  if (rest == nullptr || date.tm_year < 0 || date.tm_year > 300) {  // 1900 to 2200, in ns
    return std::nullopt;
  }
  std::int64_t instant = std::int64_t{::timegm(&date)} * 1'000'000'000;
  if (*rest == '.' || *rest == ',') {
    std::int64_t digit = 100'000'000;
    for (++rest; std::isdigit(static_cast<unsigned char>(*rest)) != 0; ++rest, digit /= 10) {
      instant += digit * (*rest - '0');
    }
  }
  if (*rest != '\0') {
    rest = ::strptime(rest, "%z", &zone);
  }
  return rest != nullptr && *rest == '\0'
             ? std::optional(instant - std::int64_t{zone.tm_gmtoff} * 1'000'000'000)
             : std::nullopt;
}

}  // namespace whirl_twin
