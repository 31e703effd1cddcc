// Parsing of command-line arguments: channels, names, times.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/command.h"

namespace whirl_twin {

// --channel: selects channels of a log, or topics of a bag.

/// Shell patterns with *, ? and [...]; none means all.
using ChannelFilter = std::vector<std::string>;

void addChannelOption(const ProgramCommand& command, ChannelFilter& filter);

bool selects(const ChannelFilter& filter, const std::string& channel);

/// --insist: allow a command that takes more than a day, or more memory than is free
/// (reports/asked_cost.h).
void addInsistOption(const ProgramCommand& command, bool& insist);

/// --csv: the command's tables, into files (reports/csv_table.h).
void addCsvOption(const ProgramCommand& command, std::optional<std::string>& csv);

inline constexpr std::int64_t kSecond = 1'000'000'000;  ///< [ns]

/// Parses seconds, or a number with a unit of time, and rounds to the nearest whole number of
/// `unit`s [ns]; result in nanoseconds, from `low` to `high` [ns]. Exact: without intermediate
/// binary fractions. A value that is not a whole number is reported on standard error with the
/// value used instead. `option` names it there. Throws InputError.
std::int64_t parseNanoseconds(const std::string& option, const std::string& text, std::int64_t low,
                              std::int64_t high, std::int64_t unit = 1);

/// Nanoseconds as seconds, for a message: "0.0005 s".
std::string inSeconds(std::int64_t nanoseconds);

/// The arguments of `twin` in the order that CLI11 requires: coefficients of `twin routh` often
/// begin with a minus sign, so they go last, behind a `--`.
std::vector<std::string> orderedArguments(int argc, const char* const* argv);

}  // namespace whirl_twin
