// simulation_node: steps a scene at a fixed rate in a real-time thread; publishes on ROS and LCM.
//
// Threads: the loop (FixedRateLoop) steps and writes records into a ring; RecordPublisher drains
// the ring and owns all sockets; this thread serves the services and the diagnostics.

#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sched.h>
#include <whirl_twin/MonitorStatus.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>

#include "accuracy/step_choice.h"
#include "messages/monitor_status.h"
#include "nodes/changed_parameters.h"
#include "nodes/checkpoint_saver.h"
#include "nodes/duplicate_publishers.h"
#include "nodes/external_controllers.h"
#include "nodes/input_commands.h"
#include "nodes/lockstep_listeners.h"
#include "nodes/loop_report.h"
#include "nodes/node_parameters.h"
#include "nodes/record_publisher.h"
#include "nodes/refusal_report.h"
#include "nodes/run_node.h"
#include "nodes/state_publisher.h"
#include "nodes/twin_services.h"
#include "plugins/plugins.h"
#include "realtime/fixed_rate_loop.h"
#include "scene/scene_reader.h"
#include "transport/channels.h"
#include "transport/master_watch.h"
#include "transport/ros_parameters.h"
#include "transport/twin_namespace.h"
#include "twin/checkpoint.h"
#include "twin/live_twin.h"
#include "twin/scene_lines.h"

