#include "reports/followed_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "estimation/state_estimator.h"
#include "twin/observer.h"

namespace whirl_twin {

namespace {

/// The largest factor of a run-up that white residuals reach in one of twenty.
constexpr double kNotWhite = 2.0;

/// Adds what a state estimator publishes of a system.
void add(const state::FollowState& now, EstimatorSystem& system) {
  if (!std::isnan(now.mismatch) && now.mismatch != system.last.mismatch) {
    ++system.windows;
    system.mismatched += now.mismatch > now.mismatch_limit || now.mismatch < now.mismatch_least ||
                         std::fabs(now.whiteness) > now.whiteness_limit;
  }
  if (!now.drift_parameter.empty() && system.drift_parameter.empty()) {
    system.drift_parameter = now.drift_parameter;
    system.drift_from = now.drift_from;
    system.drift_to = now.drift_to;
    system.drift_since = now.drift_since;
    system.drift_reported = now.at.time;
  }
  system.found = system.found || now.used > 0;
  system.last = now;
}

/// Adds the results of its filter; factors: StateEstimator::deviationFactors().
void add(const ExtendedKalmanFilter& filter, const Eigen::VectorXd& factors,
         EstimatorSystem& system) {
  for (const EstimatorParameter& p : filter.model().parameters()) {
    system.factor.push_back(factors[static_cast<Eigen::Index>(system.factor.size())]);
    system.start.push_back(p.start);
  }
  for (const EstimatorChannel& c : filter.channels()) {
    system.is_input.push_back(c.input.has_value());
  }
  const std::vector<Station>& stations = filter.unbalanceStations();
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const Eigen::Vector2d u = filter.unbalance(i);
    const Eigen::Vector2d variance = filter.unbalanceCovariance(i).diagonal();
    const auto k = static_cast<Eigen::Index>(system.start.size() + 2 * i);
    const double wider = variance.dot(factors.segment<2>(k).cwiseAbs2()) / variance.sum();
    system.unbalances.push_back({stations[i].name, u.norm(), std::atan2(u.y(), u.x()),
                                 std::sqrt(0.5 * variance.sum() * wider), std::sqrt(wider)});
  }
}

std::string plusMinus(double value, double deviation) {
  return std::isfinite(deviation) ? fmt::format("{:.6g} +- {:.2g}", value, deviation)
                                  : fmt::format("{:.6g}, not identifiable", value);
}

/// Of all deviations, the largest.
double deviationFactor(const EstimatorSystem& system) {
  double factor = 1.0;
  for (const double f : system.factor) {
    factor = std::max(factor, f);
  }
  for (const FoundUnbalance& u : system.unbalances) {
    factor = std::max(factor, u.factor);
  }
  return factor;
}

std::string followedSystemText(const EstimatorSystem& system) {
  std::string out = fmt::format("{}\n", system.name);
  if (!system.found) {
    return out + "  its motion was not estimated: no sample of it, or no shaft angle\n";
  }
  for (std::size_t i = 0; i < system.last.parameter.size(); ++i) {
    out += fmt::format("  {:<24} {} {}   (scene: {:.6g})\n", system.last.parameter[i],
                       plusMinus(system.last.value[i], system.last.deviation[i]),
                       system.last.parameter_unit[i], system.start[i]);
  }
  for (const FoundUnbalance& u : system.unbalances) {
    out +=
        fmt::format("  unbalance {:<14} {} kg m at {:.2f} deg of the shaft, added to the scene's\n",
                    u.station, plusMinus(u.amount, u.deviation), u.angle / kDegree);
  }
  const double factor = deviationFactor(system);
  if (factor > 1.0) {
    out += fmt::format(
        "  standard deviations are up to {:.2g} times those of white residuals: parts of the "
        "record "
        "differ by more{}\n",
        factor,
        factor > kNotWhite ? " (hum, an order of the shaft or a force that the model has not)"
                           : "");
  }
  for (std::size_t c = 0; c < system.last.channel.size(); ++c) {
    if (system.is_input[c]) {
      out += fmt::format("  {:<24} acts on an input\n", system.last.channel[c]);
      continue;
    }
    // None of a motion that was followed for too short a time, or of a channel that was not used.
    out += std::isnan(system.rms[c])
               ? fmt::format("  {:<24} no residual", system.last.channel[c])
               : fmt::format("  {:<24} residual {:.3g} {} rms, expected {:.3g}",
                             system.last.channel[c], system.rms[c], system.last.channel_unit[c],
                             system.last.residual_deviation[c]);
    if (!std::isnan(system.last.offset[c])) {
      out += fmt::format("; zero offset {:.4g} {}", system.last.offset[c],
                         system.last.channel_unit[c]);
    }
    out += "\n";
  }
  const state::FollowState& last = system.last;
  out += fmt::format("  samples: {} used, {} rejected, {} invalid, {} late, {} lost, {} repeated\n",
                     last.used, last.refused, last.invalid, last.late, last.lost, last.repeated);
  out += fmt::format("  windows with residuals inconsistent with the model: {} of {}\n",
                     system.mismatched, system.windows);
  if (!system.drift_parameter.empty()) {
    out += fmt::format("  drift: {} from {:.6g} to {:.6g}, since {:.1f} s, detected at {:.1f} s\n",
                       system.drift_parameter, system.drift_from, system.drift_to,
                       system.drift_since, system.drift_reported);
  }
  return out;
}

}  // namespace

