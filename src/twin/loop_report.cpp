#include "twin/loop_report.h"

#include <limits>
#include <string>

namespace whirl_twin {

namespace {

double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) * 1.0e-9;
}

}  // namespace

state::LoopStatistics loopStatistics(const Twin& twin, const Observer& observer,
                                     const RealtimeStatus& status, const LoopTiming& timing,
                                     bool paused, std::uint64_t dropped) {
  state::LoopStatistics m;
  m.at = observer.instant();
  m.step_size = twin.scene().stepSeconds();
  m.policy = status.policy;
  m.priority = status.priority;
  m.memory_locked = status.memory_locked;
  m.kernel = status.kernel;
  m.paused = paused;
  m.overruns = timing.overruns;
  m.skipped_steps = timing.skipped;
  m.dropped_snapshots = dropped;
  m.page_faults = timing.page_faults;
  m.wakeup_latency_p50 = seconds(timing.wake_up_latency.percentile(50.0));
  m.wakeup_latency_p99 = seconds(timing.wake_up_latency.percentile(99.0));
  m.wakeup_latency_max = seconds(timing.wake_up_latency.max());
  m.execution_p50 = seconds(timing.execution_time.percentile(50.0));
  m.execution_p99 = seconds(timing.execution_time.percentile(99.0));
  m.execution_max = seconds(timing.execution_time.max());
  m.cpu = status.cpu;
  m.late_wakeups = timing.late_wake_ups;
  m.wakeup_latency_min = seconds(timing.wake_up_latency.min());
  m.wakeup_latency_mean = 1.0e-9 * timing.wake_up_latency.mean();
  m.wakeup_latency_p999 = seconds(timing.wake_up_latency.percentile(99.9));
  m.execution_min = seconds(timing.execution_time.min());
  m.execution_mean = 1.0e-9 * timing.execution_time.mean();
  m.execution_p999 = seconds(timing.execution_time.percentile(99.9));
  m.period_min = seconds(timing.period.min());
  m.period_max = seconds(timing.period.max());
  for (std::size_t i = 0; i < twin.systems().size(); ++i) {
    m.system.push_back(twin.systems()[i]->spec.name);
    m.integrator.push_back(twin.systems()[i]->integrator);
    m.error_estimate.push_back(observer.errorEstimate(i));
    const SystemSpec& spec = twin.systems()[i]->spec;
    m.tolerance.push_back(spec.integrator == "auto" ? spec.tolerance
                                                    : std::numeric_limits<double>::quiet_NaN());
    m.stopped.push_back(static_cast<std::uint8_t>(observer.status(i)));
    m.stopped_why.push_back(observer.stopReason(i));
  }
  for (const RunningController& controller : twin.control().controllers()) {
    if (const ExternalController* const external = controller.external()) {
      const auto place =
          static_cast<std::size_t>(&controller - twin.control().controllers().data());
      const TimingHistogram ages = external->ages();
      const auto inSeconds = [&](std::int64_t age) {
        return ages.count() > 0 ? static_cast<double>(age)
                                : std::numeric_limits<double>::quiet_NaN();
      };
      m.external.push_back(twin.scene().controllers[place].name);
      m.age_p50.push_back(inSeconds(ages.percentile(50.0)));
      m.age_p99.push_back(inSeconds(ages.percentile(99.0)));
      m.age_max.push_back(inSeconds(ages.max()));
    }
  }
  return m;
}

void addStepTimes(const LiveTwin& live, state::LoopStatistics& loop) {
  const Twin& twin = live.twin();
  for (std::size_t i = 0; i < live.stepTimes().parts(); ++i) {
    const StepTimes::Taken taken = live.stepTimes().of(i);
    loop.timed.push_back(i < twin.systems().size() ? twin.systems()[i]->spec.name : "controllers");
    loop.step_mean.push_back(1.0e-9 * taken.mean);
    loop.step_max.push_back(seconds(taken.longest));
    loop.long_steps.push_back(static_cast<double>(taken.long_steps));
  }
}

}  // namespace whirl_twin
