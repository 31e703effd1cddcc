// Text as one cell of comma-separated values.
#pragma once

#include <string>

namespace whirl_twin {

/// With quotation marks where a reader would take it for more than one cell (RFC 4180), and behind
/// a ' where a spreadsheet would compute it instead of showing it: text that begins with =, +, -, @
/// or a tab. Control characters are shown escaped, as by printable().
std::string csvCell(const std::string& text);

}  // namespace whirl_twin
