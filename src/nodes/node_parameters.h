// The private parameters of a node, each declared once: name, kind, range, default and description
// give the text of --help, the list of known names, and the reading with all errors at once.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace whirl_twin {

/// What ROS's own libraries read of a node's private parameters.
inline const std::vector<std::string> kParametersOfRos{"diagnostic_period",
                                                       "diagnostic_updater_use_fqn", "tf_prefix"};

/// What a number may be.
struct ParameterRange {
  double low, high;
  const char* unit;            ///< "s"
  const char* zero = nullptr;  ///< what 0 means, where it is allowed although below `low`
};

class NodeParameters {
 public:
  /// `about`: what the node does, for --help, in lines of at most 96 characters.
  NodeParameters(std::string node, std::string about);

  // Each declares a parameter. `value` is the default, and what is given after read(). It outlives
  // this.
  NodeParameters& number(const char* name, double& value, const ParameterRange& range,
                         const char* text);
  NodeParameters& whole(const char* name, int& value, int low, int high, const char* text);
  NodeParameters& flag(const char* name, bool& value, const char* text);
  NodeParameters& choice(const char* name, std::string& value, std::vector<std::string> among,
                         const char* text);
  /// `otherwise`: the default in words, of a value that is empty until then.
  NodeParameters& text(const char* name, std::string& value, const char* otherwise,
                       const char* text);
  /// ~lcm_url, and the prefix of the twin's channels: its namespace in capitals until it is given.
  NodeParameters& lcm(std::string& url, std::string& prefix);
  /// One that is read elsewhere.
  NodeParameters& other(const char* name, const char* text);
  /// Any others are known elsewhere; `text` says where, below the list.
  NodeParameters& others(std::string text);

  /// The text of --help: needs no ROS master.
  std::string help() const;
  /// Reads all from the parameter server. Throws Refusal with every parameter that is unknown, of
  /// another type or out of its range.
  void read() const;

 private:
  struct Entry {
    std::string name, text;  // of the help
    /// "" or what is required; reads a parameter that is given.
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

/// True if the command line asks for help, which is then printed.
bool printsHelp(int argc, char** argv, const std::string& help);

}  // namespace whirl_twin
