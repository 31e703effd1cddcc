#include "nodes/node_parameters.h"

#include <fmt/format.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <sstream>
#include <utility>

#include "messages/input_error.h"
#include "messages/names.h"
#include "transport/channels.h"
#include "transport/twin_namespace.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kHelpWidth = 96;

/// Private parameters that ROS's own libraries read.
constexpr const char* kParametersOfRos[] = {"diagnostic_period", "diagnostic_updater_use_fqn",
                                            "tf_prefix"};

bool isIn(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string rangeText(const ParameterRange& range) {
  const std::string unit = *range.unit == '\0' ? "" : std::string(" ") + range.unit;
  if (range.zero && range.low == 0.0) {
    return fmt::format("from 0 ({}) to {:g}{}", range.zero, range.high, unit);
  }
  const std::string zero = range.zero ? fmt::format("0 ({}), or ", range.zero) : "";
  return std::isinf(range.high)
             ? fmt::format("{}at least {:g}{}", zero, range.low, unit)
             : fmt::format("{}from {:g} to {:g}{}", zero, range.low, range.high, unit);
}

/// "", or the requirement that the parameter violates.
template <class Value>
std::string readAs(const std::string& name, const std::string& required, Value& value) {
  XmlRpc::XmlRpcValue given;  // getParam() of an integer would round 50.5
  ros::param::get(name, given);
  const bool whole = !std::is_same_v<Value, int> || given.getType() == XmlRpc::XmlRpcValue::TypeInt;
  return whole && ros::param::get(name, value)
             ? ""
             : fmt::format("{}: must be {}, found another type", name, required);
}

/// Wraps a paragraph; the second and later lines are indented.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  std::string out, word;
  std::size_t column = indent;
  while (words >> word) {
    if (column > indent && column + 1 + word.size() > kHelpWidth) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    }
    out += (column > indent ? " " : "") + word;
    column += word.size() + (column > indent ? 1 : 0);
  }
  return out;
}

}  // namespace

NodeParameters::NodeParameters(std::string node, std::string about)
    : node_(std::move(node)), about_(std::move(about)) {}

NodeParameters& NodeParameters::add(const char* name, std::string text,
                                    std::function<std::string(const std::string&)> read) {
  entries_.push_back({name, std::move(text), std::move(read)});
  return *this;
}

NodeParameters& NodeParameters::number(const char* name, double& value, const ParameterRange& range,
                                       const char* text) {
  const std::string required = rangeText(range);
  return add(name, fmt::format("{}, default {:g}: {}", required, value, text),
             [&value, range, required](const std::string& full) -> std::string {
               std::string fault = readAs(full, "a number " + required, value);
               const bool fits =
                   (value == 0.0 && range.zero) ||
                   (value >= range.low && value <= range.high && std::isfinite(value));
               return !fault.empty() || fits
                          ? fault
                          : fmt::format("{}: must be {}, found {}", full, required, value);
             });
}

NodeParameters& NodeParameters::whole(const char* name, int& value, int low, int high,
                                      const char* text) {
  const std::string required = fmt::format("a whole number from {} to {}", low, high);
  return add(name, fmt::format("{}, default {}: {}", required, value, text),
             [&value, low, high, required](const std::string& full) -> std::string {
               std::string fault = readAs(full, required, value);
               return !fault.empty() || (value >= low && value <= high)
                          ? fault
                          : fmt::format("{}: must be {}, found {}", full, required, value);
             });
}

NodeParameters& NodeParameters::flag(const char* name, bool& value, const char* text) {
  return add(name, fmt::format("true or false, default {}: {}", value, text),
             [&value](const std::string& full) { return readAs(full, "true or false", value); });
}

NodeParameters& NodeParameters::choice(const char* name, std::string& value,
                                       std::vector<std::string> among, const char* text) {
  std::string required = among.front();
  for (std::size_t i = 1; i < among.size(); ++i) {
    required += (i + 1 < among.size() ? ", " : " or ") + among[i];
  }
  return add(name, fmt::format("{}, default {}: {}", required, value, text),
             [&value, among = std::move(among), required](const std::string& full) -> std::string {
               std::string fault = readAs(full, required, value);
               return !fault.empty() || isIn(among, value)
                          ? fault
                          : fmt::format("{}: must be {}, found {}", full, required,
                                        whirl_twin::inQuotes(value));
             });
}

