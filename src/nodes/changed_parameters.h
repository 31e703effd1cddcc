// Private parameters that somebody sets while a node runs (`rosparam set`): they are obeyed, or it
// is said, in the log and in the diagnostics, that they are not, until they are put back.
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
  /// Takes the parameters that may change as they are now, all of them; returns why they are
  /// refused, or "".
  using Obey = std::function<std::string(const YAML::Node& all)>;

  /// Of a node that reads all of its parameters at its start.
  explicit ChangedParameters(const MasterWatch& master);
  /// Of one that reads only `at_start` then.
  ChangedParameters(const MasterWatch& master, std::vector<std::string> at_start, Obey obey);

  /// Looks at what the master holds; to be called about once a second, as the diagnostics
  /// "private parameters" do.
  void report(diagnostic_updater::Updater& diagnostics);

 private:
  bool readAtStart(const std::string& name) const;
  std::string look();

  const MasterWatch& master_;
  std::vector<std::string> at_start_;
  Obey obey_;  // none: all are read at the start
  YAML::Node started_with_;
  std::string live_;  // as they were last
  std::string refusal_;
  std::string told_;
};

}  // namespace whirl_twin
