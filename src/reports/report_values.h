// Text and JSON that several reports share: verdicts and margins, matrices, and which results lie
// beyond the speeds that a rotor's tables of bearings and pedestals cover, or are of a shaft too
// slow for the loads of its films. There the nearest row of a table is held, or the coefficients of
// a film at an eccentricity of 0.95, which nobody has measured or computed: such results are
// marked.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "analysis/routh.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "reports/figure.h"
#include "reports/output.h"
#include "reports/shown_units.h"

namespace whirl_twin {

/// A number for a report, or the text for one that is not defined (NaN).
std::string defined(double x, const char* undefined);

/// "asymptotically stable", "marginal: ..." and so on.
std::string verdictText(Verdict verdict);

/// Lines of a report: root counts and the first column of Routh's table.
std::string routhText(const RouthResult& routh);

/// Lines of a report. decay_rate [1/s]; a NaN is a margin that is not defined.
std::string marginsText(double decay_rate, double damping_ratio, double log_decrement);

/// What API 617 asks of a running speed beside a critical speed (analysis/separation_margin.h), and
/// what an amplification factor is: a line each.
std::vector<std::string> separationConditions();

/// As many coordinates are shown one by one, with their matrices.
inline constexpr int kFewCoordinates = 6;

/// Indented, the title before the first row; a zero matrix is one 0.
std::string matrixText(const char* title, const Eigen::MatrixXd& m);

/// [re, im]
Json complexJson(const std::complex<double>& z);
/// Null for "".
Json textOrNull(const std::string& text);
/// Negative zeros, of skew matrices and undamped modes, are zeros.
Json arrayJson(const std::vector<double>& x);
Json arrayJson(const Eigen::VectorXd& x);
/// Row by row.
Json matrixJson(const Eigen::MatrixXd& m);

/// Of numbers in SI units, with ends where the data end; `beside`: as a second scale.
ChartAxis tightAxis(const std::string& quantity, const ShownUnit& unit);
ChartAxis tightAxis(const std::string& quantity, const ShownUnit& unit, const ShownUnit& beside);
/// Of a lag in degrees: it falls, as machinists draw it.
ChartAxis lagAxis(const std::string& quantity, const ShownUnit& angle);

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
