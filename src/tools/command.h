// A command of the command line and its options: CLI11, whose headers are read in command.cpp and
// twin.cpp only. A file that reads them takes seven seconds longer to compile.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace whirl_twin {

/// Refers to an option; a copy is the same one.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /// What stands for its value in the help, "" for nothing.
  Option type(const std::string& name) const;
  Option required() const;
  /// Only together with another.
  Option needs(const Option& other) const;
  /// As many values, all of them.
  Option values(int count) const;
  /// One value each time it is said.
  Option oneByOne() const;
  Option among(const std::vector<std::string>& values) const;

  bool given() const;  ///< after parsing

 private:
  CLI::Option* option_;
};

/// Refers to a command, or to the command line itself.
class ProgramCommand {
 public:
  explicit ProgramCommand(CLI::App* app) : app_(app) {}

  ProgramCommand subcommand(const std::string& name, const std::string& description) const;
  /// value: what it is without the option, and with it once the line is parsed; a string, a number,
  /// an optional or a vector of either (command.cpp lists them).
  template <class T>
  Option option(const std::string& name, T& value, const std::string& text) const;
  Option flag(const std::string& name, bool& value, const std::string& text) const;
  /// Below the options in the help.
  void footer(const std::string& text) const;
  /// What the command does, once its options are parsed.
  void callback(const std::function<void()>& run) const;

 private:
  CLI::App* app_;
};

}  // namespace whirl_twin
