// How a table of numbers is written as text: separators, decimal mark, comment lines, the lines of
// names and units. Found from the first lines of the table, unless it is given.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/node_reader.h"
#include "scene/table_cells.h"

namespace whirl_twin {

/// What is given of a table; the rest is found from its first lines.
struct TableSettings {
  std::optional<char> separator;   ///< ',' ';' tab, or ' ' for any number of blanks and tabs
  std::optional<char> decimal;     ///< '.' or ','
  std::string comment;             ///< beginning of comment lines; "": `#`, `%` and `//`
  std::size_t skip = 0;            ///< lines before the names
  std::vector<std::string> names;  ///< of the columns; empty: those of the table
  std::string time;                ///< column of the time; "": found by its name
  std::string time_unit;           ///< "": as in the heading, or s
  double rate = 0.0;               ///< [Hz], of the rows, whose time is not given; 0: it is
};

/// The keys of these settings in a YAML map: separator, decimal, comment, skip, names, time, rate.
const std::vector<std::string>& tableKeys();
/// Adds diagnostics to those of the map.
TableSettings readTableSettings(const MapReader& map, Diagnostics& diagnostics);

struct TableDialect {
  char separator = ',';
  char decimal = '.';
  std::string comment;               ///< as in the settings
  std::vector<TableColumn> columns;  ///< as many as there are names, or numbers in a row
  std::size_t names_line = 0;        ///< from 1 on; 0: no names
  std::size_t units_line = 0;        ///< likewise
  std::size_t rows_after = 0;        ///< number of the line after which the rows begin

  /// "separator ';', decimal ',', units in line 2".
  std::string text() const;
  /// Commas, and the names in the first line.
  bool isPlain() const;
  bool isComment(std::string_view line) const;
};

/// From the first lines of a table. Throws InputError for names that are duplicates.
TableDialect dialectOf(const std::vector<std::string>& lines, const TableSettings& settings);

}  // namespace whirl_twin
