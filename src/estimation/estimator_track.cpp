#include "estimation/estimator_track.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr std::int64_t kResidualSettling = 200'000'000;  // ns
/// Just before the filter estimates more than the motion (kFilterSettling,
/// extended_kalman_filter.cpp).
constexpr std::int64_t kMotionFound = 45'000'000;  // ns
/// Fraction of the samples until then. Outliers are fewer; one bad probe of four is more.
constexpr double kMaxRefusedAtFirst = 0.2;
/// Of residuals, for the covariance: longer than the correlation time of a whirl or a filtered hum.
constexpr std::int64_t kBlock = 250'000'000;  // ns
constexpr double kResidualWindow = 1.0;       // s, of residuals, and between parameter samples
constexpr double kWarmUp = 120.0;             // s, of a parameter's reference
constexpr double kMatters = 0.02;             // relative to a parameter

/// Unit of `stiffness`, or of a column, `bearings[0].kxx`; "" for the entries of a matrix.
std::string parameterUnit(const ModelInfo& model, const std::string& path) {
  for (const ParameterInfo& parameter : model.parameters) {
    if (parameter.name == path) {
      return parameter.unit;
    }
  }
  const std::string column = path.substr(std::min(path.size(), path.find('.') + 1));
  for (const SettingInfo& setting : model.settings) {
    for (const ColumnInfo& c : setting.columns) {
      if (path.rfind(setting.name + "[", 0) == 0 && c.name == column) {
        return c.unit;
      }
    }
  }
  return "";
}

}  // namespace

EstimatorTrack::EstimatorTrack(const Twin& twin, std::size_t system,
                               const SystemFollowing& settings,
                               std::vector<EstimatorChannel> channels, double false_alarms)
    : index(system),
      filter(twin.built(), system, settings, std::move(channels)),
      drive(twin.systems()[system]->drive),
      residuals(filter.channels().size(), {kResidualWindow, false_alarms}),
      drift(settings.parameters.size(), {kResidualWindow, kWarmUp, kMatters, false_alarms}),
      robust(filter.learnedCovariance().diagonal().cwiseSqrt(), filter.learnedWalk()),
      innovations(filter.channels().size(), kNaN),
      surest(innovations) {
  report.system = twin.systems()[system]->spec.name;
  for (const EstimatorParameter& p : filter.model().parameters()) {
    report.parameter.push_back(p.path);
    report.parameter_unit.push_back(parameterUnit(*twin.systems()[system]->model, p.path));
  }
  for (const EstimatorChannel& c : filter.channels()) {
    report.channel.push_back(c.name);
    report.channel_unit.push_back(c.signal.unit);
  }
  const std::size_t n = filter.channels().size();
  report.residual.assign(n, state::FollowState::kNone);
  report.residual_deviation = report.offset = report.residual;
  report.channel_status.assign(n, static_cast<std::uint8_t>(state::ChannelStatus::kSilent));
  squares.assign(n, 0.0);
  counts.assign(n, 0);
  heard.assign(n, 0);
  model = filter.model().system();
  forces = bearingForces(*model);
  for (const BearingForce& force : forces) {
    report.bearing.push_back(force.name);
  }
  report.force_x.assign(forces.size(), state::FollowState::kNone);
  report.force_y = report.force_deviation = report.force_x;
}

bool EstimatorTrack::settled(std::int64_t instant) const {
  return instant - began > kResidualSettling;
}

void EstimatorTrack::beginMotion(std::int64_t instant, bool again_now) {
  again = again_now;
  began = last_used = instant;
  used_before = report.used;
  refused_before = report.refused;
  residuals.restart();
}

bool EstimatorTrack::beganWrong(std::int64_t instant) const {
  const auto refused = static_cast<double>(report.refused - refused_before);
  const auto used = static_cast<double>(report.used - used_before);
  return !again && instant - began > kMotionFound && instant - began < kResidualSettling &&
         refused > kMaxRefusedAtFirst * (refused + used);
}

void EstimatorTrack::endInstant() {
  if (settled(at)) {
    residuals.take(static_cast<double>(at) * 1.0e-9, innovations.data(), innovations.size(),
                   surest.data());
  }
  std::fill(innovations.begin(), innovations.end(), kNaN);
  endBlock(false);
}

void EstimatorTrack::endBlock(bool at_once) {
  const std::int64_t duration = at - block_began;
  if (duration <= 0 || (duration < kBlock && !at_once)) {
    return;
  }
  block_began = at;
  if (filter.looksAtItsStart()) {
    // A pass of the iteration has replaced the estimate.
    robust.restart(filter.learned(), filter.learnedCovariance());
  } else if (filter.byProbes()) {
    robust.resume(filter.learned(), filter.learnedCovariance());
  } else {
    robust.add(filter.learned(), filter.learnedCovariance(),
               kNanosecond * static_cast<double>(duration));
  }
}

void EstimatorTrack::forgetFactors() {
  robust.restart(filter.learned(), filter.learnedCovariance());
}

void EstimatorTrack::publishKnown(double time) {
  report.value.clear();
  report.deviation.clear();
  for (std::size_t i = 0; i < report.parameter.size(); ++i) {
    report.value.push_back(filter.parameter(i));
    report.deviation.push_back(filter.parameterDeviation(i) *
                               robust.factors()[static_cast<Eigen::Index>(i)]);
  }
  for (std::size_t c = 0; c < report.channel.size(); ++c) {
    report.offset[c] = filter.hasOffset(c) ? filter.offset(c) : state::FollowState::kNone;
  }
  for (std::size_t i = 0; i < forces.size() && runs; ++i) {
    const KalmanFilter::Expected x = filter.combined(forces[i].x);
    const KalmanFilter::Expected y = filter.combined(forces[i].y);
    report.force_x[i] = x.value;
    report.force_y[i] = y.value;
    report.force_deviation[i] = std::max(x.deviation, y.deviation);
  }
  const InnovationTest::Verdict& verdict = residuals.verdict();
  report.mismatch = verdict.mismatch;
  report.mismatch_least = verdict.mismatch_least;
  report.mismatch_limit = verdict.mismatch_limit;
  report.whiteness = verdict.whiteness;
  report.whiteness_limit = verdict.whiteness_limit;
  if (!report.parameter.empty() && runs) {
    drift.take(time, report.value.data(), report.deviation.data());
    const CusumDetector::Drift& gone = drift.drift();
    report.drift_parameter =
        gone.parameter < 0 ? "" : report.parameter[static_cast<std::size_t>(gone.parameter)];
    report.drift_from = gone.from;
    report.drift_to = gone.to;
    report.drift_since = gone.since;
    report.drift = gone.statistic;
    report.drift_limit = gone.limit;
  }
}

}  // namespace whirl_twin
