// A recording of a machine or a twin, for the commands that evaluate one: an LCM log, a rosbag, or
// a table of measurements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "estimation/table_import.h"
#include "transport/logged_messages.h"

namespace whirl_twin {

struct Recording {
  std::string path;
  std::string prefix = kDefaultLcmPrefix;  ///< of the channels, in a log
  std::optional<std::string> import;       ///< file of the ImportSettings, of a table
};

/// Neither LCM log nor rosbag, by its first bytes and its name: a text, or a UFF file.
bool isTable(const std::string& path);

/// Gives `take` the messages of a recording. Those of a table are measurements of the sources, with
/// their instants as stamps. Throws InputError as readLoggedMessages() and TableImport, and for
/// settings of an import without a table.
LoggedMessages readRecording(const Recording& recording,
                             const std::vector<EstimatorSource>& sources, const Kinds& kinds,
                             const TakeLogged& take, const LogProgress& advanced,
                             LogOrder order = LogOrder::kRecorded);

}  // namespace whirl_twin
