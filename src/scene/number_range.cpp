#include "scene/number_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "messages/names.h"
#include "models/model_info.h"

namespace whirl_twin {

std::string expected(Range range, const std::string& unit) {
  if (range == Range::kAny) {
    return fmt::format("a finite number{}", unit == "-" ? "" : " in " + unit);
  }
  return describe(range) + (unit == "-" ? "" : " " + unit);
}

bool inRange(Range range, double value) {
  switch (range) {
    case Range::kPositive:
      return std::isfinite(value) && value > 0.0;
    case Range::kNotNegative:
      return std::isfinite(value) && value >= 0.0;
    case Range::kCount:
      return value >= 1.0 && value <= 1.0e6 && value == std::floor(value);
    case Range::kAny:
      break;
  }
  return std::isfinite(value);
}

std::string objection(Range range, const std::string& unit, double value) {
  return inRange(range, value)
             ? ""
             : fmt::format(std::isfinite(value) ? "must be {}, found {}" : "must be {}, found '{}'",
                           expected(range, unit), value);
}

std::string objectionToName(const std::string& name, const std::vector<std::string>& known,
                            const std::string& kind) {
  if (std::find(known.begin(), known.end(), name) != known.end()) {
    return "";
  }
  const std::string near = nearestName(name, known);
  return fmt::format("unknown {}{}", kind,
                     near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
}

}  // namespace whirl_twin
