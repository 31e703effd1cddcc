// What the columns of a run are in. A name that ends in a unit, `q1[deg]`, as adapters of
// acquisition cards write it, says so; of others, numbers that cannot be in the unit that they are
// taken in are refused, and those that hardly can are remarked.
#pragma once

#include <string>
#include <vector>

#include "estimation/fit_study.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// Brings columns with a unit to those of the study's channels and inputs (unitScale()), and adds
/// remarks. Throws Refusal with what is wrong: a unit of
/// another kind, a time that is not in s, numbers that no machine shows.
void settleUnits(StudyRun& run, const std::string& time, const std::vector<InputInfo>& inputs,
                 double step_seconds);

/// Throws Refusal where nothing can be fitted to a run: windows [s] that hold hardly a row, and of
/// one to be fitted, measured columns that are one number each in all rows.
void requireUse(const StudyRun& run, double window);

}  // namespace whirl_twin
