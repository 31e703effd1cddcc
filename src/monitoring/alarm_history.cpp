#include "monitoring/alarm_history.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>
#include <type_traits>
#include <utility>

#include "messages/checksum.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/wall_clock.h"
#include "twin/durable_file.h"

namespace whirl_twin {
namespace {

constexpr std::chrono::seconds kRetryPeriod{1};

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
  if (isOfWallClock(alert.stamp)) {
    line += fmt::format(R"(, "wall": "{}")", isoTime(alert.stamp));
  }
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

const std::string kChecksum = ", \"crc32c\": \"";  // before the last bytes of a line

std::string withChecksum(const std::string& line) {
  const std::string rest = line.substr(0, line.size() - 1);  // without the brace
  return fmt::format("{}{}{:08x}\"}}\n", rest, kChecksum, crc32c(rest.data(), rest.size()));
}

/// A line of an earlier version has none.
bool hasWrongChecksum(const std::string& line) {
  const std::size_t end = line.rfind(kChecksum);
  return end != std::string::npos && withChecksum(line.substr(0, end) + "}") != line + "\n";
}

void take(const state::Alert& alert, AlarmMemory& memory) {
  auto& alerts = memory.alerts;
  const auto known = std::find_if(alerts.begin(), alerts.end(),
                                  [&](const state::Alert& other) { return other.id == alert.id; });
  if (known != alerts.end()) {
    alerts.erase(known);
  }
  if (alert.raised) {
    alerts.push_back(alert);
  }
  memory.last_id = std::max(memory.last_id, alert.id);
  memory.counts[{alert.system, alert.type}] = alert.repeats + 1;
}

void takeReset(AlarmMemory& memory) {
  memory.counts.clear();
  for (const state::Alert& alert : memory.alerts) {
    memory.counts[{alert.system, alert.type}] = 1;
  }
}

/// False: it cannot be read.
bool takeLine(const std::string& line, AlarmMemory& memory) {
  if (hasWrongChecksum(line)) {
    return false;
  }
  try {
    const YAML::Node node = YAML::Load(line);
    const auto event = node["event"].as<std::string>();
    if (event == "alert") {
      take(alertOf(node), memory);
    } else if (event == "reset") {
      takeReset(memory);
    } else if (event == "run") {
      memory.run = TwinRun{node["started"].as<std::int64_t>(), node["epoch"].as<std::uint64_t>()};
    } else if (event == "raised") {
      memory.counts[{node["system"].as<std::string>(), node["type"].as<std::string>()}] =
          node["count"].as<std::uint32_t>();
    } else if (event == "id") {
      memory.last_id = std::max(memory.last_id, node["id"].as<std::uint32_t>());
    }
    return true;
  } catch (const YAML::Exception&) {
    return false;
  }
}

struct ReadFile {
  AlarmMemory memory;
  std::size_t unreadable = 0;
  bool complete = true;  // the last line
};

ReadFile readLines(const std::string& path) {
  ReadFile read;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    read.complete = !file.eof();
    read.unreadable += line.empty() || takeLine(line, read.memory) ? 0 : 1;
  }
  return read;
}

const std::string kResetLine = withChecksum(R"({"event": "reset"})");

std::string runLine(const TwinRun& run) {
  return withChecksum(
      fmt::format(R"({{"event": "run", "started": {}, "epoch": {}}})", run.first, run.second));
}

}  // namespace

AlarmHistory::AlarmHistory(const std::string& path, std::size_t largest)
    : path_(path), largest_(largest) {
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  ReadFile read = readLines(path);
  memory_ = std::move(read.memory);
  unreadable_ = read.unreadable;
  if (open() && std::filesystem::file_size(path_, ignored) > largest_) {
    beginNewFile();
  }
}

AlarmHistory::~AlarmHistory() {
  close();
}

void AlarmHistory::close() {
  if (file_ >= 0) {
    ::close(file_);
  }
  file_ = -1;
}

bool AlarmHistory::isThere() const {
  struct stat own {};
  struct stat there {};
  return file_ >= 0 && ::fstat(file_, &own) == 0 && ::stat(path_.c_str(), &there) == 0 &&
         own.st_ino == there.st_ino && own.st_dev == there.st_dev;
}

