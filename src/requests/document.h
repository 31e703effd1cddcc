// The result of a request in every form that a command or a program may want: JSON, text, tables,
// figures. Figures are drawn only on request.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reports/csv_table.h"
#include "reports/output.h"

namespace whirl_twin {

struct Drawing {
  std::string name;            ///< of the system or run that it shows
  std::function<Json()> draw;  ///< figureJson(); owns what it shows
};

struct Document {
  Json json;
  std::string text;
  CsvTables tables;
  std::vector<Drawing> drawings;
  bool done = true;       ///< else the operation failed in part, and the exit status is 1
  std::string failure{};  ///< why; "": `text` has the reason
};

}  // namespace whirl_twin
