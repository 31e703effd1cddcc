#include "tools/command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>

namespace whirl_twin {

namespace {

constexpr const char* kUnitsNote =
    "A number may have a unit: \"800 rpm\", \"5 mil\", \"2 ms\" (`twin units`); without one it is "
    "in SI\nunits.";

}  // namespace

Option Option::type(const std::string& name) const {
  return Option(option_->type_name(name));
}

Option Option::required() const {
  return Option(option_->required());
}

Option Option::needs(const Option& other) const {
  return Option(option_->needs(other.option_));
}

Option Option::values(int count) const {
  return Option(option_->type_size(count));
}

Option Option::oneByOne() const {
  return Option(option_->expected(1)->take_all());
}

Option Option::among(const std::vector<std::string>& values) const {
  return Option(option_->check(CLI::IsMember(values)));
}

bool Option::given() const {
  return option_->count() > 0;
}

ProgramCommand ProgramCommand::subcommand(const std::string& name,
                                          const std::string& description) const {
  return ProgramCommand(app_->add_subcommand(name, description));
}

template <class T>
Option ProgramCommand::option(const std::string& name, T& value, const std::string& text) const {
  return Option(app_->add_option(name, value, text));
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type
#define WHIRL_TWIN_OPTION(...)                                                          \
  template Option ProgramCommand::option<__VA_ARGS__>(const std::string&, __VA_ARGS__&, \
                                                      const std::string&) const;
// NOLINTEND(bugprone-macro-parentheses)
WHIRL_TWIN_OPTION(std::string)
WHIRL_TWIN_OPTION(double)
WHIRL_TWIN_OPTION(int)
WHIRL_TWIN_OPTION(unsigned int)
WHIRL_TWIN_OPTION(std::optional<std::string>)
WHIRL_TWIN_OPTION(std::optional<double>)
WHIRL_TWIN_OPTION(std::optional<std::size_t>)
WHIRL_TWIN_OPTION(std::vector<std::string>)
WHIRL_TWIN_OPTION(std::vector<double>)
WHIRL_TWIN_OPTION(std::vector<int>)

template <class T>
Option ProgramCommand::quantity(const std::string& name, T& value, const OptionQuantity& quantity,
                                const std::string& text, const std::string& fallback) const {
  takeUnits();
  const auto take = [&value, name, quantity](const CLI::results_t& given) {
    value = readQuantity(name, given.at(0), quantity);
    return true;
  };
  return Option(app_->add_option(name, CLI::callback_t(take),
                                 fmt::format("{}, {}{}", text, rangeText(quantity),
                                             fallback.empty() ? "" : "; default: " + fallback)));
}
template Option ProgramCommand::quantity<double>(const std::string&, double&, const OptionQuantity&,
                                                 const std::string&, const std::string&) const;
template Option ProgramCommand::quantity<std::optional<double>>(const std::string&,
                                                                std::optional<double>&,
                                                                const OptionQuantity&,
                                                                const std::string&,
                                                                const std::string&) const;

Option ProgramCommand::quantities(const std::string& name, std::vector<std::vector<double>>& value,
                                  const std::vector<OptionQuantity>& parts,
                                  const std::string& text) const {
  takeUnits();
  const auto take = [&value, name, parts](const CLI::results_t& given) {
    value.assign(given.size() / parts.size(), {});
    for (std::size_t i = 0; i < given.size(); ++i) {
      value[i / parts.size()].push_back(readQuantity(name, given[i], parts[i % parts.size()]));
    }
    return true;
  };
  return Option(app_->add_option(name, CLI::callback_t(take), text)
                    ->type_size(static_cast<int>(parts.size()))
                    ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
}

Option ProgramCommand::flag(const std::string& name, bool& value, const std::string& text) const {
  return Option(app_->add_flag(name, value, text));
}

void ProgramCommand::footer(const std::string& text) const {
  app_->footer(*takes_units_ ? text + "\n\n" + kUnitsNote : text);
}

void ProgramCommand::callback(const std::function<void()>& run) const {
  app_->callback(run);
}

}  // namespace whirl_twin
