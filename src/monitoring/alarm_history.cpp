#include "monitoring/alarm_history.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>
#include <type_traits>

#include "messages/names.h"

namespace whirl_twin {
namespace {

/// A text of a message in JSON; control characters are not among its characters.
std::string quotedJson(const std::string& text) {
  std::string json = "\"";
  for (const char c : printable(text, std::numeric_limits<std::size_t>::max())) {
    if (c == '"' || c == '\\') {
      json += '\\';
    }
    json += c;
  }
  return json + '"';
}

/// The name of a field: what messages have as a state is a flag here.
std::string fieldName(const char* field) {
  return std::strcmp(field, "state") == 0 ? "raised" : field;
}

std::string lineOf(const state::Alert& alert) {
  std::string line = R"({"event": "alert")";
  eachMember(alert, [&line](const char* field, const auto& value, Stays) {
    using Value = std::decay_t<decltype(value)>;
    std::string text;
    if constexpr (std::is_same_v<Value, std::string>) {
      text = quotedJson(value);
    } else if constexpr (std::is_enum_v<Value>) {
      text = fmt::format("{}", static_cast<int>(value));
    } else if constexpr (std::is_same_v<Value, double>) {
      text = std::isfinite(value) ? fmt::format("{}", value) : "";
    } else {
      text = fmt::format("{}", value);
    }
    if (!text.empty()) {
      line += fmt::format(", \"{}\": {}", fieldName(field), text);
    }
  });
  return line + "}";
}

state::Alert alertOf(const YAML::Node& line) {
  state::Alert alert;
  eachMember(alert, [&line](const char* field, auto& value, Stays) {
    using Value = std::decay_t<decltype(value)>;
    const YAML::Node given = line[fieldName(field)];
    if constexpr (std::is_same_v<Value, double>) {
      value = given ? given.as<double>() : state::Alert::kNone;
    } else if constexpr (std::is_enum_v<Value>) {
      value = static_cast<Value>(std::clamp(given.as<int>(), 0, 2));
    } else {
      value = given.as<Value>();
    }
  });
  return alert;
}

std::string why(int error) {
  return error == 0 ? "cannot be written" : std::strerror(error);
}

}  // namespace

AlarmHistory::AlarmHistory(const std::string& path, std::size_t largest) : path_(path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  fs::create_directories(fs::path(path).parent_path(), ignored);
  bool complete = true;  // the last line
  std::size_t size = 0;
  {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
      complete = !file.eof();
      size += line.size() + 1;
      read(line);
    }
  }
  const bool anew = size > largest;
  if (anew) {
    fs::rename(path, path + ".old", ignored);
  }
  errno = 0;
  file_.open(path, std::ios::app);
  if (!file_) {
    problem_ = fmt::format("{}: {}: no history of the alarms is kept", path, why(errno));
    return;
  }
  if (anew) {
    writeLine(fmt::format(R"({{"event": "id", "id": {}}})", memory_.last_id));
    for (const auto& [kind, count] : memory_.counts) {
      writeLine(fmt::format(R"({{"event": "raised", "system": {}, "type": {}, "count": {}}})",
                            quotedJson(kind.first), quotedJson(kind.second), count));
    }
    if (memory_.run) {
      writeRun(*memory_.run);
    }
    for (const state::Alert& alert : memory_.alerts) {
      write(alert);
    }
  } else if (!complete) {
    writeLine("");
  }
}

void AlarmHistory::read(const std::string& line) {
  if (line.empty()) {
    return;
  }
  try {
    const YAML::Node node = YAML::Load(line);
    const auto event = node["event"].as<std::string>();
    if (event == "alert") {
      const state::Alert alert = alertOf(node);
      auto& alerts = memory_.alerts;
      const auto known = std::find_if(alerts.begin(), alerts.end(), [&](const state::Alert& other) {
        return other.id == alert.id;
      });
      if (known != alerts.end()) {
        alerts.erase(known);
      }
      if (alert.raised) {
        alerts.push_back(alert);
      }
      memory_.last_id = std::max(memory_.last_id, alert.id);
      memory_.counts[{alert.system, alert.type}] = alert.repeats + 1;
    } else if (event == "reset") {
      memory_.counts.clear();
      for (const state::Alert& alert : memory_.alerts) {
        memory_.counts[{alert.system, alert.type}] = 1;
      }
    } else if (event == "run") {
      memory_.run = TwinRun{node["started"].as<std::int64_t>(), node["epoch"].as<std::uint64_t>()};
    } else if (event == "raised") {
      memory_.counts[{node["system"].as<std::string>(), node["type"].as<std::string>()}] =
          node["count"].as<std::uint32_t>();
    } else if (event == "id") {
      memory_.last_id = std::max(memory_.last_id, node["id"].as<std::uint32_t>());
    }
  } catch (const YAML::Exception&) {
    ++unreadable_;
  }
}

void AlarmHistory::write(const state::Alert& event) {
  writeLine(lineOf(event));
}

void AlarmHistory::writeReset() {
  writeLine(R"({"event": "reset"})");
}

void AlarmHistory::writeRun(const TwinRun& run) {
  writeLine(
      fmt::format(R"({{"event": "run", "started": {}, "epoch": {}}})", run.first, run.second));
}

void AlarmHistory::writeSettings(const std::string& text) {
  writeLine(fmt::format(R"({{"event": "settings", "text": {}}})", quotedJson(text)));
}

void AlarmHistory::writeLine(const std::string& line) {
  if (!problem_.empty()) {
    return;
  }
  errno = 0;
  file_ << line << '\n' << std::flush;
  if (!file_) {
    problem_ = fmt::format("{}: {}: the history of the alarms ends here", path_, why(errno));
  }
}

}  // namespace whirl_twin
