// Private parameters changed while a node runs (`rosparam set`): they are applied, or the log and
// the diagnostics report that they are not, until they are restored.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <yaml-cpp/yaml.h>

#include <functional>
#include <string>
#include <vector>

#include "transport/master_watch.h"

namespace whirl_twin {

class ChangedParameters {
 public:
  /// Applies the changeable parameters, all with their present values; returns why they are
  /// rejected, or "".
  using Obey = std::function<std::string(const YAML::Node& all)>;

  /// For a node that reads all of its parameters at its start.
  explicit ChangedParameters(const MasterWatch& master);
  /// For a node that reads only `at_start` then.
  ChangedParameters(const MasterWatch& master, std::vector<std::string> at_start, Obey obey);

  /// Adds the diagnostics "private parameters", which compare the parameters on the master; they
  /// must be updated about once a second.
  void report(diagnostic_updater::Updater& diagnostics);

 private:
  bool readAtStart(const std::string& name) const;
  std::string look();

  const MasterWatch& master_;
  std::vector<std::string> at_start_;
  Obey obey_;  // empty: all are read at the start
  YAML::Node started_with_;
  std::string live_;  // values at the last poll
  std::string refusal_;
  std::string reported_;
};

}  // namespace whirl_twin
