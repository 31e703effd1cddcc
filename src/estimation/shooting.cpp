#include "estimation/shooting.h"

#include <algorithm>
#include <cmath>

#include "messages/input_error.h"

namespace whirl_twin {

namespace {

constexpr double kMoved = 1.0e-6;     // relative to the measured signal
constexpr double kFirstTry = 1.0e-6;  // relative to an unknown
constexpr double kFirstTryOfZero = 1.0e-8;
constexpr double kMaxOfUnknown = 1.0e-2;
constexpr int kTries = 3;
constexpr double kNoEffect = 1.0e-10;  // relative to the measured signal: rounding
constexpr std::size_t kWindowsLookedAt = 4;

/// Root mean square about the mean.
double spreadOf(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::ArrayXd> x(values.data(), static_cast<Eigen::Index>(values.size()));
  return std::sqrt((x - x.mean()).square().mean());
}

}  // namespace

Shooting::Shooting(const FitStudy& study, const CandidateMaker& maker)
    : study_(study),
      maker_(maker),
      change_(unknowns()),
      moving_all_(Eigen::VectorXd::Zero(unknowns())),
      start_change_(startSize()) {
  const auto n = static_cast<std::size_t>(startSize() / 2);
  const std::vector<Unknown>& all = maker_.unknowns();
  for (std::size_t i = 0; i < all.size(); ++i) {
    change_[static_cast<Eigen::Index>(i)] =
        all[i].start == 0.0 ? kFirstTryOfZero : kFirstTry * std::fabs(all[i].start);
  }
  // From the measured range of coordinates and rates.
  Eigen::VectorXd size = Eigen::VectorXd::Zero(startSize());
  for (const StudyRun& run : study.runs) {
    for (const MeasuredChannel& c : run.measured) {
      const std::vector<double>& column = run.data.column(c.column);
      auto& one = size[static_cast<Eigen::Index>(c.state)];
      one = std::max(one, spreadOf(column) / c.scale.value);
      if (c.state < n) {
        double path = 0.0;
        for (std::size_t i = 1; i < column.size(); ++i) {
          path += std::fabs(column[i] - column[i - 1]);
        }
        auto& rate = size[static_cast<Eigen::Index>(c.state + n)];
        rate = std::max(rate, path / run.data.duration() / c.scale.value);
      }
    }
  }
  for (Eigen::Index i = 0; i < size.size(); ++i) {
    start_change_[i] = kMoved * (size[i] > 0.0 ? size[i] : 1.0);
  }
}

Eigen::Index Shooting::startSize() const {
  return static_cast<Eigen::Index>(2 * study_.spec().q.size());
}

bool Shooting::setPoint(const Eigen::VectorXd& theta, bool derivatives) {
  theta_ = theta;
  neighbours_.clear();
  const auto made = [&](const Eigen::VectorXd& at) -> std::optional<Candidate> {
    try {
      return maker_.at(at);
    } catch (const InputError&) {
      return std::nullopt;
    }
  };
  candidate_ = made(theta);
  if (!candidate_ || !derivatives) {
    return candidate_.has_value();
  }
  for (Eigen::Index i = 0; i < theta.size(); ++i) {
    const Unknown& unknown = maker_.unknowns()[static_cast<std::size_t>(i)];
    Neighbours n;
    Eigen::VectorXd at = theta;
    at[i] = theta[i] + change_[i];
    const double above = at[i];
    if (above <= unknown.most) {
      n.above = made(at);
    }
    at[i] = theta[i] - change_[i];
    const double below = at[i];
    if (below >= unknown.least) {
      n.below = made(at);
    }
    n.apart = (n.above ? above : theta[i]) - (n.below ? below : theta[i]);
    neighbours_.push_back(std::move(n));
  }
  return true;
}

void Shooting::chooseDifferences(const std::vector<Window>& windows,
                                 const std::vector<Eigen::VectorXd>& starts) {
  double measured = 0.0;
  for (const StudyRun& run : study_.runs) {
    for (const MeasuredChannel& c : run.measured) {
      measured = std::max(measured, spreadOf(run.data.column(c.column)) / c.deviation);
    }
  }
  moving_all_.setZero();
  const std::size_t stride = std::max<std::size_t>(1, windows.size() / kWindowsLookedAt);
  for (int k = 0; k < kTries; ++k) {
    setPoint(theta_, true);
    for (Eigen::Index i = 0; i < change_.size(); ++i) {
      const Unknown& unknown = maker_.unknowns()[static_cast<std::size_t>(i)];
      const Neighbours& n = neighbours_[static_cast<std::size_t>(i)];
      const std::optional<Candidate>& there = n.above ? n.above : n.below;
      double square = 0.0;
      double count = 0.0;
      for (std::size_t w = 0; there && w < windows.size(); w += unknown.run ? 1 : stride) {
        if (!unknown.concerns(windows[w].run)) {
          continue;
        }
        Eigen::VectorXd here, moved;
        if (residuals(windows[w], starts[w], here) &&
            residualsOf(*there, windows[w], starts[w], moved)) {
          square += (moved - here).squaredNorm();
          count += static_cast<double>(here.size());
        }
      }
      if (square == 0.0) {
        continue;  // without effect
      }
      const double moved = std::sqrt(square / count);
      const double by = kMoved * measured / moved;
      const double about = unknown.size(theta_[i]);
      moving_all_[i] = moved > kNoEffect * measured ? change_[i] * by / kMoved : 0.0;
      change_[i] *= std::clamp(by, 1.0e-4, 1.0e4);
      if (about > 0.0) {
        change_[i] = std::min(change_[i], kMaxOfUnknown * about);
      }
    }
  }
}

bool Shooting::residualsOf(const Candidate& candidate, const Window& window,
                           const Eigen::VectorXd& start, Eigen::VectorXd& out) const {
  Eigen::MatrixXd states;
  // A measured start depends on the sensors' offsets.
  if (!predict(study_, maker_.scene(), candidate, window,
               study_.start_estimated ? start : measuredStart(study_, candidate, window), states)) {
    return false;
  }
  out = whirl_twin::residuals(study_, candidate, window, states);
  return true;
}

bool Shooting::residuals(const Window& window, const Eigen::VectorXd& start,
                         Eigen::VectorXd& out) const {
  return candidate_ && residualsOf(*candidate_, window, start, out);
}

bool Shooting::derivatives(const Window& window, const Eigen::VectorXd& start, bool unknowns_wanted,
                           WindowDerivatives& out) const {
  if (!residuals(window, start, out.residuals)) {
    return false;
  }
  const Eigen::Index rows = out.residuals.size();
  Eigen::VectorXd above = out.residuals, below = out.residuals;
  out.by_unknowns.resize(rows, unknowns_wanted ? unknowns() : 0);
  for (Eigen::Index i = 0; i < out.by_unknowns.cols(); ++i) {
    const Neighbours& n = neighbours_[static_cast<std::size_t>(i)];
    if (!maker_.unknowns()[static_cast<std::size_t>(i)].concerns(window.run)) {
      out.by_unknowns.col(i).setZero();
      continue;
    }
    above = below = out.residuals;
    if ((n.above && !residualsOf(*n.above, window, start, above)) ||
        (n.below && !residualsOf(*n.below, window, start, below))) {
      return false;
    }
    out.by_unknowns.col(i) =
        n.apart > 0.0 ? Eigen::VectorXd((above - below) / n.apart) : Eigen::VectorXd::Zero(rows);
  }
  out.by_start.resize(rows, study_.start_estimated ? start.size() : 0);
  for (Eigen::Index i = 0; i < out.by_start.cols(); ++i) {
    Eigen::VectorXd at = start;
    at[i] = start[i] + start_change_[i];
    const double up = at[i];
    if (!residuals(window, at, above)) {
      return false;
    }
    at[i] = start[i] - start_change_[i];
    if (!residuals(window, at, below)) {
      return false;
    }
    out.by_start.col(i) = (above - below) / (up - at[i]);
  }
  return true;
}

}  // namespace whirl_twin
