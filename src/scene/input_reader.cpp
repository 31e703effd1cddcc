#include "scene/input_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "control/input_shaper.h"
#include "messages/input_error.h"
#include "scene/table_reader.h"

namespace whirl_twin {

namespace {

constexpr double kSlowestShaped = 1.0e-6;    // rad/s, lowest frequency of a shaped mode
constexpr double kMaxShapedDamping = 0.999;  // largest damping ratio of a shaped mode

constexpr const char* kForms =
    "must be a number ({0}), {{amplitude, frequency, phase}}, {{times, values, hold}} or {{table, "
    "time, value, hold}}, found {1}";

InputSignal readHarmonic(const MapReader& map, const std::string& unit) {
  const double amplitude = map.number("amplitude", Range::kAny, unit, std::nullopt);
  const double frequency =
      map.numberBetween("frequency", -kLargestFrequency, kLargestFrequency, "rad/s", std::nullopt);
  const double phase = map.numberBetween("phase", -kMaxPhase, kMaxPhase, "rad", 0.0);
  return InputSignal::harmonic(amplitude, frequency, phase);
}

/// Times in s; `name` is their name. Throws InputError with the row.
InputSignal tableOf(const std::vector<double>& times, const std::vector<double>& values, bool hold,
                    const std::string& name) {
  std::vector<std::int64_t> instants;
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (!(std::fabs(times[row]) <= kMaxInstant)) {
      throw InputError(
          fmt::format("row {}: {} must be within +-1e9 s, found {} s", row + 1, name, times[row]));
    }
    instants.push_back(std::llround(times[row] * 1e9));
  }
  InputSignal signal = InputSignal::table(std::move(instants), values, hold);
  const SignalFault fault = faultOf(signal);
  if (fault.expected != nullptr) {
    throw InputError(fmt::format("row {}: {} {} by at least 1 ns, found {} s", fault.row + 1, name,
                                 fault.expected, times[fault.row]));
  }
  return signal;
}

InputSignal readFile(const MapReader& map, const std::string& unit, const std::string& folder,
                     bool hold, Diagnostics& diagnostics) {
  const std::string name = map.text("table", "");
  const std::string time = map.text("time", "time");
  const std::string value = map.text("value", "value");
  std::filesystem::path path(name);
  if (path.is_relative()) {
    if (folder.empty()) {
      diagnostics.add(
          map.key("table"),
          fmt::format("must be an absolute path (the scene was not read from a file), found '{}'",
                      name));
      return {};
    }
    path = std::filesystem::path(folder) / path;
  }
  try {
    const std::vector<std::vector<double>> columns =
        tableColumns(path.string(), {{time, "s"}, {value, unit}});
    return tableOf(columns[0], columns[1], hold, time);
  } catch (const InputError& error) {
    diagnostics.add(map.key("table"), fmt::format("{}: {}", path.string(), error.what()));
    return {};
  }
}

/// Empty after a diagnostic.
std::vector<double> readNumbers(const MapReader& map, const std::string& name,
                                const std::string& unit, Diagnostics& diagnostics) {
  const YAML::Node list = map.has(name) ? map.at(name) : YAML::Node();
  if (!list.IsSequence() || list.size() == 0) {
    diagnostics.add(map.key(name), fmt::format("must be a list of numbers in {}, found {}", unit,
                                               list.IsSequence() ? "an empty one" : shown(list)));
    return {};
  }
  std::vector<double> numbers;
  bool sound = true;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::optional<double> number =
        list[i].IsScalar() ? parseQuantity(list[i].Scalar(), unit) : std::nullopt;
    if (!number) {
      diagnostics.add(fmt::format("{}[{}]", map.key(name), i),
                      fmt::format("must be a finite number in {}, found {}{}", unit, shown(list[i]),
                                  unitDiagnostic(list[i], unit)));
      sound = false;
    }
    numbers.push_back(number.value_or(0.0));
  }
  return sound ? numbers : std::vector<double>{};
}

InputSignal readLists(const MapReader& map, const std::string& unit, bool hold,
                      Diagnostics& diagnostics) {
  const std::vector<double> times = readNumbers(map, "times", "s", diagnostics);
  const std::vector<double> values = readNumbers(map, "values", unit, diagnostics);
  if (times.empty() || values.empty()) {
    return {};
  }
  if (times.size() != values.size()) {
    diagnostics.add(map.key("values"),
                    fmt::format("must have as many entries as times, {}, found {}", times.size(),
                                values.size()));
    return {};
  }
  try {
    return tableOf(times, values, hold, "the time");
  } catch (const InputError& error) {
    diagnostics.add(map.key("times"), error.what());
    return {};
  }
}

