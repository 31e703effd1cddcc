#include "web/web_publisher.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "messages/wall_clock.h"
#include "twin/loop_report.h"
#include "web/scene_description.h"

namespace whirl_twin {

namespace {

constexpr double kReportPeriod = 1.0;          // s
constexpr double kPicturePeriod = 1.0 / 30.0;  // s
constexpr double kStillPeriod = 0.5;           // s, of pictures that do not change
constexpr double kMonitorPeriod = 0.005;       // s
constexpr auto kIdleTime = std::chrono::microseconds(500);
constexpr int kMaxRecords = 64;  // between periodic tasks
constexpr std::size_t kMaxWaitingTasks = 64;

/// [s], wall time.
double steadyTime() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

/// Takes the messages of a step.
struct WebPublisher::Sink {
  WebPublisher& to;
  double now;

  template <class Make>
  void operator()(const std::string& subject, Make make) {
    using State = decltype(make());
    const bool sent = to.state_is_due_ && to.channels_.wanted(topicName(State::kKind, subject));
    if (!sent && !IsWatchedState<State>::value) {
      return;
    }
    const State state = make();
    if constexpr (IsWatchedState<State>::value) {
      to.monitor_.take(state, now);
    }
    if (sent) {
      to.channels_.send(state);
    }
  }
  void change(const state::ParameterChange& change) {
    to.monitor_.take(change);
    to.channels_.send(change);
    std::vector<ParameterValue> values;
    for (std::size_t i = 0; i < change.names.size(); ++i) {
      values.emplace_back(parameterName(change.system, change.names[i]), change.values[i]);
    }
    to.server_.post([&protocol = to.protocol_, values] { protocol.updateParameters(values); });
  }
  void again(const state::ParameterChange&) {}  // its channel is latched
};

WebPublisher::WebPublisher(LiveTwin& live, const FixedRateLoop& loop, WebServer& server,
                           Protocol& protocol, const AlarmSettings& alarms, std::int64_t every,
                           bool read_only)
    : live_(live),
      loop_(loop),
      server_(server),
      protocol_(protocol),
      channels_(server, protocol, "/twin"),
      observer_(live.twin(), live.generations()),
      orders_(live.twin()),
      ensembles_(live.ensembles()),
      messages_(live.twin().built()),
      monitor_(live.twin().built(), alarms, EvaluationQueue::Mode::kConcurrent),
      thinning_(live.ringCapacity()),
      every_(every),
      stopped_(live.twin().systems().size()),
      newest_step_(live.stepCount()),
      started_(wallClock()) {
  setStamp(newest_step_);
  addChannels(live.twin(), read_only);
}

WebPublisher::~WebPublisher() {
  join();
}

void WebPublisher::addChannels(const Twin& twin, bool read_only) {
  addTwinChannels(channels_, twin.built(), messages_);
  for (const SharedSystem& system : twin.systems()) {
    pictures_.emplace_back(*system->dynamics);
  }
  const Json scene = sceneDescription(twin.built(), read_only);
  addParameters(protocol_, scene);
  channels_.sendForPage(kSceneTopic, scene);
}

void WebPublisher::start() {
  thread_ = std::thread([this] { run(); });
}

void WebPublisher::join() {
  ending_.store(true);
  if (thread_.joinable()) {
    thread_.join();
  }
}

bool WebPublisher::post(std::function<void(TwinMonitor&, double)> task) {
  const std::lock_guard<std::mutex> lock(tasks_mutex_);
  if (tasks_.size() >= kMaxWaitingTasks) {
    return false;
  }
  tasks_.push_back(std::move(task));
  return true;
}

void WebPublisher::run() {
  std::vector<double> record(live_.twin().layout().size);
  double next_picture = 0.0, next_still = 0.0, next_monitored = 0.0;
  double next_report = steadyTime() + kReportPeriod;
  report(steadyTime());  // identifies the run before its first state
  channels_.sendAlerts({});
  while (!ending_.load()) {
    int taken = 0;
    while (taken < kMaxRecords && live_.pop(record.data())) {
      take(record.data());
      thinning_.consumed(live_.waiting());
      ++taken;
    }
    const double now = steadyTime();
    if (taken > 0) {
      state_is_due_ = true;
      messages_.tellEnsembles(
          observer_,
          [this](std::size_t system, const state::Instant& at, state::EnsembleState& out) {
            return ensembles_.take(system, at, out);
          },
          Sink{*this, now});
      next_still = now;
    }
    if (now >= next_picture && now >= next_still) {
      sendPictures();
      next_picture = now + kPicturePeriod;
      next_still = now + kStillPeriod;
    }
    if (std::exchange(stopped_now_, false) || now >= next_report) {
      report(now);
      channels_.sendServer("");
      next_report = now + kReportPeriod;
    }
    if (now >= next_monitored) {
      sendMonitored(now);
      next_monitored = now + kMonitorPeriod;
    }
    channels_.flush();
    if (taken < kMaxRecords) {
      std::this_thread::sleep_for(kIdleTime);
    }
  }
}

void WebPublisher::take(const double* record) {
  const std::int64_t step = RecordLayout::step(record);
  const bool restarted = step < newest_step_;
  newest_step_ = step;
  const bool due = step % thinning_.every() == 0;
  const bool orders_due = orders_.dueAt(step);
  left_out_ += due ? 0 : 1;
  if (!due && !orders_due && observer_.look(record)) {
    orders_.take(record, observer_);
    return;
  }
  if (restarted) {
    earlier_steps_ += observer_.step() + 1;
  }
  observer_.observe(record);
  orders_.take(record, observer_);
  setStamp(step);
  const double now = steadyTime();
  if (restarted) {
    report(now);  // the new epoch precedes its states
    for (SystemPicture& picture : pictures_) {
      picture.restart();
    }
  }
  const bool moved = !observer_.tellsOnlyChange();
  state_is_due_ =
      due && step / thinning_.every() % std::max<std::int64_t>(1, every_ / thinning_.every()) == 0;
  messages_.tell(observer_, due && moved, Sink{*this, now});
  if (orders_due && moved) {
    state_is_due_ = true;
    messages_.tellOrders(observer_, orders_, Sink{*this, now});
  }
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    const bool stopped = observer_.status(i) != StepStatus::kOk;
    stopped_now_ = stopped_now_ || (stopped && !stopped_[i]);
    stopped_[i] = stopped;
    if (due && moved && !stopped &&
        channels_.wanted(pictureTopic(live_.twin().systems()[i]->spec.name))) {
      pictures_[i].sample(motionOf(i), *dynamicsOf(i));
    }
  }
}

/// Simulated time, which continues across a reset: clients require a clock that does not go back.
void WebPublisher::setStamp(std::int64_t step) {
  const Scene& scene = live_.twin().scene();
  const std::int64_t stamp =
      std::max<std::int64_t>(0, scene.time) + (earlier_steps_ + step) * scene.step;
  observer_.setStamp(stamp);
  channels_.setStamp(stamp);
}

/// With the parameters of the newest record.
std::shared_ptr<const Dynamics> WebPublisher::dynamicsOf(std::size_t system) const {
  return live_.generations()->at(system, observer_.generation(system))->dynamics;
}

void WebPublisher::sendPictures() {
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    const std::string topic = pictureTopic(live_.twin().systems()[i]->spec.name);
    if (channels_.wanted(topic)) {
      channels_.sendForPage(topic, pictures_[i].take(motionOf(i), *dynamicsOf(i)));
    }
  }
  server_.post([&protocol = protocol_, stamp = channels_.stamp()] { protocol.publishTime(stamp); });
}

