#include "scene/input_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "messages/refusal.h"
#include "scene/csv_columns.h"

namespace whirl_twin {

namespace {

constexpr double kLargestTime = 1.0e9;  // s, of an instant

constexpr const char* kForms =
    "must be a number ({0}), {{amplitude, frequency, phase}} or {{table, time, value, hold}}, "
    "found {1}";

InputSignal readHarmonic(const MapReader& map, const std::string& unit) {
  const double amplitude = map.number("amplitude", Range::kAny, unit, std::nullopt);
  const double frequency =
      map.numberBetween("frequency", -kLargestFrequency, kLargestFrequency, "rad/s", std::nullopt);
  const double phase = map.numberBetween("phase", -kLargestPhase, kLargestPhase, "rad", 0.0);
  return InputSignal::harmonic(amplitude, frequency, phase);
}

InputSignal readTable(const MapReader& map, const std::string& folder, Complaints& complaints) {
  const std::string name = map.text("table", "");
  const std::string time = map.text("time", "time");
  const std::string value = map.text("value", "value");
  const bool hold = map.choice("hold", {"false", "true"}, "true or false", "false") == "true";
  std::filesystem::path path(name);
  if (path.is_relative()) {
    if (folder.empty()) {
      complaints.add(map.key("table"), fmt::format("must be an absolute path, for this scene is in "
                                                   "no folder, found '{}'",
                                                   name));
      return {};
    }
    path = std::filesystem::path(folder) / path;
  }
  try {
    const std::vector<std::vector<double>> columns = csvColumns(path.string(), {time, value});
    std::vector<std::int64_t> instants;
    for (std::size_t row = 0; row < columns[0].size(); ++row) {
      const double seconds = columns[0][row];
      if (!(std::fabs(seconds) <= kLargestTime)) {
        throw Refusal(
            fmt::format("row {}: {} must lie within +-1e9 s, found {} s", row + 1, time, seconds));
      }
      instants.push_back(std::llround(seconds * 1e9));
    }
    InputSignal signal = InputSignal::table(std::move(instants), columns[1], hold);
    const SignalFault fault = faultOf(signal);
    if (fault.expected != nullptr) {
      throw Refusal(fmt::format("row {}: {} {}, by a nanosecond or more, found {} s", fault.row + 1,
                                time, fault.expected, columns[0][fault.row]));
    }
    return signal;
  } catch (const Refusal& error) {
    complaints.add(map.key("table"), fmt::format("{}: {}", path.string(), error.what()));
    return {};
  }
}

InputSignal readSignal(const MapReader& inputs, const InputInfo& info, const std::string& folder,
                       Complaints& complaints) {
  const YAML::Node node = inputs.at(info.name);
  const std::string key = inputs.key(info.name);
  if (node.IsScalar()) {
    return InputSignal::constant(inputs.number(info.name, Range::kAny, info.unit, std::nullopt));
  }
  if (!node.IsMap()) {
    complaints.add(key, fmt::format(kForms, info.unit, shown(node)));
    return {};
  }
  if (node["table"].IsDefined()) {
    const MapReader map(node, key, {"table", "time", "value", "hold"}, "key of a table",
                        complaints);
    return readTable(map, folder, complaints);
  }
  const MapReader map(node, key, {"amplitude", "frequency", "phase"}, "key of a harmonic",
                      complaints);
  return readHarmonic(map, info.unit);
}

}  // namespace

std::map<std::string, InputSignal> readInputs(const MapReader& system,
                                              const std::vector<InputInfo>& inputs,
                                              const std::string& folder, Complaints& complaints) {
  std::map<std::string, InputSignal> signals;
  if (!system.has("inputs")) {
    return signals;
  }
  if (inputs.empty()) {
    complaints.add(system.key("inputs"), "this model has no inputs");
    return signals;
  }
  std::vector<std::string> known;
  for (const InputInfo& input : inputs) {
    known.push_back(input.name);
  }
  const MapReader map(system.at("inputs"), system.key("inputs"), known, "input of this model",
                      complaints);
  for (const InputInfo& input : inputs) {
    if (map.usable() && map.has(input.name)) {
      signals.emplace(input.name, readSignal(map, input, folder, complaints));
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
