// A command of the command line and its options: CLI11, whose headers are included in command.cpp
// and twin.cpp only, because they add seven seconds of compile time to a file.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "requests/option_quantity.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace whirl_twin {

/// Reference to an option; a copy refers to the same one.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /// Placeholder of its value in the help, "" for none.
  Option type(const std::string& name) const;
  Option required() const;
  /// Valid only together with another.
  Option needs(const Option& other) const;
  /// Exactly so many values.
  Option values(int count) const;
  /// One value per occurrence of the option.
  Option oneByOne() const;
  Option among(const std::vector<std::string>& values) const;

  bool given() const;  ///< after parsing

 private:
  CLI::Option* option_;
};

/// Reference to a command, or to the command line itself.
class ProgramCommand {
 public:
  explicit ProgramCommand(CLI::App* app) : app_(app), takes_units_(std::make_shared<bool>(false)) {}

  ProgramCommand subcommand(const std::string& name, const std::string& description) const;
  /// value: the default, and the parsed value once the line is parsed; a string, a number, an
  /// optional or a vector of either (command.cpp lists them).
  template <class T>
  Option option(const std::string& name, T& value, const std::string& text) const;
  /// A physical number, with a unit or in that of `quantity`: a double or an optional. `fallback`
  /// is the default for the help, "" for none. An invalid number throws InputError.
  template <class T>
  Option quantity(const std::string& name, T& value, const OptionQuantity& quantity,
                  const std::string& text, const std::string& fallback = "") const;
  /// Several of them at each occurrence of the option.
  Option quantities(const std::string& name, std::vector<std::vector<double>>& value,
                    const std::vector<OptionQuantity>& parts, const std::string& text) const;
  Option flag(const std::string& name, bool& value, const std::string& text) const;
  /// From here on the help says that numbers may have units.
  void takeUnits() const { *takes_units_ = true; }
  /// Text below the options in the help.
  void footer(const std::string& text) const;
  /// The function that runs the command, once its options are parsed.
  void callback(const std::function<void()>& run) const;

 private:
  CLI::App* app_;
  std::shared_ptr<bool> takes_units_;
};

}  // namespace whirl_twin
