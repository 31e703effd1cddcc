// Results of a study in one HDF5 file, results.h5 in its folder: tables, statistics, and the texts
// of study and scene.
//
//   /            attributes study, scene: their files' texts; design, points, failures
//   /point       numbers of the points that did not fail [n]
//   /vary/PATH   a number that varies [n]; attributes unit, nominal
//   /measure/NAME  a measure [n]; attributes expression, unit, count, undefined, mean,
//                standard_deviation, smallest, largest, percentiles, percentiles_at [%]
//   /failed      point [m], reason [m], vary/PATH [m]: those that did fail
//   /require     requirement, passed, of, part, low, high [r]: the yield of each, and of all
//   /sobol/NAME/PATH   attributes first, total: value, low, high; /sobol/NAME: rows, left_out
//   /morris/NAME/PATH  attributes mean, mean_magnitude, standard_deviation, likewise
//
// Chunked, with gzip compression. The content is independent of time, place and workers.
#pragma once

#include <string>

#include "studies/answers.h"

namespace whirl_twin {

/// Writes the file; all blocks must be finished. Throws RunFailure if it cannot be written, or the
/// program was built without HDF5.
void writeHdf5Results(const Study& study, const ResultFolder& folder, const Answers& answers);

}  // namespace whirl_twin
