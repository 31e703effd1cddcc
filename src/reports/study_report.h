// Results of `twin sweep`: statistics of a study, its progress, one point of it, an optimum, and
// pictures: histogram, scatter, tornado, map.
#pragma once

#include <string>
#include <vector>

#include "reports/figure.h"
#include "reports/output.h"
#include "studies/answers.h"
#include "studies/optimizer.h"

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

std::string text(const Study& study, const Optimum& optimum);
Json json(const Study& study, const Optimum& optimum);

struct StudyPlot {
  std::string measure;  ///< its name
  std::string kind;     ///< "histogram", "scatter", "tornado" or "map"
  Json figure;
};

/// Of every measure, in the study's order; none of one that is finite nowhere.
std::vector<StudyPlot> studyPlots(const Study& study, const StudyTable& table,
                                  const Answers& answers);

}  // namespace whirl_twin