NodeParameters& NodeParameters::text(const char* name, std::string& value, const char* otherwise,
                                     const char* text) {
  return add(name, fmt::format("{}; default: {}", text, *otherwise == '\0' ? value : otherwise),
             [&value](const std::string& full) { return readAs(full, "a text", value); });
}

NodeParameters& NodeParameters::lcm(std::string& url, std::string& prefix, bool required) {
  url = kDefaultLcmUrl;
  prefix_ = &prefix;
  add("lcm_url",
      fmt::format("URL of LCM{}; default: {}", required ? "" : ", empty: no LCM", kDefaultLcmUrl),
      [&url, required](const std::string& full) -> std::string {
        std::string fault = readAs(full, "an LCM URL", url);
        return !fault.empty() || !required || !url.empty()
                   ? fault
                   : fmt::format("{}: must be an LCM URL, found nothing", full);
      });
  return text("lcm_prefix", prefix, "TWIN_, or the namespace of the twin in capitals",
              "prefix of the twin's LCM channels");
}

NodeParameters& NodeParameters::other(const char* name, const char* text) {
  return add(name, text, [](const std::string&) { return std::string(); });
}

NodeParameters& NodeParameters::others(std::string text) {
  others_ = std::move(text);
  all_known_ = false;
  return *this;
}

std::vector<std::string> NodeParameters::names() const {
  std::vector<std::string> all(std::begin(kParametersOfRos), std::end(kParametersOfRos));
  for (const Entry& entry : entries_) {
    all.push_back(entry.name);
  }
  return all;
}

std::string NodeParameters::help() const {
  std::string out =
      fmt::format("usage: {} [_PARAMETER:=VALUE...] [NAME:=VALUE...]\n{}\n", node_, about_);
  std::size_t width = 0;
  for (const Entry& entry : entries_) {
    width = std::max(width, entry.name.size());
  }
  if (!entries_.empty()) {
    out +=
        "\nprivate parameters (_NAME:=VALUE on the command line, or <param> in a launch file):\n";
  }
  for (const Entry& entry : entries_) {
    out += fmt::format("  ~{:<{}}  {}\n", entry.name, width, wrapped(entry.text, width + 5));
  }
  return out + others_;
}

void NodeParameters::read() const {
  const std::string node = ros::this_node::getName();
  const std::vector<std::string> known = names();
  std::vector<std::string> faults;
  XmlRpc::XmlRpcValue all;
  if (all_known_ && ros::param::get(node, all) &&
      all.getType() == XmlRpc::XmlRpcValue::TypeStruct) {
    for (const auto& parameter : all) {
      const std::string& name = parameter.first;
      if (!isIn(known, name)) {
        faults.push_back(
            fmt::format("{}/{}: unknown parameter{}", node, printable(name), hint(name, known)));
      }
    }
  }
  for (const Entry& entry : entries_) {
    const std::string full = node + "/" + entry.name;
    if (ros::param::has(full)) {
      if (std::string fault = entry.read(full); !fault.empty()) {
        faults.push_back(std::move(fault));
      }
    }
  }
  if (prefix_) {
    *prefix_ = prefix_->empty() ? lcmPrefixOf(twinNamespace()) : *prefix_;
    try {
      requireLcmPrefix(*prefix_);
    } catch (const InputError& error) {
      faults.push_back(fmt::format("{}/{}", node, error.what()));
    }
  }
  if (!faults.empty()) {
    throw InputError(fmt::format("{}", fmt::join(faults, "\n")));
  }
}

bool printsHelp(int argc, char** argv, const std::string& help) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--help") == 0 || std::strcmp(argv[i], "-h") == 0) {
      std::fputs(help.c_str(), stdout);
      return true;
    }
  }
  return false;
}

}  // namespace whirl_twin
