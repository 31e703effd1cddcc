// A twin that runs in real time with its monitor and a web server in one process, without ROS.
//
// Threads: the loop steps and writes records into a ring; WebPublisher takes them, monitors them
// and makes messages; the server's thread does input and output; the thread of run() carries out
// what clients request. Only the ring and the command queue of LiveTwin touch the loop.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "monitoring/alarm_settings.h"
#include "realtime/fixed_rate_loop.h"
#include "twin/live_commands.h"
#include "twin/live_twin.h"
#include "web/protocol.h"
#include "web/web_publisher.h"
#include "web/web_server.h"

namespace whirl_twin {

struct ServeSettings {
  WebAccess access;
  WebLimits limits;
  WebFiles files;
  AlarmSettings alarms;
  double rate = 100.0;  ///< [Hz, simulated], of the states that clients receive; 0: every step
  double real_time_factor = 1.0;
  bool paused = false;
  bool read_only = false;
  RealtimeMode realtime = RealtimeMode::kIgnore;
};

class ServedTwin : private WebRequests {
 public:
  /// go_on: from any thread; false ends run(). Throws InputError, SceneError, RunFailure.
  ServedTwin(const Scene& scene, const ServeSettings& settings, std::function<bool()> go_on);
  ~ServedTwin();

  std::string url() const { return urlOf(server_.access()); }
  /// Runs until go_on() is false. Returns whether it was so, and not the end of the loop.
  bool run();
  std::int64_t steps() const { return live_.stepCount(); }

 private:
  using Task = std::function<void()>;

  bool setParameters(ClientId client, std::vector<ParameterValue> values, std::string id) override;
  bool callService(ClientId client, std::size_t service, std::uint32_t call, Json request) override;
  bool setInputs(ClientId client, state::InputCommand inputs) override;
  void carryOut(ClientId client, const std::vector<ParameterValue>& values, const std::string& id);
  void carryOut(ClientId client, std::size_t service, std::uint32_t call, const Json& request);
  CommandResult commandOf(const std::string& service, const Json& request);
  bool alarmCommand(ClientId client, std::size_t service, std::uint32_t call, const Json& request);
  bool enqueue(Task task);
  void runTasks();
  void stop();

  std::function<bool()> go_on_;
  LiveTwin live_;
  FixedRateLoop loop_;
  LiveCommands commands_;
  WebServer server_;
  Protocol protocol_;
  WebPublisher publisher_;
  std::mutex tasks_mutex_;
  std::deque<Task> tasks_;
};

}  // namespace whirl_twin
