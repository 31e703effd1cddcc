// What `twin sweep` says: the answers of a study, how far it has come, and one point of it.
#pragma once

#include <string>
#include <vector>

#include "reports/output.h"
#include "studies/answers.h"

namespace whirl_twin {

std::string text(const Study& study, const Answers& answers);
Json json(const Study& study, const Answers& answers);

/// "damping (N s/m)"; the name alone of what has no unit.
std::string nameWithUnit(const std::string& name, const std::string& unit);

/// One point, run alone.
struct StudyPoint {
  std::uint64_t point = 0;
  std::vector<double> values;
  Outcome outcome;
};
std::string text(const Study& study, const StudyPoint& point);
Json json(const Study& study, const StudyPoint& point);

struct StudyStatus {
  std::uint64_t done = 0;  ///< points of finished blocks
  double rate = 0.0;       ///< [points/s], of all who work on it; NaN: not known
  double left = 0.0;       ///< [s], likewise
};
StudyStatus statusOf(const Study& study, const ResultFolder& folder);
std::string text(const Study& study, const StudyStatus& status);
Json json(const Study& study, const StudyStatus& status);

}  // namespace whirl_twin
