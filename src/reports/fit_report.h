// What `twin fit` has found, as text, JSON, pictures and a scene.
#pragma once

#include <string>

#include "estimation/shooting_fit.h"
#include "reports/csv_table.h"
#include "reports/figure.h"

namespace whirl_twin {

/// What is odd about the runs of a study, with their rows.
std::string checkText(const FitStudy& study);
Json checkJson(const FitStudy& study);

std::string text(const FitStudy& study, const ShootingFit& fit);
Json json(const FitStudy& study, const ShootingFit& fit);
/// The parameters.
CsvTables tables(const ShootingFit& fit);

/// A run: measured and predicted over time, what is left between them, and its spectrum.
Figure figure(const FitStudy& study, const ShootingFit& fit, std::size_t run);

/// The study's scene with the values that were found, and what is known of them in comments; paths
/// of tables count from `folder`, where it is to be.
std::string fittedScene(const FitStudy& study, const ShootingFit& fit, const std::string& folder);

}  // namespace whirl_twin
