// Tables of a report as comma-separated values (RFC 4180): --csv FILE.csv of a command.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/output.h"

namespace whirl_twin {

/// Some columns of rows that are JSON objects: what a row does not have, or has as null, is an
/// empty cell; numbers have the shortest digits that give them back, nan or inf.
struct CsvTable {
  std::string name;                  ///< "" of the command's main table
  std::vector<std::string> columns;  ///< keys of the rows, SI units
  Json rows = Json::array();
};
using CsvTables = std::vector<CsvTable>;

/// The rows of one system's tables go below those of the others, with the system before them.
void append(CsvTables& all, const std::string& system, const CsvTables& more);

/// Throws Refusal unless the name ends in .csv, before anything is computed.
void requireCsvName(const std::optional<std::string>& path);

/// Where a table of a command goes: FILE.csv, of one with a name FILE_NAME.csv.
std::string csvName(const std::string& path, const std::string& table);

std::string csvText(const CsvTable& table);

/// Writes them all. Throws RunFailure. Files appear only when they are complete.
void writeCsv(const std::string& path, const CsvTables& tables);

}  // namespace whirl_twin
