// Table of the private parameters of a node, each declared once with name, kind, range, default and
// description: generates the text of --help and the list of known names, and reads the values,
// reporting all errors at once.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace whirl_twin {

/// Range of a number.
struct ParameterRange {
  double low, high;
  const char* unit;            ///< "s"
  const char* zero = nullptr;  ///< meaning of 0, if it is valid although below `low`
};

class NodeParameters {
 public:
  /// `about`: the purpose of the node, for --help, in lines of at most 96 characters.
  NodeParameters(std::string node, std::string about);

  // Each declares a parameter. `value` holds the default, and after read() the given value; it must
  // outlive this object.
  NodeParameters& number(const char* name, double& value, const ParameterRange& range,
                         const char* text);
  NodeParameters& whole(const char* name, int& value, int low, int high, const char* text);
  NodeParameters& flag(const char* name, bool& value, const char* text);
  NodeParameters& choice(const char* name, std::string& value, std::vector<std::string> among,
                         const char* text);
  /// `otherwise`: description of the default, for a value that is initially empty.
  NodeParameters& text(const char* name, std::string& value, const char* otherwise,
                       const char* text);
  /// ~lcm_url, and the prefix of the twin's channels: by default its namespace in capitals. An
  /// empty URL switches LCM off, unless the node needs it (`required`).
  NodeParameters& lcm(std::string& url, std::string& prefix, bool required = false);
  /// A parameter that other code reads.
  NodeParameters& other(const char* name, const char* text);
  /// All other names are valid, as other code checks them; `text` explains them below the list.
  NodeParameters& others(std::string text);

  /// All declared, and those that ROS's own libraries read.
  std::vector<std::string> names() const;
  /// The text of --help: needs no ROS master.
  std::string help() const;
  /// Reads all from the parameter server. Throws InputError with every parameter that is unknown,
  /// of another type or out of its range.
  void read() const;

 private:
  struct Entry {
    std::string name, text;  // of the help
    /// Reads the parameter if it is given; returns the requirement it violates, or "".
    std::function<std::string(const std::string& full_name)> read;
  };
  NodeParameters& add(const char* name, std::string text,
                      std::function<std::string(const std::string&)> read);

  std::string node_, about_, others_;
  bool all_known_ = true;
  std::vector<Entry> entries_;
  std::string* prefix_ = nullptr;
};

/// The text of --help of a node whose parameters `table` declares.
template <class Parameters>
std::string helpOf(NodeParameters (*table)(Parameters&)) {
  Parameters defaults;
  return table(defaults).help();
}

/// Prints the help if the command line requests it; returns whether it did.
bool printsHelp(int argc, char** argv, const std::string& help);

}  // namespace whirl_twin