namespace whirl_twin {

namespace {

constexpr std::int64_t kMinStep = 10'000;  // ns, shortest step of the fixed-rate loop
constexpr auto kReportPeriod = std::chrono::seconds(1);
constexpr double kServicePoll = 0.05;   // s
constexpr double kCommandPoll = 0.002;  // s, with ramps or commands by LCM

/// The node's private parameters.
struct SimulationParameters {
  double publish_rate = 0.0, batch = 0.0, real_time_factor = 1.0;
  std::string lcm_url, lcm_prefix;
  std::string realtime = "warn", overrun = "skip";
  int priority = 50, cpu = -1;
  double give_up = 0.0, busy_wait = 0.0;
  bool clock = false, paused = false, measure = false;
  double clock_rate = 250.0;
  std::string lockstep;
  int lockstep_ahead = 1;
  double lockstep_timeout = 5.0;
  std::string checkpoint, resume;
  double checkpoint_period = 5.0;
};

NodeParameters table(SimulationParameters& p) {
  NodeParameters all(
      "simulation_node",
      "The simulation: reads the scene from the parameter server (scene, in the namespace of its\n"
      "twin: /twin/scene for a node in the root namespace), steps it at a fixed rate, publishes "
      "its\n"
      "states on ROS and LCM, and serves changes.");
  all.number("publish_rate", p.publish_rate, kPublishRates, "messages of a state per second")
      .number("batch", p.batch, {0.0, 0.1, "s"}, "longest delay of states sent together")
      .number("real_time_factor", p.real_time_factor, {0.01, 1000.0, "", "as fast as possible"},
              "simulated seconds per second of wall time")
      .lcm(p.lcm_url, p.lcm_prefix)
      .choice("realtime", p.realtime, {"enforce", "warn", "ignore"},
              "reaction to missing real-time priority")
      .whole("priority", p.priority, 1, 98, "SCHED_FIFO priority of the loop")
      .whole("cpu", p.cpu, -1, CPU_SETSIZE - 1, "processor of the loop; -1: any")
      .number("give_up", p.give_up, {0.0, 86400.0, "s", "never"},
              "uninterrupted overruns after which the node exits")
      .number("busy_wait", p.busy_wait, {0.0, 10.0, "s"},
              "busy waiting before each step, up to half a step")
      .choice("overrun", p.overrun, {"skip", "catch_up", "stop"}, "reaction to overruns")
      .flag("clock", p.clock, "publish simulated time on /clock and stamp messages with it")
      .number("clock_rate", p.clock_rate, {1.0e-3, 1.0e5, "Hz"}, "of /clock")
      .flag("paused", p.paused, "paused at its start until ~resume or ~step")
      .text("lockstep", p.lockstep, "none",
            "nodes, separated by commas, that acknowledge each step on the topic lockstep before "
            "simulated time continues")
      .whole("lockstep_ahead", p.lockstep_ahead, 1, 1000,
             "publications ahead of the last acknowledged one")
      .number("lockstep_timeout", p.lockstep_timeout, {0.1, 86400.0, "s"},
              "time without an acknowledgement after which it pauses")
      .flag("measure", p.measure, "publish the measurements of the scene's sensors")
      .text("checkpoint", p.checkpoint, "none",
            "a file in which the twin is saved while it runs and at its end")
      .number("checkpoint_period", p.checkpoint_period, {0.1, 1.0e6, "s"},
              "from one checkpoint to the next")
      .text("resume", p.resume, "the scene's start", "a checkpoint to resume, bit-identical");
  return all;
}

/// Throws InputError for settings that do not match the scene.
void requireFits(const SimulationParameters& p, const Scene& scene) {
  if (p.clock && scene.time < 0) {
    throw InputError("clock: needs a scene whose time is >= 0 s");
  }
  if (p.measure && scene.sensors.empty()) {
    throw InputError("measure: the scene has no sensors");
  }
  if (scene.step < kMinStep) {
    throw InputError(fmt::format("{}: step: must be >= {:g} s to run live, found {:g} s",
                                 scene.source, static_cast<double>(kMinStep) * 1.0e-9,
                                 scene.stepSeconds()));
  }
  if (p.busy_wait > 0.5 * scene.stepSeconds()) {
    throw InputError(fmt::format("busy_wait: must be from 0 to {:g} s, half a step, found {}",
                                 0.5 * scene.stepSeconds(), p.busy_wait));
  }
}

FixedRateLoop::Options loopOptions(const SimulationParameters& p, const Scene& scene) {
  FixedRateLoop::Options loop;
  loop.period = scene.step;
  loop.mode = parseRealtimeMode(p.realtime);
  loop.priority = p.priority;
  loop.cpu = p.cpu;
  loop.give_up = std::llround(p.give_up * 1.0e9);
  loop.busy_wait =
      std::min(std::llround(p.busy_wait * 1.0e9), static_cast<long long>(scene.step / 2));
  loop.policy = parseOverrunPolicy(p.overrun);
  return loop;
}

void run() {
  ros::NodeHandle node(twinNamespace());
  ros::NodeHandle private_node("~");
  usePlugins();
  const ParameterTree given = parameterTree(node, "scene");
  const Scene scene = withStepsChosen(readScene(given.tree, given.source));
  SimulationParameters settings;
  table(settings).read();
  requireFits(settings, scene);
  const std::int64_t every = stepsToPublish(scene, settings.publish_rate);

  // Buffer for half a second of delay of the publisher, at least 64 records.
  const auto capacity =
      static_cast<std::size_t>(std::max<std::int64_t>(64, 500'000'000 / scene.step));
  LiveTwin live(scene, std::min<std::size_t>(capacity, 100'000));
  live.setPace(settings.real_time_factor);
  FixedRateLoop loop(loopOptions(settings, scene));
  const SceneLines lines = sceneLines(given.tree, live.twin());
  std::optional<Checkpoint> resumed;
  if (!settings.resume.empty()) {
    resumed = readCheckpoint(settings.resume);
    requireScene(*resumed, lines, settings.resume);
  }
  TwinServices services(live, private_node,
                        [&] { return !stopRequested() && ros::ok() && loop.running(); });
  if (resumed) {
    services.resumeFrom(*resumed, settings.resume);
  }
  if (settings.paused) {
    live.restore(true);
  }
  LockstepListeners lockstep(live, node,
                             lockstepSettings(settings.lockstep, settings.lockstep_ahead,
                                              settings.lockstep_timeout, every));
  RecordPublisher publisher(
      live, loop,
      StatePublisher(live.twin(), live.ensembles(), node,
                     LcmPublisher(settings.lcm_url, settings.lcm_prefix),
                     settings.clock ? std::llround(1.0e9 / settings.clock_rate) : 0),
      lockstep, sceneText(given.tree, given.source), every,
      std::chrono::microseconds(std::llround(settings.batch * 1.0e6)), settings.clock,
      settings.measure);
  if (resumed) {
    publisher.restore(*resumed, settings.resume);
    ROS_INFO("resumed from step %ld, t = %g s, of %s", static_cast<long>(resumed->step),
             live.twin().time(), settings.resume.c_str());
  }
  CheckpointSaver saver(live, lines, settings.checkpoint, settings.checkpoint_period, services,
                        publisher);
  const ros::ServiceServer reset_statistics =
      private_node.advertiseService<std_srvs::TriggerRequest, std_srvs::TriggerResponse>(
          "reset_statistics", [&](std_srvs::TriggerRequest&, std_srvs::TriggerResponse& response) {
            loop.resetTiming();
            live.resetStepTimes();
            publisher.resetCounts();
            response.success = 1;
            response.message = "latencies and counts were reset";
            return true;
          });

  InputCommands commands(live, services, node, settings.lcm_url, settings.lcm_prefix);

  const ExternalControllers external(live, node, settings.lcm_url, settings.lcm_prefix);

  MonitorPulse pulse;
  const ros::Subscriber monitor = node.subscribe<MonitorStatus>(
      topicName(state::MonitorStatus::kKind), 10,
      boost::function<void(const MonitorStatus::ConstPtr&)>(
          [&pulse](const MonitorStatus::ConstPtr&) { pulse.beat(ros::WallTime::now().toSec()); }));

  diagnostic_updater::Updater diagnostics;
  diagnostics.setHardwareID("none");
  LoopDiagnostics loop_diagnostics;
  diagnostics.add("real-time loop", [&](diagnostic_updater::DiagnosticStatusWrapper& status) {
    loop_diagnostics.summarize(publisher.report(), ros::SteadyTime::now().toSec(), status);
    const std::string silence = pulse.silence(ros::WallTime::now().toSec());
    if (!silence.empty()) {
      status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, silence);
    }
    lockstep.summarize(status);
    if (external.any()) {
      status.add("refused controller commands", external.refused());
    }
    if (commands.any()) {
      status.add("input commands", commands.taken());
      status.add("refused input commands", commands.refused());
    }
  });

  diagnostics.add("inputs", [&](diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const std::string held = services.heldInputs();
    status.summary(held.empty() ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                   held.empty() ? "as in the scene" : held);
  });

  MasterWatch master({node.resolveName("scene"), node.resolveName("scene_file")});
  reportMaster(master, diagnostics);
  ChangedParameters parameters(master);
  parameters.report(diagnostics);
  DuplicatePublishers rivals(settings.lcm_prefix);
  if (publisher.onLcm()) {
    rivals.listen(settings.lcm_url);
    rivals.report(diagnostics);
  }
  const RefusalReport refused_payloads(
      diagnostics, {commands.refusedPayloads(), &external.malformed(), &rivals.refused()});

  for (const SharedSystem& system : live.twin().systems()) {
    ROS_INFO("%s: %s with %s%s%s%s", system->spec.name.c_str(), system->model->name.c_str(),
             system->integrator.c_str(), system->integrator_reason.empty() ? "" : " (",
             system->integrator_reason.c_str(), system->integrator_reason.empty() ? "" : ")");
  }
  loop.start([&live](std::int64_t scheduled) { return live.cycle(scheduled); });
  const RealtimeStatus status = loop.status();
  for (const std::string& warning : status.warnings) {
    ROS_WARN("%s", warning.c_str());
  }
  ROS_INFO("stepping every %g s with %s, priority %d, memory %slocked", scene.stepSeconds(),
           status.policy.c_str(), status.priority, status.memory_locked ? "" : "not ");
  publisher.start();

  // Wall time: simulated time is constant during a pause and jumps back in a reset.
  auto next_report = std::chrono::steady_clock::now();
  while (!stopRequested() && ros::ok() && loop.running()) {
    ros::getGlobalCallbackQueue()->callAvailable(
        ros::WallDuration(services.ramping() || commands.any() ? kCommandPoll : kServicePoll));
    services.continueRamps();
    saver.saveIfDue();
    commands.receive();
    rivals.receive();
    lockstep.watch();
    if (std::chrono::steady_clock::now() >= next_report) {
      next_report = std::chrono::steady_clock::now() + kReportPeriod;
      diagnostics.force_update();
    }
  }
  const bool by_itself = !loop.running() && !stopRequested();
  loop.stop();
  publisher.join();
  saver.saveAtEnd();
  ROS_INFO("stopped after %ld steps", static_cast<long>(live.twin().stepCount()));
  master.stop();
  ros::shutdown();
  if (loop.gaveUp()) {
    throw RunFailure("every step was an overrun for the time of the parameter give_up");
  }
  if (by_itself) {
    throw RunFailure("a step was an overrun, and the parameter overrun is stop");
  }
}

}  // namespace

}  // namespace whirl_twin

int main(int argc, char** argv) {
  return whirl_twin::runNode(argc, argv, "simulation_node", whirl_twin::helpOf(whirl_twin::table),
                             whirl_twin::run);
}
