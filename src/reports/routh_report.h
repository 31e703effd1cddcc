// What `twin routh` shows besides the counts: the table, and for which values of a parameter a
// polynomial is stable.
#pragma once

#include <string>

#include "analysis/routh_table.h"
#include "analysis/stability_range.h"
#include "reports/csv_table.h"

namespace whirl_twin {

Json json(const RouthTable& table, const std::string& symbol);
std::string text(const RouthTable& table, const std::string& symbol);
CsvTable csv(const RouthTable& table, const std::string& symbol);

Json json(const StabilityRange& range, const std::string& symbol);
std::string text(const StabilityRange& range, const std::string& symbol);

}  // namespace whirl_twin
