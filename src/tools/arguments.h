// What the command line's words mean: scenes, names, and numbers with a unit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/command.h"

namespace whirl_twin {

// --channel: which channels of a log, or topics of a bag, a command is about.

/// Patterns as the shell has them, *, ? and [...]; none means all.
using ChannelFilter = std::vector<std::string>;

void addChannelOption(const ProgramCommand& command, ChannelFilter& filter);

bool selects(const ChannelFilter& filter, const std::string& channel);

/// The scene that a command is about.
void addSceneOption(const ProgramCommand& command, std::string& scene);

/// --insist: do what takes more than a day, or more memory than is free (reports/asked_cost.h).
void addInsistOption(const ProgramCommand& command, bool& insist);

/// --csv: the command's tables, into files (reports/csv_table.h).
void addCsvOption(const ProgramCommand& command, std::optional<std::string>& csv);

inline constexpr std::int64_t kSecond = 1'000'000'000;  ///< [ns]

/// Seconds, as typed, as the nearest whole number of `unit`s [ns], in nanoseconds; from `low` to
/// `high` [ns]. Exact: no binary fraction comes in between. What is not a whole number is said on
/// standard error with what is taken instead. `option` names it there. Throws Refusal.
std::int64_t parseNanoseconds(const std::string& option, const std::string& text, std::int64_t low,
                              std::int64_t high, std::int64_t unit = 1);

/// Nanoseconds as seconds, for a message: "0.0005 s".
std::string inSeconds(std::int64_t nanoseconds);

/// The arguments of `twin` in the order CLI11 wants: coefficients of `twin routh` begin with a
/// minus sign as often as not, so they go last, behind a `--`.
std::vector<std::string> orderedArguments(int argc, const char* const* argv);

}  // namespace whirl_twin
