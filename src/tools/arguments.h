// Options that several commands share, and the order of arguments.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "requests/scene_argument.h"
#include "tools/command.h"

namespace whirl_twin {

// --channel: selects channels of a log, or topics of a bag.

/// Shell patterns with *, ? and [...]; none means all.
using ChannelFilter = std::vector<std::string>;

void addChannelOption(const ProgramCommand& command, ChannelFilter& filter);

bool selects(const ChannelFilter& filter, const std::string& channel);

/// --set: values that replace those of the scene.
Option addSetOption(const ProgramCommand& command, SceneArgument& scene);
/// SCENE and --set.
void addSceneOption(const ProgramCommand& command, SceneArgument& scene);

/// --insist: allow a command that takes more than a day, or more memory than is free
/// (reports/asked_cost.h).
void addInsistOption(const ProgramCommand& command, bool& insist);

/// --import: how the columns of a table of measurements are read (estimation/import_settings.h).
Option addImportOption(const ProgramCommand& command, std::optional<std::string>& import);

/// --csv: the command's tables, into files (reports/csv_table.h).
void addCsvOption(const ProgramCommand& command, std::optional<std::string>& csv);

/// The arguments of `twin` in the order that CLI11 requires: coefficients of `twin routh` often
/// begin with a minus sign, so they go last, behind a `--`.
std::vector<std::string> orderedArguments(int argc, const char* const* argv);

}  // namespace whirl_twin
