#include "estimation/shooting_fit.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "estimation/equation_error.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

constexpr double kFirstWindow = 0.5;  // s: a model that is far off follows for so long
constexpr double kLonger = 3.0;       // from one stage to the next
constexpr int kIterations = 100;
constexpr int kStageIterations = 20;
constexpr int kStartIterations = 30;
constexpr double kTolerance = 1.0e-7;  // of the squares, in an iteration
constexpr double kParameterTolerance = 1.0e-10;
constexpr double kRoughly = 1.0e-6;
constexpr double kHeldTo = 1.0e-2;  // deviations along an untold direction, of its parts
constexpr int kMostThreads = 8;
constexpr double kAtBound = 1.0e-9;
constexpr double kUnusualEquation = 0.2;  // of usual accelerations
constexpr double kEquationChange = 1.0e-5;
constexpr double kEquationChangeOfZero = 1.0e-7;

struct Stage {
  std::vector<Window> windows;
  std::vector<Eigen::VectorXd> starts;
};

/// Beyond `huber` a residual counts linearly: as the square of what this makes of it.
void makeRobust(double huber, Eigen::VectorXd& residuals, Eigen::VectorXd& slope) {
  slope = Eigen::VectorXd::Ones(residuals.size());
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    const double size = std::fabs(residuals[i]);
    if (size > huber) {
      const double counted = std::sqrt(huber * (2.0 * size - huber));
      slope[i] = huber / counted;
      residuals[i] = std::copysign(counted, residuals[i]);
    }
  }
}

/// A window as Ceres sees it. Blocks: the unknowns, where there are any, and its start, where that
/// is found.
class WindowCost final : public ceres::CostFunction {
 public:
  WindowCost(const Shooting& shooting, const Window& window, const Eigen::VectorXd& given_start,
             bool unknowns)
      : shooting_(shooting), window_(window), given_start_(given_start), unknowns_(unknowns) {
    set_num_residuals(static_cast<int>(residualCount(shooting.study(), window)));
    if (unknowns_) {
      mutable_parameter_block_sizes()->push_back(static_cast<int>(shooting.unknowns()));
    }
    if (shooting.study().start_estimated) {
      mutable_parameter_block_sizes()->push_back(static_cast<int>(shooting.startSize()));
    }
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const std::size_t place = unknowns_ ? 1 : 0;
    const bool estimated = shooting_.study().start_estimated;
    const Eigen::VectorXd start = estimated ? Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
                                                  blocks[place], shooting_.startSize()))
                                            : given_start_;
    double* by_unknowns = jacobians != nullptr && unknowns_ ? jacobians[0] : nullptr;
    double* by_start = jacobians != nullptr && estimated ? jacobians[place] : nullptr;
    WindowDerivatives d;
    const bool arrived = by_unknowns != nullptr || by_start != nullptr
                             ? shooting_.derivatives(window_, start, by_unknowns != nullptr, d)
                             : shooting_.residuals(window_, start, d.residuals);
    if (!arrived) {
      return false;
    }
    Eigen::VectorXd slope = Eigen::VectorXd::Ones(d.residuals.size());
    if (shooting_.study().huber) {
      makeRobust(*shooting_.study().huber, d.residuals, slope);
    }
    Eigen::Map<Eigen::VectorXd>(residuals, d.residuals.size()) = d.residuals;
    if (by_unknowns != nullptr) {
      Eigen::Map<RowMajor>(by_unknowns, d.residuals.size(), shooting_.unknowns()) =
          slope.asDiagonal() * d.by_unknowns;
    }
    if (by_start != nullptr) {
      Eigen::Map<RowMajor>(by_start, d.residuals.size(), shooting_.startSize()) =
          slope.asDiagonal() * d.by_start;
    }
    return true;
  }

 private:
  const Shooting& shooting_;
  Window window_;
  Eigen::VectorXd given_start_;
  bool unknowns_;
};

