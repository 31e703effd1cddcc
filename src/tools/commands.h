// The commands of `twin`, one file each. Every function adds its command to the command line; when
// the command is given, parsing runs it. A command that cannot do its work throws a
// Refusal or a RunFailure, which main() turns into messages and an exit status.
#pragma once

#include "messages/refusal.h"
#include "tools/command.h"

namespace whirl_twin {

/// Exit statuses of `twin`.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;    ///< the run failed: diverged, a file cannot be written
inline constexpr int kBadInput = 2;  ///< a scene, a file or an option is wrong

// `status` outlives the command line; it is what the program exits with if nothing is thrown.
void addCheckCommand(const Command& twin, int& status);
void addScenesCommand(const Command& twin, int& status);
void addModelsCommand(const Command& twin, int& status);
void addControllersCommand(const Command& twin, int& status);
void addNewCommand(const Command& twin, int& status);
void addImportCommand(const Command& twin, int& status);
void addSimulateCommand(const Command& twin, int& status);
void addPlotCommand(const Command& twin, int& status);
void addAnalyzeCommand(const Command& twin, int& status);
void addCampbellCommand(const Command& twin, int& status);
void addResponseCommand(const Command& twin, int& status);
void addOrbitCommand(const Command& twin, int& status);
void addTradeoffCommand(const Command& twin, int& status);
void addBalanceCommand(const Command& twin, int& status);
void addReportCommand(const Command& twin, int& status);
void addRouthCommand(const Command& twin, int& status);
void addLogCommand(const Command& twin, int& status);
void addExportCommand(const Command& twin, int& status);
void addRecordCommand(const Command& twin, int& status);
void addPlayCommand(const Command& twin, int& status);
void addSpyCommand(const Command& twin, int& status);
void addWatchCommand(const Command& twin, int& status);
void addFitCommand(const Command& twin, int& status);
void addFollowCommand(const Command& twin, int& status);
void addStabilityCommand(const Command& twin, int& status);
void addLoopCommand(const Command& twin, int& status);
void addMapCommand(const Command& twin, int& status);
void addModesCommand(const Command& twin, int& status);
void addMonitorCommand(const Command& twin, int& status);
void addSweepCommand(const Command& twin, int& status);

}  // namespace whirl_twin
