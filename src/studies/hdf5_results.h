// A study's results in one HDF5 file, results.h5 of their folder: the tables, what they say
// together, and the texts they come of.
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
// Chunked and compressed by gzip. Nothing in it tells of time, place or workers.
#pragma once

#include <string>

#include "studies/answers.h"

namespace whirl_twin {

/// Writes it, of a folder all of whose blocks are there. Throws RunFailure where it cannot be
/// written, and where this program was built without HDF5.
void writeHdf5Results(const Study& study, const ResultFolder& folder, const Answers& answers);

}  // namespace whirl_twin
