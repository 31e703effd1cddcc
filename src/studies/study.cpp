#include "studies/study.h"

#include <fmt/format.h>

namespace whirl_twin {

std::vector<double> Study::valuesAt(std::uint64_t point) const {
  std::vector<double> values;
  const bool by_levels = design.kind == Design::Kind::kGrid || design.kind == Design::Kind::kList ||
                         design.kind == Design::Kind::kOneAtATime;
  if (by_levels) {
    const std::vector<std::optional<std::size_t>> levels = levelsAt(design, point);
    for (std::size_t j = 0; j < vary.size(); ++j) {
      const Distribution& distribution = vary[j].distribution;
      const std::size_t of =
          design.kind == Design::Kind::kList ? distribution.list.size() : design.levels[j];
      values.push_back(levels[j] ? distribution.level(*levels[j], of) : vary[j].nominal);
    }
    return values;
  }
  const std::vector<double> u = quantilesAt(design, seed, point);
  for (std::size_t j = 0; j < vary.size(); ++j) {
    values.push_back(vary[j].distribution.value(u[j]));
  }
  return values;
}

std::string text(const Requirement& requirement, const Study& study) {
  const char* const sign = requirement.is == Requirement::Is::kBelow    ? "<"
                           : requirement.is == Requirement::Is::kAtMost ? "<="
                           : requirement.is == Requirement::Is::kAbove  ? ">"
                                                                        : ">=";
  return fmt::format("{} {} {}", study.measures[requirement.measure].name, sign, requirement.limit);
}

}  // namespace whirl_twin
