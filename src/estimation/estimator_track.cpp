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
  told.system = twin.systems()[system]->spec.name;
  for (const EstimatorParameter& p : filter.model().parameters()) {
    told.parameter.push_back(p.path);
    told.parameter_unit.push_back(parameterUnit(*twin.systems()[system]->model, p.path));
  }
  for (const EstimatorChannel& c : filter.channels()) {
    told.channel.push_back(c.name);
    told.channel_unit.push_back(c.signal.unit);
  }
  const std::size_t n = filter.channels().size();
  told.residual.assign(n, state::FollowState::kNone);
  told.residual_deviation = told.offset = told.residual;
  told.channel_status.assign(n, static_cast<std::uint8_t>(state::ChannelStatus::kSilent));
  squares.assign(n, 0.0);
  counts.assign(n, 0);
  heard.assign(n, 0);
  model = filter.model().system();
  forces = bearingForces(*model);
  for (const BearingForce& force : forces) {
    told.bearing.push_back(force.name);
  }
  told.force_x.assign(forces.size(), state::FollowState::kNone);
  told.force_y = told.force_deviation = told.force_x;
}

bool EstimatorTrack::settled(std::int64_t instant) const {
  return instant - began > kResidualSettling;
}

void EstimatorTrack::beginMotion(std::int64_t instant, bool again_now) {
  again = again_now;
  began = last_used = instant;
  used_before = told.used;
  refused_before = told.refused;
  residuals.restart();
}

bool EstimatorTrack::beganWrong(std::int64_t instant) const {
  const auto refused = static_cast<double>(told.refused - refused_before);
  const auto used = static_cast<double>(told.used - used_before);
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
  told.value.clear();
  told.deviation.clear();
  for (std::size_t i = 0; i < told.parameter.size(); ++i) {
    told.value.push_back(filter.parameter(i));
    told.deviation.push_back(filter.parameterDeviation(i) *
                             robust.factors()[static_cast<Eigen::Index>(i)]);
  }
  for (std::size_t c = 0; c < told.channel.size(); ++c) {
    told.offset[c] = filter.hasOffset(c) ? filter.offset(c) : state::FollowState::kNone;
  }
  for (std::size_t i = 0; i < forces.size() && runs; ++i) {
    const KalmanFilter::Expected x = filter.combined(forces[i].x);
    const KalmanFilter::Expected y = filter.combined(forces[i].y);
    told.force_x[i] = x.value;
    told.force_y[i] = y.value;
    told.force_deviation[i] = std::max(x.deviation, y.deviation);
  }
  const InnovationTest::Verdict& verdict = residuals.verdict();
  told.mismatch = verdict.mismatch;
  told.mismatch_least = verdict.mismatch_least;
  told.mismatch_limit = verdict.mismatch_limit;
  told.whiteness = verdict.whiteness;
  told.whiteness_limit = verdict.whiteness_limit;
  if (!told.parameter.empty() && runs) {
    drift.take(time, told.value.data(), told.deviation.data());
    const CusumDetector::Drift& gone = drift.drift();
    told.drift_parameter =
        gone.parameter < 0 ? "" : told.parameter[static_cast<std::size_t>(gone.parameter)];
    told.drift_from = gone.from;
    told.drift_to = gone.to;
    told.drift_since = gone.since;
    told.drift = gone.statistic;
    told.drift_limit = gone.limit;
  }
}

}  // namespace whirl_twin
