// Reads values from a YAML tree and collects all diagnostics instead of stopping at the first.
#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mechanics/model_description.h"

namespace whirl_twin {

/// A finite number written in decimal, or nothing.
std::optional<double> parseNumber(const std::string& text);

/// The same with or without a unit: "250 mm" in m is 0.25. Nothing also for an unknown unit or one
/// of another quantity (messages/units.h).
std::optional<double> parseQuantity(const std::string& text, const std::string& unit);

/// ": 'mm' is no unit of rad/s", ": there is no unit 'rmp'" for a number with such a unit; else "".
std::string unitDiagnostic(const YAML::Node& node, const std::string& unit);

/// Collector of diagnostics: "source: key: text".
class Diagnostics {
 public:
  explicit Diagnostics(std::string source) : source_(std::move(source)) {}
  void add(const std::string& key, const std::string& text);
  const std::vector<std::string>& all() const { return all_; }

 private:
  std::string source_;
  std::vector<std::string> all_;
};

/// A map of the tree, under a full key such as systems.rotor.parameters.
class MapReader {
 public:
  /// Adds a diagnostic if the node is not a map, a key is a duplicate, or a key is not in `known`;
  /// `kind` is the word for an unknown key: "unknown KIND; did you mean ...?". Empty `known`: any
  /// key.
  MapReader(const YAML::Node& node, std::string key, const std::vector<std::string>& known,
            const std::string& kind, Diagnostics& diagnostics);

  bool usable() const { return usable_; }
  bool has(const std::string& name) const;
  YAML::Node at(const std::string& name) const;
  std::string key(const std::string& name) const;
  std::vector<std::string> names() const;

  /// A number in range, written in this unit or a convertible one; without a fallback it is
  /// required. After a diagnostic the fallback, or 0, is returned.
  double number(const std::string& name, Range range, const std::string& unit,
                std::optional<double> fallback) const;
  double numberBetween(const std::string& name, double low, double high, const std::string& unit,
                       std::optional<double> fallback) const;
  int integer(const std::string& name, int low, int high, int fallback) const;
  std::string text(const std::string& name, const std::string& fallback) const;
  /// One of `choices`, or a diagnostic with the nearest of them.
  std::string choice(const std::string& name, const std::vector<std::string>& choices,
                     const std::string& what, const std::string& fallback) const;

 private:
  double checkedNumber(const std::string& name, const std::string& expected,
                       const std::string& unit, const std::function<bool(double)>& fits,
                       std::optional<double> fallback) const;

  std::vector<std::pair<std::string, YAML::Node>> entries_;  ///< in the order of the file
  std::unordered_map<std::string, std::size_t> place_;       ///< index of each name in entries_
  std::string key_;
  bool usable_ = false;
  Diagnostics& diagnostics_;
};

/// Description of a node for a message: its text, "a list", "a map" or "nothing".
std::string shown(const YAML::Node& node);

}  // namespace whirl_twin
