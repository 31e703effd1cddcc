// Which results lie beyond the speeds that a rotor's tables of bearings and pedestals cover, or are
// of a shaft too slow for the loads that its films have. There the nearest row of a table is held,
// or the coefficients of a film at an eccentricity of 0.95, which nobody has measured or computed:
// such results are a guess, and are marked.
#pragma once

#include <string>
#include <vector>

#include "mechanics/rotors/rotor_assembly.h"
#include "plots/chart.h"
#include "reports/output.h"

namespace whirl_twin {

/// Behind a row of text: "" within the tables.
std::string beyondMark(const DataSpeeds& tables, double speed);

/// "beyond the tables" or "beyond the films".
std::string beyondName(const DataSpeeds& tables);
/// "beyond the tables of bearings and pedestals, which cover 10 to 90 rad/s (100 to 900 rpm): the
/// nearest row is held, a guess".
std::string beyondText(const DataSpeeds& tables);
/// A line of text where some speed from `from` to `to` [rad/s] is beyond the tables, else "".
std::string beyondLine(const DataSpeeds& tables, double from, double to);

/// [from, to] in rad/s, null where the rotor has no tables.
Json tableSpeedsJson(const DataSpeeds& tables);
/// Of each speed, whether it is beyond.
Json beyondJson(const DataSpeeds& tables, const std::vector<double>& speeds);

/// Shades what of a chart over the speeds `from` to `to` [rad/s] is beyond.
void shadeBeyond(const DataSpeeds& tables, double from, double to, bool named, Chart& chart);

}  // namespace whirl_twin
