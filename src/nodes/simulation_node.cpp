// The simulation: a scene, stepped at a fixed rate in a real-time thread; states on ROS and LCM.
//
// Threads: the loop (FixedRateLoop) steps and writes records into a ring; RecordPublisher drains
// the ring and owns all sockets; this thread serves the services and the diagnostics.

#include <diagnostic_updater/diagnostic_updater.h>
#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <whirl_twin/MonitorStatus.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>

#include "accuracy/step_choice.h"
#include "messages/monitor_pulse.h"
#include "nodes/changed_parameters.h"
#include "nodes/checkpoint_saver.h"
#include "nodes/external_controllers.h"
#include "nodes/input_commands.h"
#include "nodes/lockstep_listeners.h"
#include "nodes/loop_report.h"
#include "nodes/private_parameter.h"
#include "nodes/publish_rate.h"
#include "nodes/record_publisher.h"
#include "nodes/refusal_report.h"
#include "nodes/rival_report.h"
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

constexpr const char* kHelp =
    "usage: simulation_node [_PARAMETER:=VALUE...] [NAME:=VALUE...]\n"
    "The simulation: reads the scene from the parameter server (scene, in the namespace of its\n"
    "twin: /twin/scene for a node in the root namespace), steps it at a fixed rate, publishes its\n"
    "states on ROS and LCM, and serves changes.\n"
    "\n"
    "private parameters (_NAME:=VALUE on the command line, or <param> in a launch file):\n"
    "  ~publish_rate      Hz, default 0: every step\n"
    "  ~batch             s, 0 to 0.1, longest delay of states sent together, default 0\n"
    "  ~real_time_factor  simulated seconds per second of wall time, 0.01 to 1000, default 1;\n"
    "                     0: as fast as possible\n"
    "  ~lcm_url           default udpm://239.255.76.67:7667?ttl=0; empty: no LCM\n"
    "  ~lcm_prefix        prefix of its LCM channels, default TWIN_, or its namespace in capitals\n"
    "  ~realtime          enforce, warn or ignore, default warn: reaction to missing real-time\n"
    "                     priority\n"
    "  ~priority          SCHED_FIFO priority, default 50\n"
    "  ~cpu               the processor of the loop, default -1: any\n"
    "  ~give_up           s of uninterrupted overruns after which it exits, default 0: never\n"
    "  ~busy_wait         s of busy waiting before each step, up to half a step, default 0\n"
    "  ~overrun           skip, catch_up or stop, default skip: reaction to overruns\n"
    "  ~clock             true or false, default false: publish simulated time on /clock and "
    "stamp\n"
    "                     messages with it\n"
    "  ~clock_rate        Hz, of /clock, default 250\n"
    "  ~paused            true or false, default false: paused at its start until ~resume or "
    "~step\n"
    "  ~lockstep          nodes, separated by commas, that acknowledge each step on the topic\n"
    "                     lockstep before simulated time continues; default: none\n"
    "  ~lockstep_ahead    publications ahead of the last acknowledged one, 1 to 1000, default 1\n"
    "  ~lockstep_timeout  s without an acknowledgement after which it pauses, default 5\n"
    "  ~measure           true or false, default false: publish the measurements of the scene's\n"
    "                     sensors on measured/SOURCE\n"
    "  ~checkpoint        a file, in which the twin is saved while it runs and at its end;\n"
    "                     default: none\n"
    "  ~checkpoint_period s between two checkpoints, 0.1 to 1e6, default 5\n"
    "  ~resume            a checkpoint to resume, bit-identical; default: the scene's start\n";

constexpr double kClockRate = 250.0;               // Hz
constexpr double kSlowestClock = 1.0e-3;           // Hz
constexpr double kFastestClock = 1.0e5;            // Hz
constexpr std::int64_t kShortestStep = 10'000;     // ns, that the fixed-rate loop takes
constexpr double kLongestBatch = 0.1;              // s
constexpr double kLongestGiveUp = 86400.0;         // s
constexpr double kCheckpointPeriod = 5.0;          // s
constexpr double kShortestCheckpointPeriod = 0.1;  // s
constexpr double kLongestCheckpointPeriod = 1.0e6;
constexpr auto kReportPeriod = std::chrono::seconds(1);
constexpr double kServicePoll = 0.05;   // s
constexpr double kCommandPoll = 0.002;  // s, where there are ramps or commands by LCM

/// The node's private parameters.
struct SimulationSettings {
  std::int64_t every;  ///< steps from one publication to the next
  std::chrono::microseconds batch;
  std::string lcm_url;
  std::string lcm_prefix;
  bool clock;
  double clock_rate;  ///< [Hz], in simulated time
  bool paused;        ///< at its start
  bool measure;       ///< publish what the scene's sensors see
  double real_time_factor;
  std::string checkpoint;    ///< file; empty: none
  double checkpoint_period;  ///< [s]
  std::string resume;        ///< file; empty: none
  Lockstep::Settings lockstep;
  FixedRateLoop::Options loop;
};

