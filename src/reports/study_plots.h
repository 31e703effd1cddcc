// What `twin plot` draws of a study's results.
//
//   histogram  of a measure: its percentiles, and the limits of what is required of it
//   scatter    of a measure over each number that varies; one at a time: its course over each
//   tornado    which of the numbers a measure hangs on, the heaviest at the top: of the designs
//              sobol_indices, morris and one_at_a_time
//   map        of a measure over two numbers: of a grid of two
#pragma once

#include <string>
#include <vector>

#include "plots/canvas.h"
#include "studies/answers.h"

namespace whirl_twin {

struct StudyPlot {
  std::string measure;  ///< its name
  std::string kind;     ///< "histogram", "scatter", "tornado" or "map"
  std::string image;    ///< the file
};

/// Of every measure, in the study's order; none of one that is finite nowhere. Throws RunFailure.
std::vector<StudyPlot> studyPlots(const Study& study, const StudyTable& table,
                                  const Answers& answers, ImageFormat format);

}  // namespace whirl_twin