PictureMotion WebPublisher::motionOf(std::size_t system) const {
  const Dynamics& dynamics = *dynamicsOf(system);
  PictureMotion motion;
  motion.at = observer_.instant();
  motion.shaft = observer_.moment(system);
  motion.stopped = observer_.stopReason(system);
  motion.q = Eigen::Map<const Eigen::VectorXd>(observer_.coordinates(system), dynamics.dof());
  if (dynamics.isRotor()) {
    motion.whirl = observer_.whirlOf(system);
  }
  return motion;
}

void WebPublisher::report(double now) {
  state::LoopStatistics loop =
      loopStatistics(live_.twin(), observer_, loop_.status(), loop_.timing(), live_.paused(),
                     live_.dropped() + left_out_);
  loop.started = started_;
  loop.epoch = live_.resets();
  loop.publish_every = static_cast<std::uint64_t>(thinning_.every());
  loop.real_time_factor = live_.pace();
  loop.achieved_factor = loop.epoch == reported_epoch_
                             ? (loop.at.time - reported_time_) / (now - reported_at_)
                             : std::numeric_limits<double>::quiet_NaN();
  reported_epoch_ = loop.epoch;
  reported_time_ = loop.at.time;
  reported_at_ = now;
  addStepTimes(live_, loop);
  monitor_.take(loop, now);
  channels_.send(loop);
  state::MonitorStatus status = monitor_.status(now, loop.paused);
  status.at.stamp = loop.at.stamp;
  channels_.send(status);
}

void WebPublisher::sendMonitored(double now) {
  std::vector<std::function<void(TwinMonitor&, double)>> tasks;
  {
    const std::lock_guard<std::mutex> lock(tasks_mutex_);
    tasks.swap(tasks_);
  }
  for (const auto& task : tasks) {
    task(monitor_, now);
  }
  monitor_.tick(now, live_.paused());
  for (const state::StabilityMargin& margin : monitor_.takeMargins()) {
    channels_.send(margin);
  }
  for (const state::ControllerMargins& margins : monitor_.takeLoopMargins()) {
    channels_.send(margins);
  }
  monitor_.takeOrders();  // of measurements, which no one sends here
  monitor_.alerts().takeEvents();
  if (monitor_.alerts().takeChanged()) {
    channels_.sendAlerts(monitor_.alerts().active());
  }
}

}  // namespace whirl_twin
