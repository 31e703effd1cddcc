#include "reports/model_text.h"

#include <fmt/format.h>

#include "models/model_registry.h"

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
  columns.insert(columns.end(), s.optional_words.begin(), s.optional_words.end());
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

std::string parameterText(const ParameterInfo& p, const std::string& without) {
  const std::string fallback = !p.fallback_parameter.empty() ? "default " + p.fallback_parameter
                               : p.fallback ? fmt::format("default {:g}", *p.fallback)
                                            : without;
  return fmt::format("  parameter   {:<18} {:<9} {:<6} {:<18} {}\n", p.name, p.unit,
                     describe(p.range), fallback, p.meaning);
}

std::string settingText(const SettingInfo& s) {
  return fmt::format("  parameter   {:<18} {}: {}\n", s.name, contentsText(s), s.meaning);
}

Json parameterJson(const ParameterInfo& p) {
  Json json;
  json["unit"] = p.unit;
  json["range"] = describe(p.range);
  json["default"] = p.fallback                     ? Json(*p.fallback)
                    : p.fallback_parameter.empty() ? Json()
                                                   : Json(p.fallback_parameter);
  json["required"] = json["default"].is_null();
  json["meaning"] = p.meaning;
  return json;
}

Json settingJson(const SettingInfo& s) {
  constexpr const char* kKinds[] = {"choice", "matrix", "names", "table", "word_or_count"};
  Json json;
  json["kind"] = kKinds[static_cast<int>(s.kind)];
  json["required"] = s.required;
  json["meaning"] = s.meaning;
  if (s.kind == SettingKind::kChoice || s.kind == SettingKind::kWordOrCount) {
    json["choices"] = s.choices;
    json["default"] = s.choices.front();
  }
  for (const ColumnInfo& c : s.columns) {
    json["columns"][c.name] = {{"unit", c.unit}, {"range", describe(c.range)}};
  }
  for (const std::string& c : s.word_columns) {
    json["columns"][c] = {{"unit", "name"}};
  }
  for (const std::string& c : s.optional_words) {
    json["columns"][c] = {{"unit", "name"}};
  }
  return json;
}

}  // namespace whirl_twin