SimulationSettings readSettings(const Scene& scene) {
  requireKnownParameters({"publish_rate",    "lcm_url",   "lcm_prefix",       "clock",
                          "realtime",        "priority",  "overrun",          "cpu",
                          "give_up",         "busy_wait", "real_time_factor", "measure",
                          "clock_rate",      "paused",    "checkpoint",       "checkpoint_period",
                          "resume",          "batch",     "lockstep",         "lockstep_ahead",
                          "lockstep_timeout"});
  SimulationSettings s;
  s.every = stepsToPublish(scene);
  const double batch = privateParameter("batch", "a number of seconds", 0.0);
  if (!(batch >= 0.0 && batch <= kLongestBatch)) {
    throw Refusal(fmt::format("batch: must be from 0 to {:g} s, found {}", kLongestBatch, batch));
  }
  s.batch = std::chrono::microseconds(std::llround(batch * 1.0e6));
  s.lcm_url = privateParameter<std::string>("lcm_url", "an LCM URL, or nothing", kDefaultLcmUrl);
  s.lcm_prefix = lcmPrefixParameter();
  s.clock = privateParameter("clock", "true or false", false);
  if (s.clock && scene.time < 0) {
    throw Refusal("clock: needs a scene whose time is >= 0 s");
  }
  s.clock_rate = privateParameter("clock_rate", "a number in Hz", kClockRate);
  if (!(s.clock_rate >= kSlowestClock && s.clock_rate <= kFastestClock)) {
    throw Refusal(fmt::format("clock_rate: must be from {} to {} Hz, found {}", kSlowestClock,
                              kFastestClock, s.clock_rate));
  }
  s.paused = privateParameter("paused", "true or false", false);
  s.lockstep = lockstepParameters(s.every);
  s.measure = privateParameter("measure", "true or false", false);
  if (s.measure && scene.sensors.empty()) {
    throw Refusal("measure: the scene has no sensors");
  }
  s.real_time_factor = privateParameter("real_time_factor", "a number", 1.0);
  if (const std::string fault = factorFault(s.real_time_factor); !fault.empty()) {
    throw Refusal(fault);
  }
  s.checkpoint = privateParameter<std::string>("checkpoint", "a file, or nothing", "");
  s.checkpoint_period = privateParameter("checkpoint_period", "a number in s", kCheckpointPeriod);
  if (!(s.checkpoint_period >= kShortestCheckpointPeriod &&
        s.checkpoint_period <= kLongestCheckpointPeriod)) {
    throw Refusal(fmt::format("checkpoint_period: must be from {} to {} s, found {}",
                              kShortestCheckpointPeriod, kLongestCheckpointPeriod,
                              s.checkpoint_period));
  }
  s.resume = privateParameter<std::string>("resume", "a checkpoint, or nothing", "");
  if (scene.step < kShortestStep) {
    throw Refusal(fmt::format("{}: step: must be >= {:g} s to run live, found {:g} s", scene.source,
                              static_cast<double>(kShortestStep) * 1.0e-9, scene.stepSeconds()));
  }
  s.loop.period = scene.step;
  s.loop.mode = parseRealtimeMode(
      privateParameter<std::string>("realtime", "enforce, warn or ignore", "warn"));
  s.loop.priority = privateParameter("priority", "a whole number", 50);
  s.loop.cpu = privateParameter("cpu", "a whole number", -1);
  const double give_up = privateParameter("give_up", "a number of seconds", 0.0);
  if (!(give_up >= 0.0 && give_up <= kLongestGiveUp)) {
    throw Refusal(
        fmt::format("give_up: must be from 0 (never) to {} s, found {}", kLongestGiveUp, give_up));
  }
  s.loop.give_up = std::llround(give_up * 1.0e9);
  const double busy_wait = privateParameter("busy_wait", "a number of seconds", 0.0);
  if (!(busy_wait >= 0.0 && busy_wait <= 0.5 * scene.stepSeconds())) {
    throw Refusal(fmt::format("busy_wait: must be from 0 to {:g} s, half a step, found {}",
                              0.5 * scene.stepSeconds(), busy_wait));
  }
  s.loop.busy_wait =
      std::min(std::llround(busy_wait * 1.0e9), static_cast<long long>(scene.step / 2));
  s.loop.policy = parseOverrunPolicy(
      privateParameter<std::string>("overrun", "skip, catch_up or stop", "skip"));
  return s;
}

void run() {
  ros::NodeHandle node(twinNamespace());
  ros::NodeHandle private_node("~");
  usePlugins();
  const ParameterTree given = parameterTree(node, "scene");
  const Scene scene = withStepsChosen(readScene(given.tree, given.source));
  const SimulationSettings settings = readSettings(scene);

  // Half a second of records, or some: what the publisher may be late by.
  const auto capacity =
      static_cast<std::size_t>(std::max<std::int64_t>(64, 500'000'000 / scene.step));
  LiveTwin live(scene, std::min<std::size_t>(capacity, 100'000));
  live.setPace(settings.real_time_factor);
  FixedRateLoop loop(settings.loop);
  const SceneLines lines = sceneLines(given.tree, live.twin());
  std::optional<Checkpoint> resumed;
  if (!settings.resume.empty()) {
    resumed = readCheckpoint(settings.resume);
    requireScene(*resumed, lines, settings.resume);
  }
  TwinServices services(live, private_node,
                        [&] { return !stopRequested() && ros::ok() && loop.running(); });
  if (resumed) {
    services.goOnFrom(*resumed, settings.resume);
  }
  if (settings.paused) {
    live.putBack(true);
  }
  LockstepListeners lockstep(live, node, settings.lockstep);
  RecordPublisher publisher(
      live, loop,
      StatePublisher(live.twin(), live.ensembles(), node,
                     LcmPublisher(settings.lcm_url, settings.lcm_prefix),
                     settings.clock ? std::llround(1.0e9 / settings.clock_rate) : 0),
      lockstep, sceneText(given.tree, given.source), settings.every, settings.batch, settings.clock,
      settings.measure);
  if (resumed) {
    publisher.putBack(*resumed, settings.resume);
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
  LcmRivals rivals(settings.lcm_prefix);
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

  // Wall time: simulated time stands still in a pause and goes back in a reset.
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
  return whirl_twin::runNode(argc, argv, "simulation_node", whirl_twin::kHelp, whirl_twin::run);
}
