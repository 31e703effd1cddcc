// Reads columns of numbers from a file of comma-separated values with a header line.
#pragma once

#include <string>
#include <vector>

namespace whirl_twin {

/// The columns of these names, each with a number for every row. Throws InputError with the row and
/// column of the error: no file, a file larger than 64 MiB, duplicate column names (whether or not
/// they are requested), no such column, a row with more values than names, or without a finite
/// number in a requested column. `cut` (not nullptr): a last line without a line end is left out,
/// as its last number may be cut, and *cut is true.
std::vector<std::vector<double>> csvColumns(const std::string& path,
                                            const std::vector<std::string>& names,
                                            bool* cut = nullptr);

/// The cells of one line, without surrounding blanks and quotation marks, and without a byte order
/// mark.
std::vector<std::string> csvCells(const std::string& line);

}  // namespace whirl_twin