FollowedLog followLog(const Twin& twin, const FollowSettings& settings, const Recording& recording,
                      SampleWriter* writer, std::int64_t every,
                      const std::function<void(std::uint64_t, std::uint64_t)>& advanced) {
  FollowedLog run;
  run.scene = twin.scene().name;
  run.log = recording.path;
  const auto generations = std::make_shared<SystemGenerations>(twin);
  Observer observer(twin, generations);
  std::vector<EstimatorSystem> systems(twin.systems().size());
  for (std::size_t i = 0; i < systems.size(); ++i) {
    systems[i].name = twin.systems()[i]->spec.name;
  }
  EstimatorListener listener;
  listener.record = [&](const double* record) {
    observer.observe(record);
    run.duration = observer.instant().time - twin.seconds(0);
    if (writer != nullptr) {
      writer->follow(record, observer);
      writer->write(observer);
    }
  };
  listener.follow = [&](const state::FollowState& now) {
    for (EstimatorSystem& system : systems) {
      if (system.name == now.system) {
        add(now, system);
      }
    }
    if (writer != nullptr) {
      writer->write(now);
    }
  };
  StateEstimator follower(twin, generations, settings, every, listener);
  run.file = readMeasurements(
      recording, run.scene, estimatorSources(twin.scene(), settings),
      [&](const state::Measurement& measurement) {
        if (writer != nullptr) {
          writer->write(measurement);
        }
        follower.take(measurement);
      },
      advanced);
  follower.finish();
  run.restarts = follower.restarts();
  for (std::size_t i = 0; i < systems.size(); ++i) {
    if (const ExtendedKalmanFilter* filter = follower.filter(i)) {
      add(*filter, follower.deviationFactors(i), systems[i]);
      systems[i].rms = follower.residualRms(i);
      run.systems.push_back(systems[i]);
    }
  }
  return run;
}

std::string text(const FollowedLog& run) {
  std::string out = fmt::format("{} estimated for {:.1f} s by {}: {} messages", run.log,
                                run.duration, run.scene, run.file.messages);
  out += run.file.rejected + run.file.damaged > 0
             ? fmt::format(", {} rejected, {} corrupt\n", run.file.rejected, run.file.damaged)
             : "\n";
  if (!run.file.first_damage.empty()) {
    out += "  first corruption: " + run.file.first_damage + "\n";
  }
  out += joined(run.file.remarks, [](const auto& remark) { return "  " + remark + "\n"; });
  if (run.restarts > 0) {
    out += fmt::format("The estimator was re-initialized {} times.\n", run.restarts);
  }
  return out + joined(run.systems, followedSystemText);
}

Json json(const FollowedLog& run) {
  Json out = {{"scene", run.scene},
              {"log", run.log},
              {"duration", run.duration},
              {"messages", run.file.messages},
              {"rejected", run.file.rejected},
              {"damaged", run.file.damaged},
              {"first_damage", run.file.first_damage},
              {"remarks", run.file.remarks},
              {"restarts", run.restarts},
              {"systems", Json::object()}};
  for (const EstimatorSystem& s : run.systems) {
    Json system = {
        {"found", s.found}, {"parameters", Json::object()}, {"channels", Json::object()}};
    for (std::size_t i = 0; i < s.last.parameter.size(); ++i) {
      system["parameters"][s.last.parameter[i]] = {{"value", s.last.value[i]},
                                                   {"standard_deviation", s.last.deviation[i]},
                                                   {"deviation_factor", s.factor[i]}};
    }
    for (std::size_t c = 0; s.found && c < s.last.channel.size(); ++c) {
      if (s.is_input[c]) {
        continue;
      }
      system["channels"][s.last.channel[c]] = {{"residual_rms", s.rms[c]},
                                               {"expected", s.last.residual_deviation[c]},
                                               {"offset", s.last.offset[c]}};
    }
    system["unbalances"] = Json::object();
    for (const FoundUnbalance& u : s.unbalances) {
      system["unbalances"][u.station] = {{"amount", u.amount},
                                         {"angle", u.angle},
                                         {"standard_deviation", u.deviation},
                                         {"deviation_factor", u.factor}};
    }
    system["deviation_factor"] = deviationFactor(s);
    system["samples"] = {{"used", s.last.used},       {"refused", s.last.refused},
                         {"invalid", s.last.invalid}, {"late", s.last.late},
                         {"lost", s.last.lost},       {"repeated", s.last.repeated}};
    system["windows"] = s.windows;
    system["windows_mismatched"] = s.mismatched;
    system["drift"] = s.drift_parameter.empty() ? Json()
                                                : Json{{"parameter", s.drift_parameter},
                                                       {"from", s.drift_from},
                                                       {"to", s.drift_to},
                                                       {"since", s.drift_since},
                                                       {"told", s.drift_reported}};
    out["systems"][s.name] = system;
  }
  return out;
}

}  // namespace whirl_twin
