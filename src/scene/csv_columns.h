// Columns of numbers out of a file of comma-separated values with a line of names at its top.
#pragma once

#include <string>
#include <vector>

namespace whirl_twin {

/// The columns of these names, each with a number for every row. Throws Refusal with
/// what is wrong, its row and column named: no file, a larger one than 64 MiB, columns of the
/// same name (all of them, whether asked for or not), no such column, a row with more values than
/// there are names, or without a finite number there.
std::vector<std::vector<double>> csvColumns(const std::string& path,
                                            const std::vector<std::string>& names);

}  // namespace whirl_twin