bool AlarmHistory::fail(int error) {
  problem_ = fmt::format(
      "{}: {}: the alarm history is not saved; active alerts are written once it can be", path_,
      error == 0 ? "cannot be written" : std::strerror(error));
  next_try_ = std::chrono::steady_clock::now() + kRetryPeriod;
  return false;
}

bool AlarmHistory::open() {
  if (isThere()) {
    return true;
  }
  close();
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), ignored);
  file_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) {
    return fail(errno);
  }
  const ReadFile read = readLines(path_);
  stored_.clear();
  for (const state::Alert& alert : read.memory.alerts) {
    stored_[alert.id] = alert;
  }
  return read.complete || append("\n");
}

/// All of it, or nothing.
bool AlarmHistory::append(const std::string& text) {
  struct stat before {};
  if (::fstat(file_, &before) != 0) {
    return fail(errno);
  }
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::write(file_, text.data() + at, text.size() - at);
    if (written <= 0 && errno != EINTR) {
      fail(errno);
      static_cast<void>(::ftruncate(file_, before.st_size) == 0);  // else a torn line is left out
      return false;
    }
    at += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  return true;
}

std::string AlarmHistory::lacking() const {
  std::string text = lacks_reset_ ? kResetLine : "";
  for (auto [id, alert] : stored_) {
    const bool active =
        std::any_of(memory_.alerts.begin(), memory_.alerts.end(),
                    [id = id](const state::Alert& other) { return other.id == id; });
    if (!active) {
      alert.raised = false;
      text += withChecksum(lineOf(alert));
    }
  }
  text += withChecksum(fmt::format(R"({{"event": "id", "id": {}}})", memory_.last_id));
  if (memory_.run) {
    text += runLine(*memory_.run);
  }
  for (const state::Alert& alert : memory_.alerts) {
    text += withChecksum(lineOf(alert));
  }
  for (const auto& [kind, count] : memory_.counts) {
    text +=
        withChecksum(fmt::format(R"({{"event": "raised", "system": {}, "type": {}, "count": {}}})",
                                 quotedJson(kind.first), quotedJson(kind.second), count));
  }
  return text + lacks_settings_;
}

void AlarmHistory::retry() {
  const bool due = std::chrono::steady_clock::now() >= next_try_;
  if (!due || (problem_.empty() && isThere()) || !open() || !append(lacking())) {
    return;
  }
  problem_.clear();
  stored_.clear();
  for (const state::Alert& alert : memory_.alerts) {
    stored_[alert.id] = alert;
  }
  lacks_reset_ = false;
  lacks_settings_.clear();
}

void AlarmHistory::beginNewFile() {
  stored_.clear();
  try {
    DurableFile next(path_);
    next.add(lacking());
    const std::string old = path_ + ".old";
    ::unlink(old.c_str());
    if (::link(path_.c_str(), old.c_str()) != 0) {
      fail(errno);
      return;
    }
    next.finish();
    open();
  } catch (const RunFailure&) {
    fail(errno);
  }
}

void AlarmHistory::write(const state::Alert& event) {
  take(event, memory_);
  writeLine(withChecksum(lineOf(event)));
  if (problem_.empty() && event.raised) {
    stored_[event.id] = event;
  } else if (problem_.empty()) {
    stored_.erase(event.id);
  }
}

void AlarmHistory::writeReset() {
  takeReset(memory_);
  lacks_reset_ = true;
  writeLine(kResetLine);
  lacks_reset_ = !problem_.empty();
}

void AlarmHistory::writeRun(const TwinRun& run) {
  memory_.run = run;
  writeLine(runLine(run));
}

void AlarmHistory::writeSettings(const std::string& text) {
  const std::string line =
      withChecksum(fmt::format(R"({{"event": "settings", "text": {}}})", quotedJson(text)));
  lacks_settings_ = line;
  writeLine(line);
  if (problem_.empty()) {
    lacks_settings_.clear();
  }
}

/// What cannot be written is in memory_, or lacking.
void AlarmHistory::writeLine(const std::string& line) {
  if (!problem_.empty() || !isThere()) {
    retry();
    return;
  }
  struct stat now {};
  if (append(line) && ::fstat(file_, &now) == 0 &&
      static_cast<std::size_t>(now.st_size) > largest_ + line.size()) {
    beginNewFile();
  }
}

}  // namespace whirl_twin
