#include "estimation/shooting_costs.h"

#include <algorithm>
#include <cmath>

#include "algebra/dense.h"
#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr double kReach = 0.025;          // s, to either side
constexpr std::size_t kMinToASide = 4;    // rows
constexpr std::size_t kMaxPoints = 3000;  // of a study

/// Least-squares quadratic: value, slope and second derivative at the middle row.
Eigen::Vector3d quadratic(const Eigen::MatrixX3d& powers, double width, const double* values) {
  const Eigen::Map<const Eigen::VectorXd> y(values, powers.rows());
  const Eigen::Vector3d c = PivotedQr(powers).solve(y);
  return {c[0], c[1] / width, 2.0 * c[2] / (width * width)};
}

bool measuresAll(const StudyRun& run, std::size_t dof) {
  for (std::size_t i = 0; i < dof; ++i) {
    if (std::none_of(run.measured.begin(), run.measured.end(),
                     [&](const MeasuredChannel& c) { return c.state == i; })) {
      return false;
    }
  }
  return true;
}

}  // namespace

EquationError::EquationError(const FitStudy& study, const CandidateMaker& maker)
    : study_(study), maker_(maker) {
  const std::size_t dof = study.spec().q.size();
  std::size_t rows = 0;
  for (const StudyRun& run : study.runs) {
    rows += run.train && measuresAll(run, dof) ? run.data.time.size() : 0;
  }
  const std::size_t stride = std::max<std::size_t>(1, rows / kMaxPoints);
  std::vector<std::vector<double>> sizes(dof);
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    const StudyRun& run = study.runs[r];
    const std::vector<double>& time = run.data.time;
    if (!run.train || !measuresAll(run, dof)) {
      continue;
    }
    for (std::size_t k = kMinToASide; k + kMinToASide < time.size(); k += stride) {
      std::size_t from = k - kMinToASide, to = k + kMinToASide;
      while (from > 0 && time[k] - time[from - 1] <= kReach) {
        --from;
      }
      while (to + 1 < time.size() && time[to + 1] - time[k] <= kReach) {
        ++to;
      }
      const double width = std::max(time[k] - time[from], time[to] - time[k]);
      Eigen::MatrixX3d powers(static_cast<Eigen::Index>(to - from + 1), 3);
      for (std::size_t i = from; i <= to; ++i) {
        const double x = (time[i] - time[k]) / width;
        powers.row(static_cast<Eigen::Index>(i - from)) << 1.0, x, x * x;
      }
      Point point{r, time[k], Eigen::MatrixX3d(static_cast<Eigen::Index>(run.measured.size()), 3),
                  Eigen::VectorXd(static_cast<Eigen::Index>(run.inputs.size()))};
      for (std::size_t c = 0; c < run.measured.size(); ++c) {
        const Eigen::Vector3d fit =
            quadratic(powers, width, run.data.column(run.measured[c].column).data() + from);
        point.measured.row(static_cast<Eigen::Index>(c)) = fit;
        if (run.measured[c].state < dof) {
          sizes[run.measured[c].state].push_back(std::fabs(fit[2]));
        }
      }
      for (std::size_t i = 0; i < run.inputs.size(); ++i) {
        point.inputs[static_cast<Eigen::Index>(i)] =
            quadratic(powers, width, run.data.column(run.inputs[i].column).data() + from)[0];
      }
      points_.push_back(std::move(point));
    }
  }
  usual_ = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(dof));
  for (std::size_t i = 0; i < dof && !points_.empty(); ++i) {
    const auto middle = sizes[i].begin() + static_cast<std::ptrdiff_t>(sizes[i].size() / 2);
    std::nth_element(sizes[i].begin(), middle, sizes[i].end());
    usual_[static_cast<Eigen::Index>(i)] = *middle > 0.0 ? *middle : 1.0;
  }
}

Eigen::Index EquationError::size() const {
  return static_cast<Eigen::Index>(points_.size()) * usual_.size();
}