/// The equation errors of the training runs.
class EquationCost final : public ceres::CostFunction {
 public:
  EquationCost(const EquationError& equations, const CandidateMaker& maker)
      : equations_(equations), maker_(maker) {
    set_num_residuals(static_cast<int>(equations.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(maker.unknowns().size()));
  }
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto n = static_cast<Eigen::Index>(maker_.unknowns().size());
    Eigen::VectorXd theta = Eigen::Map<const Eigen::VectorXd>(blocks[0], n);
    Eigen::VectorXd slope;
    try {
      Eigen::VectorXd here = equations_.residuals(maker_.at(theta));
      Eigen::MatrixXd by_unknowns(here.size(), jacobians != nullptr ? n : 0);
      for (Eigen::Index i = 0; i < by_unknowns.cols(); ++i) {
        const Unknown& unknown = maker_.unknowns()[static_cast<std::size_t>(i)];
        const double size = std::max(std::fabs(theta[i]), std::fabs(unknown.start));
        const double change = size > 0.0 ? kEquationChange * size : kEquationChangeOfZero;
        const double at = theta[i];
        const double above = std::min(at + change, unknown.most);
        const double below = std::max(at - change, unknown.least);
        theta[i] = above;
        by_unknowns.col(i) = equations_.residuals(maker_.at(theta));
        theta[i] = below;
        by_unknowns.col(i) -= equations_.residuals(maker_.at(theta));
        by_unknowns.col(i) /= above - below;
        theta[i] = at;
      }
      if (!here.allFinite() || !by_unknowns.allFinite()) {
        return false;
      }
      makeRobust(kUnusualEquation, here, slope);
      Eigen::Map<Eigen::VectorXd>(residuals, here.size()) = here;
      if (jacobians != nullptr && jacobians[0] != nullptr) {
        Eigen::Map<RowMajor>(jacobians[0], here.size(), n) = slope.asDiagonal() * by_unknowns;
      }
      return true;
    } catch (const Refusal&) {
      return false;
    }
  }

 private:
  const EquationError& equations_;
  const CandidateMaker& maker_;
};

/// Keeps the unknowns where they start along directions that runs do not tell.
class HeldDirections final : public ceres::CostFunction {
 public:
  /// `directions` [held x unknowns]: zero times (theta - start) is wanted.
  HeldDirections(Eigen::MatrixXd directions, Eigen::VectorXd start)
      : directions_(std::move(directions)), start_(std::move(start)) {
    set_num_residuals(static_cast<int>(directions_.rows()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(directions_.cols()));
  }
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Eigen::VectorXd> theta(blocks[0], start_.size());
    Eigen::Map<Eigen::VectorXd>(residuals, directions_.rows()) = directions_ * (theta - start_);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<RowMajor>(jacobians[0], directions_.rows(), directions_.cols()) = directions_;
    }
    return true;
  }

 private:
  Eigen::MatrixXd directions_;
  Eigen::VectorXd start_;
};

ceres::Solver::Options quiet(int iterations) {
  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = iterations;
  options.function_tolerance = kTolerance;
  options.parameter_tolerance = kParameterTolerance;
  options.gradient_tolerance = 0.0;
  return options;
}

class Solver final : public ceres::EvaluationCallback {
 public:
  explicit Solver(const FitStudy& study) : study_(study), maker_(study), shooting_(study, maker_) {
    theta_.resize(shooting_.unknowns());
    for (Eigen::Index i = 0; i < theta_.size(); ++i) {
      const Unknown& u = unknown(i);
      theta_[i] = std::clamp(u.start, u.least, u.most);
    }
    begin_ = theta_;
    maker_.at(theta_);  // refused in words, where the model cannot have them
  }

  const CandidateMaker& maker() const { return maker_; }
  const Eigen::VectorXd& theta() const { return theta_; }
  int iterations() const { return iterations_; }
  bool converged() const { return converged_; }

  /// Brings the unknowns to where the equations of motion hold along the runs, roughly.
  void regress() {
    const EquationError equations(study_, maker_);
    if (equations.empty()) {
      return;
    }
    ceres::Problem problem;
    problem.AddResidualBlock(new EquationCost(equations, maker_), nullptr, theta_.data());
    setBounds(problem);
    ceres::Solver::Options options = quiet(kIterations);
    options.function_tolerance = kRoughly;
    options.linear_solver_type = ceres::DENSE_QR;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    iterations_ += static_cast<int>(summary.iterations.size());
  }

  /// The windows of the runs that are trained on, or of one run.
  Stage stageOf(double length, std::optional<std::size_t> run) {
    Stage stage;
    shooting_.setPoint(theta_, false);
    for (std::size_t r = 0; r < study_.runs.size(); ++r) {
      if (run ? r == *run : study_.runs[r].train) {
        for (const Window& window : windowsOf(study_, r, length)) {
          stage.windows.push_back(window);
        }
      }
    }
    for (const Window& window : stage.windows) {
      stage.starts.push_back(measuredStart(study_, shooting_.candidate(), window));
    }
    return stage;
  }

