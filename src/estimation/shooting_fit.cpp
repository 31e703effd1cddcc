#include "estimation/shooting_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "estimation/shooting_solver.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

constexpr double kHeldTo = 1.0e-2;  // deviations along an untold direction, of its parts
constexpr double kAtBound = 1.0e-9;
constexpr double kFirstRows = 10.0;  // that the shortest windows have

/// From short windows to those of the study.
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
      throw RunFailure(fmt::format(
          "{}: {}: the motion does not get through the window from {:.6g} s on with the "
          "parameters as they start: give values nearer to the machine's, or shorter windows",
          study.source, run.file, run.data.time[stage.windows[w].first]));
    }
  }
}

/// Rows that hold what runs do not tell, in the unknowns themselves.
Eigen::MatrixXd heldDirections(const Information& information, const std::vector<Unknown>& unknowns,
                               const Eigen::VectorXd& theta, double deviation) {
  Eigen::MatrixXd held(static_cast<Eigen::Index>(information.untold.size()), theta.size());
  for (Eigen::Index k = 0; k < held.rows(); ++k) {
    const Eigen::VectorXd& parts = information.untold[static_cast<std::size_t>(k)].parts;
    for (Eigen::Index i = 0; i < theta.size(); ++i) {
      const double size = unknowns[static_cast<std::size_t>(i)].size(theta[i]);
      held(k, i) = size > 0.0 ? parts[i] / size : parts[i];
    }
    held.row(k) *= deviation / (kHeldTo * parts.norm());
  }
  return held;
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

/// A run with the starts of its windows, and with what it has for itself where that is not found
/// yet.
FittedRun predictedRun(const FitStudy& study, ShootingSolver& solver, std::size_t r) {
  ShootingStage stage = solver.stageOf(study.window, r);
  const std::vector<bool> arrived = solver.findStarts(stage);
  if (!study.runs[r].train || study.validate_only) {
    CandidateMaker maker = solver.maker().ofRun(r, solver.theta());
    if (!maker.unknowns().empty() &&
        std::all_of(arrived.begin(), arrived.end(), [](bool there) { return there; })) {
      ShootingSolver own(study, std::move(maker));
      own.solve(stage, true, Eigen::MatrixXd(0, own.theta().size()));
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
    solver.regress();
    ShootingStage stage;
    for (const double length : lengths) {
      stage = solver.stageOf(length, std::nullopt);
      requireArrival(study, stage, solver.findStarts(stage));
      solver.solve(stage, length == study.window, Eigen::MatrixXd(0, n));
      progress(++done, parts);
    }
    NormalEquations normal = solver.normalEquations(stage);
    fit.information = information(normal, fit.unknowns, solver.theta());
    // Twice: directions turn a little on the way.
    for (int pass = 0; pass < 2 && !fit.information.untold.empty(); ++pass) {
      solver.solve(stage, true,
                   heldDirections(fit.information, fit.unknowns, solver.theta(),
                                  std::sqrt(normal.variance())));
      normal = solver.normalEquations(stage);
      Information there = information(normal, fit.unknowns, solver.theta());
      if (there.untold.size() >= fit.information.untold.size()) {
        fit.information = std::move(there);  // of where they are held now
      }
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
