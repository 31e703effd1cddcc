// Universal file format (UFF, UNV): the time responses of its data sets 58, in ASCII.
#pragma once

#include <memory>
#include <string>

#include "scene/table_reader.h"

namespace whirl_twin {

/// The first line of such a file begins a data set, `    -1`.
bool isUffFile(const std::string& path);

/// The responses as columns: heading from the first line of its identification, name from response
/// entity, node and direction, `3+Y`, unit from the ordinate. Other data sets are left out, with a
/// remark. Throws InputError with the line for what is no such file, without responses, or with
/// responses at different instants.
std::unique_ptr<NumberTable> openUffFile(const std::string& path);

/// A table of measurements: of this kind, or of text.
std::unique_ptr<NumberTable> openNumberTable(const std::string& path,
                                             const TableSettings& settings);

}  // namespace whirl_twin
