// Text as one cell of comma-separated values.
#pragma once

#include <string>

namespace whirl_twin {

/// Quotes a cell that a reader would split (RFC 4180), and prefixes ' to one that a spreadsheet
/// would evaluate as a formula: text that begins with =, +, -, @ or a tab. Control characters are
/// escaped, as by printable().
std::string csvCell(const std::string& text);

}  // namespace whirl_twin
