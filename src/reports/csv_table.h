// Files that a command writes beside its report: tables of comma-separated values (RFC 4180), --csv
// FILE.csv; a figure, --plot FILE.svg, FILE.png, FILE.pdf or FILE.json.
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

/// Throws InputError unless the name ends in .csv, before anything is computed.
void requireCsvName(const std::optional<std::string>& path);

/// Writes them all. Throws RunFailure. Files appear only when they are complete.
void writeCsv(const std::string& path, const CsvTables& tables);

/// Throws InputError unless the name is one of a figure, before anything is computed.
void requirePictureName(const std::optional<std::string>& path);

/// FILE.svg of one system of several: FILE_SYSTEM.svg.
std::string pictureName(const std::string& path, const std::string& system, bool several);

}  // namespace whirl_twin
