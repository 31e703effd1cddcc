#include "reports/live_lines.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "messages/names.h"
#include "reports/output.h"

namespace whirl_twin {

namespace {

struct Room {
  std::size_t columns = 80;
  std::size_t rows = 24;
};

Room room() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
    return {};
  }
  return {size.ws_col, size.ws_row};
}

/// A character that is no ASCII takes more than a byte and at least a column: never too wide.
std::string cutToColumns(const std::string& line, std::size_t columns) {
  std::string out;
  for (std::size_t at = 0, column = 0; at < line.size() && column < columns; ++column) {
    const std::size_t length = std::max<std::size_t>(1, printableLength(line, at));
    out += line.substr(at, length);
    at += length;
  }
  return out;
}

std::string valueText(const std::string& value) {
  return "'" + value + "'";
}
template <class Value>
std::string valueText(const Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_floating_point_v<Value>) {
    return fmt::format("{:.6g}", value);
  } else if constexpr (std::is_integral_v<Value> || std::is_enum_v<Value>) {
    return fmt::format("{}", static_cast<std::int64_t>(value));
  } else {
    std::string all;
    for (const auto& entry : value) {
      all += (all.empty() ? "" : " ") + valueText(entry);
    }
    return "[" + all + "]";
  }
}

template <class State>
class TextVisit : public FieldVisit<TextVisit<State>> {
 public:
  TextVisit(const State& state, std::string& text) : state_(state), text_(text) {}

  void head() {}
  template <class F>
  void head(F) {}
  template <class F>
  void sampled(F) {}
  template <class F, class Check>
  void value(F field, const char* unit, Check, Stays) {
    const std::string said = unit;
    text_ +=
        fmt::format("{}{} {}{}", text_.empty() ? "" : ", ", field.name, valueText(field.of(state_)),
                    said.empty() || said == "-" ? "" : " " + said);
  }
  template <class F>
  void negated(F field) {
    text_ += fmt::format("{}{} {}", text_.empty() ? "" : ", ", field.name, !field.of(state_));
  }
  template <class L, class F>
  void rows(L, F field) {
    for (const auto& row : field.of(state_)) {
      TextVisit<std::decay_t<decltype(row)>> visit(row, text_);
      std::decay_t<decltype(row)>::fields(visit);
    }
  }

 private:
  const State& state_;
  std::string& text_;
};

template <class State>
class JsonVisit : public FieldVisit<JsonVisit<State>> {
 public:
  JsonVisit(const State& state, Json& json) : state_(state), json_(json) {}

  void head() {
    json_["step"] = state_.at.step;
    json_["time"] = state_.at.time;
    json_["stamp"] = state_.at.stamp;
  }
  template <class F>
  void head(F field) {
    head();
    json_[field.name] = field.of(state_);
  }
  template <class F>
  void sampled(F field) {
    json_["sample"] = state_.at.step;
    json_["time"] = state_.at.time;
    json_[field.name] = field.of(state_);
  }
  void stamped() { json_["stamp"] = state_.stamp; }
  template <class F, class Check>
  void value(F field, const char*, Check, Stays) {
    json_[field.name] = field.of(state_);
  }
  template <class F>
  void negated(F field) {
    json_[field.name] = !field.of(state_);
  }
  template <class L, class F>
  void rows(L, F field) {
    Json& rows = json_[field.name] = Json::array();
    for (const auto& row : field.of(state_)) {
      Json one = Json::object();
      JsonVisit<std::decay_t<decltype(row)>> visit(row, one);
      std::decay_t<decltype(row)>::fields(visit);
      rows.push_back(one);
    }
  }

 private:
  const State& state_;
  Json& json_;
};

}  // namespace

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

LiveLines::LiveLines() : on_terminal_(::isatty(STDOUT_FILENO) == 1) {}

void LiveLines::show(const std::vector<std::string>& lines) {
  erase();
  std::string text;
  if (!on_terminal_) {
    for (const std::string& line : lines) {
      text += line + "\n";
    }
    return print(text);
  }
  const Room there = room();
  const std::size_t most = std::max<std::size_t>(2, there.rows) - 1;  // the cursor has the last row
  const bool all = lines.size() <= most;
  for (std::size_t i = 0; i < (all ? lines.size() : most - 1); ++i) {
    text += cutToColumns(lines[i], there.columns) + "\n";
  }
  if (!all) {
    text += cutToColumns(fmt::format("... and {} more", lines.size() - (most - 1)), there.columns) +
            "\n";
  }
  print(text);
  shown_ = std::min(lines.size(), most);
}

void LiveLines::keep(const std::string& line) {
  erase();
  print(line + "\n");
}

/// Up, to the first column, and nothing left below.
void LiveLines::erase() {
  if (shown_ > 0) {
    std::fputs(fmt::format("\x1b[{}A\r\x1b[J", shown_).c_str(), stdout);
  }
  shown_ = 0;
}

void LiveLines::print(const std::string& text) {
  printText(text);
  finishStandardOutput();
}

std::string messageText(const Message& message) {
  return std::visit(
      [](const auto& state) {
        std::string text;
        TextVisit<std::decay_t<decltype(state)>> visit(state, text);
        std::decay_t<decltype(state)>::fields(visit);
        return text;
      },
      message);
}

Json messageJson(const Message& message) {
  return std::visit(
      [](const auto& state) {
        Json json = Json::object();
        JsonVisit<std::decay_t<decltype(state)>> visit(state, json);
        std::decay_t<decltype(state)>::fields(visit);
        return json;
      },
      message);
}

}  // namespace whirl_twin
