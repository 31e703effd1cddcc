#include "estimation/window_motion.h"

#include <algorithm>
#include <cmath>

#include "algebra/dense.h"
#include "realtime/denormals.h"

namespace whirl_twin {

namespace {

constexpr double kStartSeconds = 0.04;  // of rows for a measured start
constexpr std::size_t kStartRows = 7;   // at least
constexpr double kShortLeftOver = 0.5;  // of a window

std::int64_t instantInNanoseconds(double seconds) {
  return std::llround(seconds * 1.0e9);
}

/// Integrates the steps of a window; keeps the states at both ends of the last one.
class Steps {
 public:
  Steps(const FitStudy& study, const BuiltScene& scene, const Candidate& candidate,
        const Window& window)
      : step_(study.scene.step),
        seconds_(study.scene.stepSeconds()),
        drive_(scene.driveOf(*candidate.system)),
        inputs_(candidate.inputs[window.run]),
        stepper_(candidate.system->setup().system(candidate.system->integrator,
                                                  StepContext(drive_, &inputs_), seconds_,
                                                  candidate.system->spec.substeps)),
        dof_(static_cast<Eigen::Index>(stepper_->dof())),
        before_(2 * dof_ + 1),
        after_(2 * dof_ + 1),
        at_(instantInNanoseconds(study.runs[window.run].data.time[window.first])) {}
  Steps(const Steps&) = delete;  // the stepper refers to drive and inputs
  Steps& operator=(const Steps&) = delete;

  void begin(const Eigen::VectorXd& start) {
    stand();
    stepper_->set(start.data(), start.data() + dof_);
    stepper_->write(after_.data());
  }
  std::int64_t end() const { return at_; }  // [ns]
  bool step() {
    before_.swap(after_);
    if (stepper_->step(static_cast<double>(at_) * 1.0e-9) != StepStatus::kOk) {
      return false;
    }
    stepper_->write(after_.data());
    at_ += step_;
    stand();
    return true;
  }
  /// Coordinates and rates at an instant [s] within the last step.
  template <class Column>
  void write(double time, Column&& out) const {
    const double s = 1.0 + (time - static_cast<double>(at_) * 1.0e-9) / seconds_;
    const double s2 = s * s;
    const double s3 = s2 * s;
    for (Eigen::Index i = 0; i < dof_; ++i) {
      const double q0 = before_[i], q1 = after_[i];
      const double v0 = seconds_ * before_[dof_ + i], v1 = seconds_ * after_[dof_ + i];
      out[i] = (2 * s3 - 3 * s2 + 1) * q0 + (s3 - 2 * s2 + s) * v0 + (3 * s2 - 2 * s3) * q1 +
               (s3 - s2) * v1;
      out[dof_ + i] =
          (6 * (s2 - s) * (q0 - q1) + (3 * s2 - 4 * s + 1) * v0 + (3 * s2 - 2 * s) * v1) / seconds_;
    }
  }
  template <class Column>
  void writeEnd(Column&& out) const {
    out = after_.head(2 * dof_);
  }

 private:
  void stand() {
    drive_.begin(at_);
    if (inputs_.count() > 0) {
      inputs_.begin(at_);
    }
  }

