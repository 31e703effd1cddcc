#include "estimation/shooting_solver.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>
#include <utility>

#include "estimation/shooting_costs.h"
#include "messages/input_error.h"

namespace whirl_twin {

DistanceFromStart::DistanceFromStart(Eigen::VectorXd start, Eigen::VectorXd sizes,
                                     std::vector<Range> ranges)
    : start_(std::move(start)), sizes_(std::move(sizes)), ranges_(std::move(ranges)) {}

bool DistanceFromStart::byTimes(Eigen::Index i, double value) const {
  switch (ranges_[static_cast<std::size_t>(i)]) {
    case Range::kPositive:
      return true;
    case Range::kNotNegative:
      return value > start_[i];
    default:
      return false;
  }
}

double DistanceFromStart::of(Eigen::Index i, double value) const {
  return byTimes(i, value) ? std::log(value / start_[i]) : (value - start_[i]) / sizes_[i];
}

double DistanceFromStart::slope(Eigen::Index i, double value) const {
  return 1.0 / (byTimes(i, value) ? value : sizes_[i]);
}

HeldCost::HeldCost(Eigen::MatrixXd rows, const DistanceFromStart& distance)
    : rows_(std::move(rows)), distance_(distance) {
  mutable_parameter_block_sizes()->push_back(static_cast<int>(rows_.cols()));
  set_num_residuals(static_cast<int>(rows_.rows()));
}

bool HeldCost::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  Eigen::VectorXd away(rows_.cols());
  Eigen::VectorXd slopes(rows_.cols());
  for (Eigen::Index i = 0; i < away.size(); ++i) {
    away[i] = distance_.of(i, blocks[0][i]);
    slopes[i] = distance_.slope(i, blocks[0][i]);
  }
  Eigen::Map<Eigen::VectorXd>(residuals, rows_.rows()) = rows_ * away;
  if (jacobians != nullptr && jacobians[0] != nullptr) {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor>(jacobians[0], rows_.rows(), rows_.cols()) = rows_ * slopes.asDiagonal();
  }
  return true;
}

namespace {

constexpr int kIterations = 100;
constexpr int kStageIterations = 20;
constexpr int kStartIterations = 30;
constexpr double kTolerance = 1.0e-7;  // relative change of the squares per iteration
constexpr double kParameterTolerance = 1.0e-10;
constexpr double kRoughly = 1.0e-6;
constexpr int kMaxThreads = 8;
constexpr int kRegressions = 2;
constexpr double kSurelyPersistent = 5.0;  // standard deviations of a white autocorrelation
constexpr double kMaxPersistent = 0.9999;
/// Smallest size of a start value, relative to the change that moves the prediction by the whole
/// measured signal.
constexpr double kMinSize = 1.0e-4;

ceres::Solver::Options quiet(int iterations) {
  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = iterations;
  options.function_tolerance = kTolerance;
  options.parameter_tolerance = kParameterTolerance;
  options.gradient_tolerance = 0.0;
  return options;
}

/// The end of a solution is reported in terms of the study; silences Ceres' own log messages to
/// glog, which has one level per process.
class QuietLog {
 public:
  QuietLog() { FLAGS_minloglevel = google::GLOG_FATAL; }
  ~QuietLog() { FLAGS_minloglevel = before_; }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;

