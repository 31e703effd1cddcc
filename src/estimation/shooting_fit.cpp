#include "estimation/shooting_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/dense.h"
#include "estimation/shooting_solver.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr double kHeldTo = 1.0e-2;  // standard deviations along a fixed direction, relative
constexpr double kStays = 0.9;      // ratio of residuals: no further gain
constexpr int kMaxFixed = 4;
constexpr int kMaxTurns = 6;
constexpr double kAtBound = 1.0e-9;
constexpr double kFirstRows = 10.0;  // in the shortest windows

/// Window lengths of the stages, from short ones to that of the study.
std::vector<double> stageLengths(const FitStudy& study) {
  double longest = 0.0, usual = 0.0;
  for (const StudyRun& run : study.runs) {
    longest = std::max(longest, run.data.duration());
    usual = std::max(usual, run.data.usualStep());
  }
  std::vector<double> lengths;
  for (double length = std::max(ShootingSolver::kFirstWindow, kFirstRows * usual);
       length < std::min(study.window, longest); length *= ShootingSolver::kLonger) {
    lengths.push_back(length);
  }
  lengths.push_back(study.window);
  return lengths;
}

void requireArrival(const FitStudy& study, const ShootingStage& stage,
                    const std::vector<bool>& arrived) {
  for (std::size_t w = 0; w < arrived.size(); ++w) {
    if (!arrived[w]) {
      const StudyRun& run = study.runs[stage.windows[w].run];
      throw RunFailure(
          fmt::format("{}: {}: with the start values of the parameters the motion stops in the "
                      "window from {:.6g} s: use better start values, or shorter windows",
                      study.source, run.file, run.data.time[stage.windows[w].first]));
    }
  }
}

