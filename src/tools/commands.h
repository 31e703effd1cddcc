// The commands of `twin`, one file each. Every function adds its command to the command line; when
// the command is given, parsing runs it. A command that fails throws an InputError or a RunFailure,
// which main() turns into messages and an exit status.
#pragma once

#include "messages/input_error.h"
#include "tools/command.h"

namespace whirl_twin {

/// Exit statuses of `twin`.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;    ///< the run failed: diverged, a file cannot be written
inline constexpr int kBadInput = 2;  ///< invalid scene, file or option

// `status` outlives the command line; it is the exit status of the program if nothing is thrown.
void addCheckCommand(const ProgramCommand& twin, int& status);
void addScenesCommand(const ProgramCommand& twin, int& status);
void addModelsCommand(const ProgramCommand& twin, int& status);
void addControllersCommand(const ProgramCommand& twin, int& status);
void addUnitsCommand(const ProgramCommand& twin, int& status);
void addNewCommand(const ProgramCommand& twin, int& status);
void addImportCommand(const ProgramCommand& twin, int& status);
void addSimulateCommand(const ProgramCommand& twin, int& status);
void addServeCommand(const ProgramCommand& twin, int& status);
void addPlotCommand(const ProgramCommand& twin, int& status);
void addAnalyzeCommand(const ProgramCommand& twin, int& status);
void addCampbellCommand(const ProgramCommand& twin, int& status);
void addResponseCommand(const ProgramCommand& twin, int& status);
void addOrbitCommand(const ProgramCommand& twin, int& status);
void addTradeoffCommand(const ProgramCommand& twin, int& status);
void addBalanceCommand(const ProgramCommand& twin, int& status);
void addReportCommand(const ProgramCommand& twin, int& status);
void addRouthCommand(const ProgramCommand& twin, int& status);
void addLogCommand(const ProgramCommand& twin, int& status);
void addExportCommand(const ProgramCommand& twin, int& status);
void addRecordCommand(const ProgramCommand& twin, int& status);
void addPlayCommand(const ProgramCommand& twin, int& status);
void addSpyCommand(const ProgramCommand& twin, int& status);
void addWatchCommand(const ProgramCommand& twin, int& status);
void addFitCommand(const ProgramCommand& twin, int& status);
void addFollowCommand(const ProgramCommand& twin, int& status);
void addStabilityCommand(const ProgramCommand& twin, int& status);
void addLoopCommand(const ProgramCommand& twin, int& status);
void addMapCommand(const ProgramCommand& twin, int& status);
void addBodeCommand(const ProgramCommand& twin, int& status);
void addModesCommand(const ProgramCommand& twin, int& status);
void addMonitorCommand(const ProgramCommand& twin, int& status);
void addSweepCommand(const ProgramCommand& twin, int& status);

}  // namespace whirl_twin
