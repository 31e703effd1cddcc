// What clients of web_node request, by the services of the simulation and of the monitor, which
// check it: their answers go back to the client.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "web/protocol.h"

namespace whirl_twin {

/// Executes tasks one after the other in a thread.
class TaskThread {
 public:
  TaskThread();
  /// Waits for the task in progress; leaves the others out.
  ~TaskThread();
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  /// False: too many wait.
  bool put(std::function<void()> task);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<std::function<void()>> tasks_;
  bool ending_ = false;
  std::thread thread_;  // last: it uses the other members
};

class WebCommands : public WebRequests {
 public:
  /// simulation, monitor: the nodes whose services are called.
  WebCommands(WebServer& server, std::string simulation, std::string monitor);
  /// Before the server starts; must outlive it.
  void answerBy(Protocol& protocol) { protocol_ = &protocol; }

  bool setParameters(ClientId client, std::vector<ParameterValue> values, std::string id) override;
  bool callService(ClientId client, std::size_t service, std::uint32_t call, Json request) override;
  bool setInputs(ClientId client, state::InputCommand inputs) override;

 private:
  struct Answer {
    bool done = false;
    std::string message;
    std::int64_t step = 0;
  };
  template <class Service>
  static Answer callNode(const std::string& name, Service& exchange);
  template <class Service>
  Answer callTwin(const std::string& name, Service exchange) const;
  template <class Service>
  Answer callMonitor(const std::string& name, Service exchange) const;
  Answer carryOut(const std::string& service, const Json& request) const;

  WebServer& server_;
  Protocol* protocol_ = nullptr;
  std::string simulation_, monitor_;
  TaskThread commands_;
  TaskThread urgent_;  // pause and alarms, which must not wait for a long step
};

}  // namespace whirl_twin
