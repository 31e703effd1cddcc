// The commands of `twin`, one file each. Every function adds its command to the command line; when
// the command is given, parsing runs it. A command that cannot do its work throws a
// Refusal or a RunFailure, which main() turns into messages and an exit status.
#pragma once

#include <CLI/CLI.hpp>

#include "messages/refusal.h"

namespace whirl_twin {

/// Exit statuses of `twin`.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;    ///< the run failed: diverged, a file cannot be written
inline constexpr int kBadInput = 2;  ///< a scene, a file or an option is wrong

// `status` outlives the command line; it is what the program exits with if nothing is thrown.
void addCheckCommand(CLI::App& twin, int& status);
void addScenesCommand(CLI::App& twin, int& status);
void addModelsCommand(CLI::App& twin, int& status);
void addControllersCommand(CLI::App& twin, int& status);
void addNewCommand(CLI::App& twin, int& status);
void addImportCommand(CLI::App& twin, int& status);
void addSimulateCommand(CLI::App& twin, int& status);
void addPlotCommand(CLI::App& twin, int& status);
void addAnalyzeCommand(CLI::App& twin, int& status);
void addCampbellCommand(CLI::App& twin, int& status);
void addResponseCommand(CLI::App& twin, int& status);
void addOrbitCommand(CLI::App& twin, int& status);
void addTradeoffCommand(CLI::App& twin, int& status);
void addBalanceCommand(CLI::App& twin, int& status);
void addReportCommand(CLI::App& twin, int& status);
void addRouthCommand(CLI::App& twin, int& status);
void addLogCommand(CLI::App& twin, int& status);
void addExportCommand(CLI::App& twin, int& status);
void addRecordCommand(CLI::App& twin, int& status);
void addPlayCommand(CLI::App& twin, int& status);
void addSpyCommand(CLI::App& twin, int& status);
void addWatchCommand(CLI::App& twin, int& status);
void addFitCommand(CLI::App& twin, int& status);
void addFollowCommand(CLI::App& twin, int& status);
void addStabilityCommand(CLI::App& twin, int& status);
void addLoopCommand(CLI::App& twin, int& status);
void addMapCommand(CLI::App& twin, int& status);
void addModesCommand(CLI::App& twin, int& status);
void addMonitorCommand(CLI::App& twin, int& status);
void addSweepCommand(CLI::App& twin, int& status);

}  // namespace whirl_twin