  std::int64_t step_;  // [ns]
  double seconds_;
  Drive drive_;
  Inputs inputs_;
  std::unique_ptr<Stepper> stepper_;
  Eigen::Index dof_;
  Eigen::VectorXd before_, after_;  // coordinates, rates, work
  std::int64_t at_;                 // [ns], of `after_`
};

/// Least-squares quadratic through points: value and slope at x = 0.
std::pair<double, double> quadraticAtZero(const std::vector<double>& x,
                                          const std::vector<double>& y) {
  Eigen::MatrixXd a(static_cast<Eigen::Index>(x.size()), 3);
  const double width = std::max(std::fabs(x.front()), std::fabs(x.back()));
  if (width == 0.0) {
    return {y.front(), 0.0};  // a single row
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = x[i] / width;
    a.row(static_cast<Eigen::Index>(i)) << 1.0, u, u * u;
  }
  const Eigen::Map<const Eigen::VectorXd> b(y.data(), a.rows());
  const Eigen::Vector3d c = PivotedQr(a).solve(b);
  return {c[0], c[1] / width};
}

}  // namespace

std::vector<Window> windowsOf(const FitStudy& study, std::size_t run, double length) {
  const std::vector<double>& time = study.runs[run].data.time;
  std::vector<Window> all;
  std::size_t first = 0;
  while (first + 1 < time.size()) {
    const double end = time[first] + length * (1.0 + 1.0e-12);
    const auto next =
        std::upper_bound(time.begin() + static_cast<std::ptrdiff_t>(first), time.end(), end);
    const auto last = static_cast<std::size_t>(next - time.begin()) - 1;
    const bool whole = next != time.end();
    const double spanned = time[std::max(last, first)] - time[first];
    if (!whole && !all.empty() && spanned < kShortLeftOver * length) {
      all.back().count = time.size() - all.back().first;
      break;
    }
    const std::size_t upto = whole ? std::max(last, first + 1) : time.size() - 1;
    if (whole && upto == first + 1 && !all.empty()) {  // a single row before a gap has no motion
      ++all.back().count;
      first = upto;
      continue;
    }
    all.push_back({run, first, upto - first + (whole ? 0 : 1)});
    first = upto;
    if (!whole) {
      break;
    }
  }
  return all;
}

bool predict(const FitStudy& study, const BuiltScene& scene, const Candidate& candidate,
             const Window& window, const Eigen::VectorXd& start, Eigen::MatrixXd& states) {
  const DenormalsToZero denormals_to_zero;
  const std::vector<double>& time = study.runs[window.run].data.time;
  Steps steps(study, scene, candidate, window);
  steps.begin(start);
  states.resize(start.size(), static_cast<Eigen::Index>(window.count));
  steps.writeEnd(states.col(0));
  for (std::size_t k = 1; k < window.count; ++k) {
    const double at = time[window.first + k];
    while (steps.end() < instantInNanoseconds(at)) {
      if (!steps.step()) {
        return false;
      }
    }
    steps.write(at, states.col(static_cast<Eigen::Index>(k)));
  }
  return states.allFinite();
}

std::size_t residualCount(const FitStudy& study, const Window& window) {
  return study.runs[window.run].measured.size() * window.count;
}

Eigen::VectorXd residuals(const FitStudy& study, const Candidate& candidate, const Window& window,
                          const Eigen::MatrixXd& states) {
  const auto count = static_cast<Eigen::Index>(window.count);
  Eigen::VectorXd all(static_cast<Eigen::Index>(residualCount(study, window)));
  Eigen::Index at = 0;
  for (const MeasuredChannel& c : candidate.runs[window.run].measured) {
    const double* measured = study.runs[window.run].data.column(c.column).data() + window.first;
    all.segment(at, count) =
        (Eigen::Map<const Eigen::VectorXd>(measured, count) -
         c.scale.value * states.row(static_cast<Eigen::Index>(c.state)).transpose() -
         Eigen::VectorXd::Constant(count, c.offset.value)) /
        c.deviation;
    at += count;
  }
  return all;
}

Eigen::VectorXd measuredStart(const FitStudy& study, const Candidate& candidate,
                              const Window& window) {
  const SystemSpec& spec = candidate.system->spec;
  const std::size_t n = spec.q.size();
  Eigen::VectorXd start(static_cast<Eigen::Index>(2 * n));
  for (std::size_t i = 0; i < n; ++i) {
    start[static_cast<Eigen::Index>(i)] = spec.q[i];
    start[static_cast<Eigen::Index>(n + i)] = spec.v[i];
  }
  const std::vector<double>& time = study.runs[window.run].data.time;
  const double from = time[window.first];
  std::size_t rows = std::min(kStartRows, window.count);
  while (rows < window.count && time[window.first + rows] - from < kStartSeconds) {
    ++rows;
  }
  std::vector<double> x(rows), y(rows);
  std::vector<bool> has_rate(n, false);
  for (const bool rates : {true, false}) {
    for (const MeasuredChannel& c : candidate.runs[window.run].measured) {
      if ((c.state >= n) != rates) {
        continue;
      }
      const std::vector<double>& column = study.runs[window.run].data.column(c.column);
      for (std::size_t i = 0; i < rows; ++i) {
        x[i] = time[window.first + i] - from;
        y[i] = (column[window.first + i] - c.offset.value) / c.scale.value;
      }
      const auto [value, slope] = quadraticAtZero(x, y);
      start[static_cast<Eigen::Index>(c.state)] = value;
      if (rates) {
        has_rate[c.state - n] = true;
      } else if (!has_rate[c.state]) {
        start[static_cast<Eigen::Index>(n + c.state)] = slope;
      }
    }
  }
  return start;
}

}  // namespace whirl_twin
