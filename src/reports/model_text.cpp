#include "reports/model_text.h"

#include <fmt/format.h>

namespace whirl_twin {

std::vector<std::string> integratorsOf(const ModelVariant& variant) {
  std::vector<std::string> all{"auto"};
  all.insert(all.end(), variant.integrators.begin(), variant.integrators.end());
  return all;
}

std::string contentsText(const SettingInfo& s) {
  if (s.kind == SettingKind::kChoice) {
    return fmt::format("{} (default {})", fmt::join(s.choices, " | "), s.choices.front());
  }
  if (s.kind == SettingKind::kWordOrCount) {
    return fmt::format("a whole number or {} (default {})", fmt::join(s.choices, " | "),
                       s.choices.front());
  }
  std::vector<std::string> columns = s.word_columns;
  for (const ColumnInfo& c : s.columns) {
    columns.push_back(fmt::format("{} ({})", c.name, c.unit));
  }
  const std::string need = s.required ? "required" : "optional";
  if (s.kind == SettingKind::kTable) {
    return fmt::format("list of {{{}}}, {}", fmt::join(columns, ", "), need);
  }
  return s.kind == SettingKind::kMatrix ? fmt::format("rows of numbers ({}), {}", s.unit, need)
                                        : fmt::format("list of names, {}", need);
}

}  // namespace whirl_twin