Eigen::VectorXd EquationError::residuals(const Candidate& candidate) const {
  const Dynamics& dynamics = *candidate.system->dynamics;
  const Eigen::Index dof = usual_.size();
  const std::vector<InputInfo> infos = dynamics.inputs();
  Drive drive = maker_.scene().driveOf(*candidate.system);
  Eigen::VectorXd all(size());
  Eigen::Index at = 0;
  for (const Point& point : points_) {
    const StudyRun& run = candidate.runs[point.run];
    Eigen::VectorXd q(dof), v(dof), a(dof);
    for (std::size_t c = 0; c < run.measured.size(); ++c) {
      const MeasuredChannel& channel = run.measured[c];
      const auto i = static_cast<Eigen::Index>(channel.state);
      if (i < dof) {
        const auto row = point.measured.row(static_cast<Eigen::Index>(c)) / channel.scale.value;
        q[i] = row[0] - channel.offset.value / channel.scale.value;
        v[i] = row[1];
        a[i] = row[2];
      }
    }
    drive.begin(std::llround(point.time * 1.0e9));
    const ShaftMotion shaft = drive.at(0.0);
    EvaluationPoint<double> moment{};
    moment.time = point.time;
    moment.angle = shaft.angle;
    moment.speed = shaft.speed;
    moment.acceleration = shaft.acceleration;
    Eigen::VectorXd predicted = dynamics.acceleration(q, v, moment);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(dof);
    for (std::size_t i = 0; i < run.inputs.size(); ++i) {
      const MeasuredInput& input = run.inputs[i];
      force +=
          (input.scale.value * point.inputs[static_cast<Eigen::Index>(i)] + input.offset.value) *
          infos[input.place].direction;
    }
    if (!force.isZero(0.0)) {
      predicted += Ldlt(dynamics.massMatrix(q, v, moment)).solve(force);
    }
    all.segment(at, dof) = (a - predicted).cwiseQuotient(usual_);
    at += dof;
  }
  return all;
}

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kUnusualEquation = 0.2;  // relative to usual accelerations
constexpr double kEquationChange = 1.0e-5;
constexpr double kEquationChangeOfZero = 1.0e-7;

}  // namespace

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

WindowCost::WindowCost(const Shooting& shooting, const Window& window,
                       const Eigen::VectorXd& given_start, bool unknowns)
    : shooting_(shooting), window_(window), given_start_(given_start), unknowns_(unknowns) {
  set_num_residuals(static_cast<int>(residualCount(shooting.study(), window)));
  if (unknowns_) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(shooting.unknowns()));
  }
  if (shooting.study().start_estimated) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(shooting.startSize()));
  }
}

bool WindowCost::Evaluate(double const* const* blocks, double* residuals,
                          double** jacobians) const {
  const std::size_t place = unknowns_ ? 1 : 0;
  const bool estimated = shooting_.study().start_estimated;
  const Eigen::VectorXd start =
      estimated
          ? Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(blocks[place], shooting_.startSize()))
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

EquationCost::EquationCost(const EquationError& equations, const CandidateMaker& maker)
    : equations_(equations), maker_(maker) {
  set_num_residuals(static_cast<int>(equations.size()));
  mutable_parameter_block_sizes()->push_back(static_cast<int>(maker.unknowns().size()));
}

bool EquationCost::Evaluate(double const* const* blocks, double* residuals,
                            double** jacobians) const {
  const auto n = static_cast<Eigen::Index>(maker_.unknowns().size());
  Eigen::VectorXd theta = Eigen::Map<const Eigen::VectorXd>(blocks[0], n);
  Eigen::VectorXd slope;
  try {
    Eigen::VectorXd here = equations_.residuals(maker_.at(theta));
    Eigen::MatrixXd by_unknowns(here.size(), jacobians != nullptr ? n : 0);
    for (Eigen::Index i = 0; i < by_unknowns.cols(); ++i) {
      const Unknown& unknown = maker_.unknowns()[static_cast<std::size_t>(i)];
      const double size = unknown.size(theta[i]);
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
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace whirl_twin
