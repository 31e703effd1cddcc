#include "scene/node_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "messages/names.h"
#include "messages/units.h"
#include "scene/parameter_limits.h"
#include "scene/written_quantity.h"

namespace whirl_twin {

std::optional<WrittenQuantity> writtenQuantity(const std::string& text) {
  const char* first = text.data();
  const char* const last = first + text.size();
  if (first != last && *first == '+' && last - first > 1 && first[1] != '-') {
    ++first;
  }
  WrittenQuantity written;
  const auto [end, error] = std::from_chars(first, last, written.value);
  if (error != std::errc() || !std::isfinite(written.value)) {
    return std::nullopt;
  }
  written.number.assign(first, end);
  const std::size_t rest = text.find_first_not_of(' ', static_cast<std::size_t>(end - text.data()));
  written.unit = rest == std::string::npos ? "" : text.substr(rest);
  return written;
}

std::optional<double> parseNumber(const std::string& text) {
  const auto written = writtenQuantity(text);
  return written && written->unit.empty() && text.back() != ' '
             ? std::optional<double>(written->value)
             : std::nullopt;
}

std::optional<double> parseQuantity(const std::string& text, const std::string& unit) {
  const auto written = writtenQuantity(text);
  if (!written || (!written->unit.empty() && !isUnit(written->unit))) {
    return std::nullopt;
  }
  const double scale = unitScale(written->unit, unit);
  const double value = written->value * scale;
  return scale != 0.0 && std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::string unitDiagnostic(const std::string& text, const std::string& unit) {
  const auto written = writtenQuantity(text);
  if (!written || written->unit.empty()) {
    return "";
  }
  const std::string& found = written->unit;
  if (found.size() > 1 && found[0] == ',' && found[1] >= '0' && found[1] <= '9') {
    return ": the decimal sign is a point";
  }
  const bool known = isUnit(found);
  if (known && unitScale(found, unit) != 0.0) {
    return "";
  }
  const std::string meant = unitMeant(found, unit);
  const std::string remedy = meant.empty() ? "" : fmt::format("; write '{}'", meant);
  if (!known) {
    return ": unknown unit " + inQuotes(found) + remedy;
  }
  return unit == "-" || unit.rfind("of ", 0) == 0
             ? ": the value is dimensionless"
             : fmt::format(": {} cannot be converted to {}{}", inQuotes(found), unit, remedy);
}

std::string unitDiagnostic(const YAML::Node& node, const std::string& unit) {
  return node.IsScalar() ? unitDiagnostic(node.Scalar(), unit) : "";
}

void Diagnostics::add(const std::string& key, const std::string& text) {
  all_.push_back(key.empty() ? fmt::format("{}: {}", source_, text)
                             : fmt::format("{}: {}: {}", source_, printable(key), text));
}

namespace {

constexpr std::size_t kMaxKeysShown = 5;

/// Several keys and none of those known.
bool isAnotherFile(const YAML::Node& node, const std::vector<std::string>& known) {
  return !known.empty() && node.size() > 1 &&
         std::none_of(node.begin(), node.end(), [&](const auto& entry) {
           return !entry.first.IsScalar() ||
                  std::find(known.begin(), known.end(), entry.first.Scalar()) != known.end() ||
                  !nearestName(entry.first.Scalar(), known).empty();
         });
}

}  // namespace

std::string shown(const YAML::Node& node) {
  if (!node.IsDefined() || node.IsNull()) {
    return "nothing";
  }
  if (node.IsScalar()) {
    const std::string& text = node.Scalar();
    return parseNumber(text) ? text : inQuotes(text);
  }
  return node.IsSequence() ? "a list" : "a map";
}

MapReader::MapReader(const YAML::Node& node, std::string key, const std::vector<std::string>& known,
                     const std::string& kind, Diagnostics& diagnostics)
    : key_(std::move(key)), diagnostics_(diagnostics) {
  if (!node.IsMap()) {
    diagnostics_.add(key_, fmt::format("must be a map of keys and values, found {}", shown(node)));
    return;
  }
  if (key_.empty() && isAnotherFile(node, known)) {
    std::vector<std::string> found;
    for (const auto& entry : node) {
      if (found.size() < kMaxKeysShown) {
        found.push_back(printable(entry.first.Scalar()));
      }
    }
    diagnostics_.add("", fmt::format("is another kind of file: has no {} ({}), found {}{}", kind,
                                     fmt::join(known, ", "), fmt::join(found, ", "),
                                     node.size() > found.size() ? ", ..." : ""));
    return;
  }
  usable_ = true;
  for (const auto& entry : node) {
    if (!entry.first.IsScalar()) {
      diagnostics_.add(key_, fmt::format("a key must be a name, found {}", shown(entry.first)));
      continue;
    }
    const std::string name = entry.first.Scalar();
    if (has(name)) {
      diagnostics_.add(this->key(name), "duplicate key");
      continue;
    }
    const std::string unknown = known.empty() ? "" : nameDiagnostic(name, known, kind);
    if (!unknown.empty()) {
      diagnostics_.add(this->key(name), unknown);
      continue;
    }
    place_.emplace(name, entries_.size());
    entries_.emplace_back(name, entry.second);
  }
}

bool MapReader::has(const std::string& name) const {
  return place_.find(name) != place_.end();
}

YAML::Node MapReader::at(const std::string& name) const {
  const auto found = place_.find(name);
  return found == place_.end() ? YAML::Node(YAML::NodeType::Undefined)
                               : entries_[found->second].second;
}

std::string MapReader::key(const std::string& name) const {
  return key_.empty() ? name : key_ + "." + name;
}

std::vector<std::string> MapReader::names() const {
  std::vector<std::string> all;
  for (const auto& entry : entries_) {
    all.push_back(entry.first);
  }
  return all;
}

double MapReader::checkedNumber(const std::string& name, const std::string& expected,
                                const std::string& unit, const std::function<bool(double)>& fits,
                                std::optional<double> fallback) const {
  if (!has(name)) {
    if (!fallback && usable_) {
      diagnostics_.add(key(name), fmt::format("missing; must be {}", expected));
    }
    return fallback.value_or(0.0);
  }
  const YAML::Node node = at(name);
  const std::optional<double> value =
      node.IsScalar() ? parseQuantity(node.Scalar(), unit) : std::optional<double>();
  if (!value || !fits(*value)) {
    diagnostics_.add(key(name), fmt::format("must be {}, found {}{}", expected, shown(node),
                                            unitDiagnostic(node, unit)));
    return fallback.value_or(0.0);
  }
  return *value;
}

double MapReader::number(const std::string& name, Range range, const std::string& unit,
                         std::optional<double> fallback) const {
  return checkedNumber(
      name, expected(range, unit), unit, [range](double x) { return inRange(range, x); }, fallback);
}

double MapReader::numberBetween(const std::string& name, double low, double high,
                                const std::string& unit, std::optional<double> fallback) const {
  return checkedNumber(
      name, fmt::format("from {:g} to {:g}{}", low, high, unit == "-" ? "" : " " + unit), unit,
      [=](double x) { return x >= low && x <= high; }, fallback);
}

int MapReader::integer(const std::string& name, int low, int high, int fallback) const {
  return static_cast<int>(checkedNumber(
      name, fmt::format("a whole number from {} to {}", low, high), "-",
      [=](double x) { return x >= low && x <= high && x == std::floor(x); }, fallback));
}

std::string MapReader::text(const std::string& name, const std::string& fallback) const {
  if (!has(name)) {
    return fallback;
  }
  const YAML::Node node = at(name);
  if (!node.IsScalar() || node.Scalar().empty()) {
    diagnostics_.add(key(name), fmt::format("must be a name, found {}", shown(node)));
    return fallback;
  }
  return node.Scalar();
}

std::string MapReader::choice(const std::string& name, const std::vector<std::string>& choices,
                              const std::string& what, const std::string& fallback) const {
  std::string value = text(name, fallback);
  if (!has(name) || !at(name).IsScalar() || at(name).Scalar().empty()) {
    return fallback;
  }
  if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
    const std::string near = nearestName(value, choices);
    diagnostics_.add(
        key(name),
        fmt::format("must be {}, found {}{}", what, shown(at(name)),
                    near.empty() ? fmt::format("; there are: {}", fmt::join(choices, ", "))
                                 : fmt::format("; did you mean '{}'?", near)));
    return fallback;
  }
  return value;
}

}  // namespace whirl_twin