  /// The starts alone, over longer and longer parts of their windows. False for a window that is
  /// not got through.
  std::vector<bool> findStarts(Stage& stage) {
    shooting_.setPoint(theta_, false);
    std::vector<bool> arrived(stage.windows.size(), true);
    for (std::size_t w = 0; w < stage.windows.size(); ++w) {
      for (const Window& part : growing(stage.windows[w])) {
        arrived[w] = !study_.start_estimated || findStart(part, stage.starts[w]);
      }
      Eigen::VectorXd residuals;
      arrived[w] = arrived[w] && shooting_.residuals(stage.windows[w], stage.starts[w], residuals);
    }
    return arrived;
  }

  /// Unknowns and starts together.
  void solve(Stage& stage, int iterations, const Eigen::MatrixXd& held) {
    shooting_.setPoint(theta_, false);
    shooting_.chooseDifferences(stage.windows, stage.starts);
    ceres::Problem::Options problem_options;
    problem_options.evaluation_callback = this;
    ceres::Problem problem(problem_options);
    const auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (std::size_t w = 0; w < stage.windows.size(); ++w) {
      auto* cost = new WindowCost(shooting_, stage.windows[w], stage.starts[w], true);
      if (study_.start_estimated) {
        problem.AddResidualBlock(cost, nullptr, theta_.data(), stage.starts[w].data());
        ordering->AddElementToGroup(stage.starts[w].data(), 0);
      } else {
        problem.AddResidualBlock(cost, nullptr, theta_.data());
      }
    }
    if (held.rows() > 0) {
      problem.AddResidualBlock(new HeldDirections(held, begin_), nullptr, theta_.data());
    }
    ordering->AddElementToGroup(theta_.data(), 1);
    setBounds(problem);
    ceres::Solver::Options options = quiet(iterations);
    options.num_threads =
        std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
    if (study_.start_estimated) {
      options.linear_solver_type = ceres::DENSE_SCHUR;
      options.linear_solver_ordering = ordering;
    } else {
      options.linear_solver_type = ceres::DENSE_QR;
    }
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    iterations_ += static_cast<int>(summary.iterations.size());
    converged_ = summary.termination_type == ceres::CONVERGENCE;
    if (summary.termination_type == ceres::FAILURE) {
      throw RunFailure(fmt::format("{}: the fit failed: {}", study_.source, summary.message));
    }
  }

  NormalEquations normalEquations(const Stage& stage) {
    NormalEquations normal;
    shooting_.setPoint(theta_, true);
    for (std::size_t w = 0; w < stage.windows.size(); ++w) {
      WindowDerivatives d;
      if (shooting_.derivatives(stage.windows[w], stage.starts[w], true, d)) {
        if (study_.huber) {
          Eigen::VectorXd slope;
          makeRobust(*study_.huber, d.residuals, slope);
          d.by_unknowns = slope.asDiagonal() * d.by_unknowns;
          d.by_start = slope.asDiagonal() * d.by_start;
        }
        normal.add(d);
      }
    }
    return normal;
  }

  /// Predicted states of a stage's window; NaN where it is not got through.
  Eigen::MatrixXd states(const Stage& stage, std::size_t w) {
    Eigen::MatrixXd states;
    const Window& window = stage.windows[w];
    const Eigen::VectorXd start = study_.start_estimated
                                      ? stage.starts[w]
                                      : measuredStart(study_, shooting_.candidate(), window);
    if (!predict(study_, maker_.scene(), shooting_.candidate(), window, start, states)) {
      states.setConstant(shooting_.startSize(), static_cast<Eigen::Index>(window.count),
                         std::numeric_limits<double>::quiet_NaN());
    }
    return states;
  }
  const Candidate& candidate() const { return shooting_.candidate(); }

  void PrepareForEvaluation(bool derivatives, bool new_point) override {
    // Where the model cannot have such parameters, no window is got through.
    if (new_point || derivatives) {
      shooting_.setPoint(theta_, derivatives);
    }
  }

 private:
  const Unknown& unknown(Eigen::Index i) const {
    return maker_.unknowns()[static_cast<std::size_t>(i)];
  }

  void setBounds(ceres::Problem& problem) {
    for (Eigen::Index i = 0; i < theta_.size(); ++i) {
      if (std::isfinite(unknown(i).least)) {
        problem.SetParameterLowerBound(theta_.data(), static_cast<int>(i), unknown(i).least);
      }
      if (std::isfinite(unknown(i).most)) {
        problem.SetParameterUpperBound(theta_.data(), static_cast<int>(i), unknown(i).most);
      }
    }
  }