 private:
  const int before_ = FLAGS_minloglevel;
};

ceres::Solver::Summary solved(ceres::Problem& problem, const ceres::Solver::Options& options) {
  const QuietLog quiet_log;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

}  // namespace

ShootingSolver::ShootingSolver(const FitStudy& study, CandidateMaker maker)
    : study_(study), maker_(std::move(maker)), shooting_(study, maker_) {
  theta_.resize(shooting_.unknowns());
  for (Eigen::Index i = 0; i < theta_.size(); ++i) {
    const Unknown& u = unknown(i);
    theta_[i] = std::clamp(u.start, u.least, u.most);
  }
  maker_.at(theta_);  // throws InputError if they are invalid
}

void ShootingSolver::findSizes(const ShootingStage& stage) {
  shooting_.setPoint(theta_, false);
  shooting_.chooseDifferences(stage.windows, stage.starts);
  Eigen::VectorXd sizes = theta_.cwiseAbs();
  std::vector<Range> ranges;
  for (Eigen::Index i = 0; i < sizes.size(); ++i) {
    const double moving = shooting_.movingAll()[i];
    sizes[i] = std::max(sizes[i], sizes[i] > 0.0 ? kMinSize * moving : moving);
    if (sizes[i] == 0.0) {
      sizes[i] = 1.0;  // without effect
    }
    const bool any = unknown(i).least < 0.0 || theta_[i] != sizes[i];
    ranges.push_back(any                       ? Range::kAny
                     : unknown(i).least == 0.0 ? Range::kNotNegative
                                               : Range::kPositive);
  }
  distance_ = DistanceFromStart(theta_, std::move(sizes), std::move(ranges));
}

Eigen::MatrixXd ShootingSolver::aboutStart(double deviation) const {
  return deviation * Eigen::MatrixXd::Identity(theta_.size(), theta_.size());
}

void ShootingSolver::regress() {
  const EquationError equations(study_, maker_);
  if (equations.empty()) {
    return;
  }
  for (int pass = 0; pass < kRegressions; ++pass) {
    const double deviation =
        std::sqrt(equations.residuals(maker_.at(theta_)).array().square().mean());
    ceres::Problem problem;
    problem.AddResidualBlock(new EquationCost(equations, maker_), nullptr, theta_.data());
    hold(problem, aboutStart(deviation));
    setBounds(problem);
    ceres::Solver::Options options = quiet(kIterations);
    options.function_tolerance = kRoughly;
    options.linear_solver_type = ceres::DENSE_QR;
    const ceres::Solver::Summary summary = solved(problem, options);
    iterations_ += static_cast<int>(summary.iterations.size());
  }
}

ShootingStage ShootingSolver::stageOf(double length, std::optional<std::size_t> run) {
  ShootingStage stage;
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

std::vector<bool> ShootingSolver::findStarts(ShootingStage& stage) {
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

void ShootingSolver::solve(ShootingStage& stage, bool thorough, const Eigen::MatrixXd& held) {
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
  hold(problem, held);
  ordering->AddElementToGroup(theta_.data(), 1);
  setBounds(problem);
  ceres::Solver::Options options = quiet(thorough ? kIterations : kStageIterations);
  options.num_threads =
      std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMaxThreads);
  if (study_.start_estimated) {
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.linear_solver_ordering = ordering;
  } else {
    options.linear_solver_type = ceres::DENSE_QR;
  }
  const ceres::Solver::Summary summary = solved(problem, options);
  iterations_ += static_cast<int>(summary.iterations.size());
  converged_ = summary.termination_type == ceres::CONVERGENCE;
  if (summary.termination_type == ceres::FAILURE) {
    throw RunFailure(fmt::format("{}: the fit failed: {}", study_.source, summary.message));
  }
  shooting_.setPoint(theta_, false);
}

NormalEquations ShootingSolver::normalEquations(const ShootingStage& stage) {
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

Eigen::MatrixXd ShootingSolver::states(const ShootingStage& stage, std::size_t w) {
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

void ShootingSolver::PrepareForEvaluation(bool derivatives, bool new_point) {
  // If the parameters are invalid for the model, every window fails.
  if (new_point || derivatives) {
    shooting_.setPoint(theta_, derivatives);
  }
}

void ShootingSolver::hold(ceres::Problem& problem, const Eigen::MatrixXd& held) {
  if (held.rows() > 0) {
    problem.AddResidualBlock(new HeldCost(held, distance_), nullptr, theta_.data());
  }
}

LeftOver ShootingSolver::leftOver(const ShootingStage& stage) const {
  double squares = 0.0, products = 0.0, rows = 0.0, free = -static_cast<double>(theta_.size());
  Eigen::Index longest = 1;
  for (std::size_t w = 0; w < stage.windows.size(); ++w) {
    Eigen::VectorXd residuals, slope;
    if (!shooting_.residuals(stage.windows[w], stage.starts[w], residuals)) {
      continue;
    }
    if (study_.huber) {
      makeRobust(*study_.huber, residuals, slope);
    }
    rows += static_cast<double>(residuals.size());
    free += static_cast<double>(residuals.size());
    free -= study_.start_estimated ? static_cast<double>(shooting_.startSize()) : 0.0;
    squares += residuals.squaredNorm();
    const auto count = static_cast<Eigen::Index>(stage.windows[w].count);
    longest = std::max(longest, count);
    for (Eigen::Index first = 0; first < residuals.size(); first += count) {
      products += residuals.segment(first, count - 1).dot(residuals.segment(first + 1, count - 1));
    }
  }
  LeftOver left;
  left.deviation = std::sqrt(squares / std::max(1.0, free));
  const double persistence = squares > 0.0 ? products / squares : 0.0;
  if (persistence * std::sqrt(rows) > kSurelyPersistent) {
    left.rows_alike = std::min((1.0 + persistence) / (1.0 - std::min(persistence, kMaxPersistent)),
                               static_cast<double>(longest));
  }
  return left;
}

void ShootingSolver::setBounds(ceres::Problem& problem) {
  for (Eigen::Index i = 0; i < theta_.size(); ++i) {
    if (std::isfinite(unknown(i).least)) {
      problem.SetParameterLowerBound(theta_.data(), static_cast<int>(i), unknown(i).least);
    }
    if (std::isfinite(unknown(i).most)) {
      problem.SetParameterUpperBound(theta_.data(), static_cast<int>(i), unknown(i).most);
    }
  }
}

std::vector<Window> ShootingSolver::growing(const Window& window) const {
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

bool ShootingSolver::findStart(const Window& window, Eigen::VectorXd& start) {
  ceres::Problem problem;
  problem.AddResidualBlock(new WindowCost(shooting_, window, start, false), nullptr, start.data());
  ceres::Solver::Options options = quiet(kStartIterations);
  options.linear_solver_type = ceres::DENSE_QR;
  return solved(problem, options).IsSolutionUsable();
}

}  // namespace whirl_twin
