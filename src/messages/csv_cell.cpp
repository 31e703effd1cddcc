#include "messages/csv_cell.h"

#include "messages/names.h"

namespace whirl_twin {

std::string csvCell(const std::string& text) {
  const bool computed = text.size() > 1 && std::string("=+-@\t").find(text[0]) != std::string::npos;
  const std::string shown = (computed ? "'" : "") + printable(text, text.size());
  if (shown.find_first_of(",\"") == std::string::npos) {
    return shown;
  }
  std::string inQuotes = "\"";
  for (const char c : shown) {
    inQuotes += c == '"' ? "\"\"" : std::string(1, c);
  }
  return inQuotes + '"';
}

}  // namespace whirl_twin