  std::vector<Window> growing(const Window& window) const {
    const std::vector<double>& time = study_.runs[window.run].data.time;
    std::vector<Window> parts;
    double length = kFirstWindow;
    for (std::size_t count = 2; count < window.count; ++count) {
      if (time[window.first + count] - time[window.first] > length) {
        parts.push_back({window.run, window.first, count});
        length *= kLonger;
      }
    }
    parts.push_back(window);
    return parts;
  }

  bool findStart(const Window& window, Eigen::VectorXd& start) {
    ceres::Problem problem;
    problem.AddResidualBlock(new WindowCost(shooting_, window, start, false), nullptr,
                             start.data());
    ceres::Solver::Options options = quiet(kStartIterations);
    options.linear_solver_type = ceres::DENSE_QR;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return summary.IsSolutionUsable();
  }

  const FitStudy& study_;
  CandidateMaker maker_;
  Shooting shooting_;
  Eigen::VectorXd theta_, begin_;
  int iterations_ = 0;
  bool converged_ = true;
};

/// From short windows to those of the study.
std::vector<double> stageLengths(const FitStudy& study) {
  double longest = 0.0;
  for (const StudyRun& run : study.runs) {
    longest = std::max(longest, run.data.duration());
  }
  std::vector<double> lengths;
  for (double length = kFirstWindow; length < std::min(study.window, longest); length *= kLonger) {
    lengths.push_back(length);
  }
  lengths.push_back(study.window);
  return lengths;
}

void requireArrival(const FitStudy& study, const Stage& stage, const std::vector<bool>& arrived) {
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
      const double size =
          std::max(std::fabs(theta[i]), std::fabs(unknowns[static_cast<std::size_t>(i)].start));
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

std::vector<FittedRun> predictedRuns(const FitStudy& study, Solver& solver,
                                     const FitProgress& progress) {
  std::vector<FittedRun> runs;
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    Stage stage = solver.stageOf(study.window, r);
    solver.findStarts(stage);
    FittedRun run;
    for (std::size_t w = 0; w < stage.windows.size(); ++w) {
      const Eigen::MatrixXd states = solver.states(stage, w);
      run.window_starts.push_back(run.states.cols());
      run.states.conservativeResize(states.rows(), run.states.cols() + states.cols());
      run.states.rightCols(states.cols()) = states;
    }
    measure(study, solver.candidate(), r, run);
    runs.push_back(std::move(run));
    progress(static_cast<int>(r + 1), static_cast<int>(study.runs.size()));
  }
  return runs;
}

}  // namespace

ShootingFit fitByShooting(const FitStudy& study, const FitProgress& progress) {
  Solver solver(study);
  ShootingFit fit;
  fit.unknowns = solver.maker().unknowns();
  const Eigen::Index n = solver.theta().size();
  fit.theta = solver.theta();
  if (n > 0) {
    solver.regress();
    Stage stage;
    for (const double length : stageLengths(study)) {
      stage = solver.stageOf(length, std::nullopt);
      requireArrival(study, stage, solver.findStarts(stage));
      solver.solve(stage, length == study.window ? kIterations : kStageIterations,
                   Eigen::MatrixXd(0, n));
    }
    NormalEquations normal = solver.normalEquations(stage);
    fit.information = information(normal, fit.unknowns, solver.theta());
    // Twice: directions turn a little on the way.
    for (int pass = 0; pass < 2 && !fit.information.untold.empty(); ++pass) {
      solver.solve(stage, kIterations,
                   heldDirections(fit.information, fit.unknowns, solver.theta(),
                                  std::sqrt(normal.variance())));
      normal = solver.normalEquations(stage);
      Information there = information(normal, fit.unknowns, solver.theta());
      if (there.untold.size() >= fit.information.untold.size()) {
        fit.information = std::move(there);  // of where they are held now
      }
    }
    fit.theta = solver.theta();
    fit.rms = std::sqrt(normal.squares / static_cast<double>(normal.residuals));
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const Unknown& u = fit.unknowns[static_cast<std::size_t>(i)];
    const double near = kAtBound * std::max(std::fabs(fit.theta[i]), std::fabs(u.start));
    fit.at_bound.push_back(fit.theta[i] - u.least <= near || u.most - fit.theta[i] <= near);
  }
  fit.runs = predictedRuns(study, solver, progress);
  fit.system = solver.candidate().system;
  fit.iterations = solver.iterations();
  fit.converged = solver.converged();
  return fit;
}

}  // namespace whirl_twin