/// The signal filtered by its `shaper`.
InputSignal readShaped(const MapReader& table, const InputSignal& signal,
                       Diagnostics& diagnostics) {
  const MapReader map(table.at("shaper"), table.key("shaper"),
                      {"type", "frequency", "damping_ratio"}, "key of a shaper", diagnostics);
  if (!map.usable()) {
    return signal;
  }
  const std::string type = map.choice("type", {"zv", "zvd"}, "a shaper", "zv");
  const double frequency =
      map.numberBetween("frequency", kSlowestShaped, kLargestFrequency, "rad/s", std::nullopt);
  const double damping = map.numberBetween("damping_ratio", 0.0, kMaxShapedDamping, "-", 0.0);
  if (signal.kind != InputSignal::Kind::kTable || !(frequency > 0.0)) {
    return signal;
  }
  return shaped(signal, type == "zvd" ? zeroVibrationDerivative(frequency, damping)
                                      : zeroVibration(frequency, damping));
}

InputSignal readSignalTable(const YAML::Node& node, const std::string& key, const std::string& unit,
                            const std::string& folder, Diagnostics& diagnostics) {
  const bool file = node["table"].IsDefined();
  const MapReader map(node, key,
                      file ? std::vector<std::string>{"table", "time", "value", "hold", "shaper"}
                           : std::vector<std::string>{"times", "values", "hold", "shaper"},
                      "key of a table", diagnostics);
  const bool hold = map.choice("hold", {"false", "true"}, "true or false", "false") == "true";
  const InputSignal signal = file ? readFile(map, unit, folder, hold, diagnostics)
                                  : readLists(map, unit, hold, diagnostics);
  return map.has("shaper") ? readShaped(map, signal, diagnostics) : signal;
}

InputSignal readSignal(const MapReader& inputs, const InputInfo& info, const std::string& folder,
                       Diagnostics& diagnostics) {
  const YAML::Node node = inputs.at(info.name);
  const std::string key = inputs.key(info.name);
  if (node.IsScalar()) {
    return InputSignal::constant(inputs.number(info.name, Range::kAny, info.unit, std::nullopt));
  }
  if (!node.IsMap()) {
    diagnostics.add(key, fmt::format(kForms, info.unit, shown(node)));
    return {};
  }
  if (node["table"].IsDefined() || node["times"].IsDefined() || node["values"].IsDefined()) {
    return readSignalTable(node, key, info.unit, folder, diagnostics);
  }
  const MapReader map(node, key, {"amplitude", "frequency", "phase"}, "key of a harmonic",
                      diagnostics);
  return readHarmonic(map, info.unit);
}

}  // namespace

std::map<std::string, InputSignal> readInputs(const MapReader& system,
                                              const std::vector<InputInfo>& inputs,
                                              const std::string& folder, Diagnostics& diagnostics) {
  std::map<std::string, InputSignal> signals;
  if (!system.has("inputs")) {
    return signals;
  }
  if (inputs.empty()) {
    diagnostics.add(system.key("inputs"), "this model has no inputs");
    return signals;
  }
  std::vector<std::string> known;
  for (const InputInfo& input : inputs) {
    known.push_back(input.name);
  }
  const MapReader map(system.at("inputs"), system.key("inputs"), known, "input of this model",
                      diagnostics);
  for (const InputInfo& input : inputs) {
    if (map.usable() && map.has(input.name)) {
      signals.emplace(input.name, readSignal(map, input, folder, diagnostics));
    }
  }
  return signals;
}

std::vector<InputSignal> signalsOf(const std::vector<InputInfo>& inputs,
                                   const std::map<std::string, InputSignal>& given) {
  std::vector<InputSignal> signals;
  std::size_t found = 0;
  for (const InputInfo& input : inputs) {
    const auto signal = given.find(input.name);
    found += signal != given.end() ? 1 : 0;
    signals.push_back(signal != given.end() ? signal->second : InputSignal{});
  }
  if (found != given.size()) {
    throw std::logic_error("an input is given that the model does not have");
  }
  return signals;
}

}  // namespace whirl_twin