/// Rows of a HeldCost that keep the unknowns at their start values in unidentifiable directions.
Eigen::MatrixXd heldDirections(const Information& information, const Eigen::VectorXd& sizes,
                               const ShootingSolver& solver, double deviation) {
  const auto count = static_cast<Eigen::Index>(information.unidentifiable.size());
  Eigen::MatrixXd directions(sizes.size(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::VectorXd& parts = information.unidentifiable[static_cast<std::size_t>(k)].parts;
    for (Eigen::Index i = 0; i < sizes.size(); ++i) {
      directions(i, k) = parts[i] * sizes[i] * solver.distance().slope(i, solver.theta()[i]);
    }
  }
  // Orthonormal basis: nearly parallel directions would otherwise leave their difference free.
  const Eigen::MatrixXd across = orthonormalBasis(directions);
  return deviation / kHeldTo * across.transpose();
}

/// Fits unknowns and starts in the last stage. Unidentifiable directions must be known before they
/// can be fixed, and a free solution diverges along them to where they become identifiable.
/// Therefore all unknowns are first fixed softly about their start values, each with a standard
/// deviation of its size. Then the identifiable ones are released, since they would be biased.
Information settle(ShootingSolver& solver, ShootingStage& stage) {
  LeftOver left = solver.leftOver(stage);
  for (int pass = 0; pass < kMaxFixed; ++pass) {
    const double before = left.deviation;
    solver.solve(stage, true, solver.aboutStart(left.deviationAlone()));
    left = solver.leftOver(stage);
    if (left.deviation > kStays * before) {
      break;
    }
  }
  const auto sizesHere = [&] {
    return Eigen::VectorXd(solver.distance().sizes().cwiseMax(solver.theta().cwiseAbs()));
  };
  Eigen::VectorXd sizes = sizesHere();
  Information result =
      information(solver.normalEquations(stage), solver.theta(), sizes, left.rows_alike);
  // Directions rotate during the iteration; sizes are those of the current point.
  for (int pass = 0; pass < kMaxTurns; ++pass) {
    solver.solve(stage, true, heldDirections(result, sizes, solver, left.deviationAlone()));
    left = solver.leftOver(stage);
    const Eigen::VectorXd now = sizesHere();
    const bool same = (now - sizes).cwiseQuotient(sizes).cwiseAbs().maxCoeff() < kHeldTo;
    sizes = now;
    Information there =
        information(solver.normalEquations(stage), solver.theta(), sizes, left.rows_alike);
    const bool held = there.unidentifiable.size() <= result.unidentifiable.size();
    if (there.unidentifiable.size() >= result.unidentifiable.size()) {
      result = std::move(there);  // of the current fixed directions
    }
    if (result.unidentifiable.empty() || (same && held)) {
      break;
    }
  }
  return result;
}

void measure(const FitStudy& study, const Candidate& candidate, std::size_t r, FittedRun& run) {
  run.channels = candidate.runs[r].measured;
  for (const MeasuredChannel& c : run.channels) {
    const std::vector<double>& column = study.runs[r].data.column(c.column);
    double squares = 0.0, products = 0.0;
    double before = 0.0;
    for (std::size_t k = 0; k < column.size(); ++k) {
      const double rest = column[k] - c.offset.value -
                          c.scale.value * run.states(static_cast<Eigen::Index>(c.state),
                                                     static_cast<Eigen::Index>(k));
      squares += rest * rest;
      products += rest * before;
      before = rest;
    }
    run.rms.push_back(std::sqrt(squares / static_cast<double>(column.size())));
    run.persistence.push_back(squares > 0.0 ? products / squares : 0.0);
  }
}

FittedRun predictedRun(const FitStudy& study, ShootingSolver& solver, const ShootingStage& stage,
                       std::size_t r) {
  FittedRun run;
  for (std::size_t w = 0; w < stage.windows.size(); ++w) {
    const Eigen::MatrixXd states = solver.states(stage, w);
    run.states.conservativeResize(states.rows(), run.states.cols() + states.cols());
    run.states.rightCols(states.cols()) = states;
  }
  measure(study, solver.candidate(), r, run);
  for (Eigen::Index i = 0; i < solver.theta().size(); ++i) {
    const Unknown& u = solver.maker().unknowns()[static_cast<std::size_t>(i)];
    if (u.run == r) {
      run.own.emplace_back(u, solver.theta()[i]);
    }
  }
  return run;
}

/// A run with the fitted starts of its windows, and with its own sensor numbers if these have not
/// been fitted yet.
FittedRun predictedRun(const FitStudy& study, ShootingSolver& solver, std::size_t r) {
  ShootingStage stage = solver.stageOf(study.window, r);
  const std::vector<bool> arrived = solver.findStarts(stage);
  if (!study.runs[r].train || study.validate_only) {
    CandidateMaker maker = solver.maker().ofRun(r, solver.theta());
    if (!maker.unknowns().empty() &&
        std::all_of(arrived.begin(), arrived.end(), [](bool there) { return there; })) {
      ShootingSolver own(study, std::move(maker));
      own.findSizes(stage);
      settle(own, stage);
      return predictedRun(study, own, stage, r);
    }
  }
  return predictedRun(study, solver, stage, r);
}

}  // namespace

ShootingFit fitByShooting(const FitStudy& study, const FitProgress& progress) {
  ShootingSolver solver(study);
  ShootingFit fit;
  fit.unknowns = solver.maker().unknowns();
  const Eigen::Index n = solver.theta().size();
  const std::vector<double> lengths = n > 0 ? stageLengths(study) : std::vector<double>();
  const int parts = static_cast<int>(lengths.size() + study.runs.size());
  int done = 0;
  if (n > 0) {
    ShootingStage stage = solver.stageOf(lengths.front(), std::nullopt);
    solver.findSizes(stage);
    solver.regress();
    for (const double length : lengths) {
      stage = solver.stageOf(length, std::nullopt);
      requireArrival(study, stage, solver.findStarts(stage));
      if (length == study.window) {
        fit.information = settle(solver, stage);
      } else {
        solver.solve(stage, false, solver.aboutStart(solver.leftOver(stage).deviationAlone()));
      }
      progress(++done, parts);
    }
  }
  fit.theta = solver.theta();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Unknown& u = fit.unknowns[static_cast<std::size_t>(i)];
    const double near = kAtBound * u.size(fit.theta[i]);
    fit.at_bound.push_back(fit.theta[i] - u.least <= near || u.most - fit.theta[i] <= near);
  }
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    fit.runs.push_back(predictedRun(study, solver, r));
    progress(++done, parts);
  }
  fit.iterations = solver.iterations();
  fit.converged = solver.converged();
  return fit;
}

}  // namespace whirl_twin
