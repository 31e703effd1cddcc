// Cells of a table of numbers: headings with units, numbers, instants.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whirl_twin {

std::string_view withoutBlanks(std::string_view text);

/// A unit, in brackets or not, with letters for micro and degree signs; "": it is none. An index is
/// none: `positions[0]`.
std::string unitIn(std::string_view text);

struct TableColumn {
  std::string heading;  ///< `Angle (deg)`; its number from 1 on in a table without names
  std::string name;     ///< `Angle`
  std::string unit;     ///< `deg`; "": none
};

/// Name and unit of `t [ms]`, `x (mil)`, `Angle, rad`, `U / V`; without a known unit the heading is
/// the name.
TableColumn columnOfHeading(const std::string& heading);

/// The cells of a line without surrounding blanks and quotation marks, within which a separator is
/// a character of the cell.
void splitCells(std::string_view line, char separator, std::vector<std::string_view>& cells);

/// A number, nothing where there is none: a cell that is empty or one of nan, na, n/a, null, none,
/// inf is a gap, NaN.
std::optional<double> cellNumber(std::string_view cell, char decimal);

/// [ns] from 1970 on, of "2026-03-01T12:00:00.25Z" or with a blank for the T; UTC unless the offset
/// of a zone follows.
std::optional<std::int64_t> isoInstant(std::string_view cell);

}  // namespace whirl_twin
