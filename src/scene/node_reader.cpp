#include "scene/node_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scene/model_info.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kLongestShown = 60;

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

/// Control characters and endless names must not reach a terminal.
std::string printable(const std::string& text) {
  std::string clean;
  for (const char c : text.substr(0, kLongestShown)) {
    clean += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return text.size() > kLongestShown ? clean + "..." : clean;
}

}  // namespace

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  std::string nearest;
  if (name.size() > kLongestShown) {
    return nearest;
  }
  std::size_t best = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::optional<double> parseNumber(const std::string& text) {
  const char* first = text.data();
  const char* last = first + text.size();
  if (first != last && *first == '+' && last - first > 1 && first[1] != '-') {
    ++first;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (end != last || !std::isfinite(value)) {
    return std::nullopt;
  }
  return error == std::errc() ? std::optional<double>(value) : std::nullopt;
}

void Complaints::add(const std::string& key, const std::string& text) {
  all_.push_back(key.empty() ? fmt::format("{}: {}", source_, text)
                             : fmt::format("{}: {}: {}", source_, printable(key), text));
}

std::string shown(const YAML::Node& node) {
  if (!node.IsDefined() || node.IsNull()) {
    return "nothing";
  }
  if (node.IsScalar()) {
    const std::string& text = node.Scalar();
    return parseNumber(text) ? text : fmt::format("'{}'", printable(text));
  }
  return node.IsSequence() ? "a list" : "a map";
}

MapReader::MapReader(const YAML::Node& node, std::string key, const std::vector<std::string>& known,
                     const std::string& kind, Complaints& complaints)
    : key_(std::move(key)), complaints_(complaints) {
  if (!node.IsMap()) {
    complaints_.add(key_, fmt::format("must be a map of keys and values, found {}", shown(node)));
    return;
  }
  usable_ = true;
  for (const auto& entry : node) {
    if (!entry.first.IsScalar()) {
      complaints_.add(key_, fmt::format("a key must be a name, found {}", shown(entry.first)));
      continue;
    }
    const std::string name = entry.first.Scalar();
    if (has(name)) {
      complaints_.add(this->key(name), "stands twice");
      continue;
    }
    if (!known.empty() && std::find(known.begin(), known.end(), name) == known.end()) {
      const std::string near = nearestName(name, known);
      complaints_.add(this->key(name),
                      fmt::format("unknown {}{}", kind,
                                  near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
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
                                const std::function<bool(double)>& fits,
                                std::optional<double> fallback) const {
  if (!has(name)) {
    if (!fallback && usable_) {
      complaints_.add(key(name), fmt::format("missing; must be {}", expected));
    }
    return fallback.value_or(0.0);
  }
  const YAML::Node node = at(name);
  const std::optional<double> value =
      node.IsScalar() ? parseNumber(node.Scalar()) : std::optional<double>();
  if (!value || !fits(*value)) {
    complaints_.add(key(name), fmt::format("must be {}, found {}", expected, shown(node)));
    return fallback.value_or(0.0);
  }
  return *value;
}

double MapReader::number(const std::string& name, Range range, const std::string& unit,
                         std::optional<double> fallback) const {
  const std::string with_unit = unit == "-" ? "" : " " + unit;
  const std::string expected =
      range == Range::kAny ? fmt::format("a finite number{}", unit == "-" ? "" : " in " + unit)
                           : describe(range) + with_unit;
  return checkedNumber(
      name, expected,
      [range](double x) {
        switch (range) {
          case Range::kPositive:
            return x > 0.0;
          case Range::kNotNegative:
            return x >= 0.0;
          case Range::kCount:
            return x >= 1.0 && x <= 1.0e6 && x == std::floor(x);
          case Range::kAny:
            break;
        }
        return true;
      },
      fallback);
}

double MapReader::numberBetween(const std::string& name, double low, double high,
                                const std::string& unit, std::optional<double> fallback) const {
  return checkedNumber(
      name, fmt::format("from {:g} to {:g}{}", low, high, unit == "-" ? "" : " " + unit),
      [=](double x) { return x >= low && x <= high; }, fallback);
}

int MapReader::integer(const std::string& name, int low, int high, int fallback) const {
  return static_cast<int>(checkedNumber(
      name, fmt::format("a whole number from {} to {}", low, high),
      [=](double x) { return x >= low && x <= high && x == std::floor(x); }, fallback));
}

std::string MapReader::text(const std::string& name, const std::string& fallback) const {
  if (!has(name)) {
    return fallback;
  }
  const YAML::Node node = at(name);
  if (!node.IsScalar() || node.Scalar().empty()) {
    complaints_.add(key(name), fmt::format("must be a name, found {}", shown(node)));
    return fallback;
  }
  return node.Scalar();
}

std::string MapReader::choice(const std::string& name, const std::vector<std::string>& choices,
                              const std::string& what, const std::string& fallback) const {
  const std::string value = text(name, fallback);
  if (!has(name) || !at(name).IsScalar() || at(name).Scalar().empty()) {
    return fallback;
  }
  if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
    const std::string near = nearestName(value, choices);
    complaints_.add(
        key(name),
        fmt::format("must be {}, found {}{}", what, shown(at(name)),
                    near.empty() ? fmt::format("; there are: {}", fmt::join(choices, ", "))
                                 : fmt::format("; did you mean '{}'?", near)));
    return fallback;
  }
  return value;
}

}  // namespace whirl_twin
