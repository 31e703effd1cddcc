// Takes the records of a running twin from its ring, monitors them, and hands messages to the
// clients: states, pictures, alerts, margins, statistics. One thread; it computes only what a
// client receives, and waits for none.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "messages/message.h"
#include "monitoring/twin_monitor.h"
#include "realtime/even_thinning.h"
#include "realtime/fixed_rate_loop.h"
#include "twin/ensemble_observer.h"
#include "twin/live_twin.h"
#include "twin/observer.h"
#include "twin/order_observer.h"
#include "twin/step_messages.h"
#include "web/protocol.h"
#include "web/system_picture.h"
#include "web/web_channels.h"

namespace whirl_twin {

class WebPublisher {
 public:
  /// Adds the channels and parameters to the protocol; the server has not started. every: steps
  /// from one state that clients receive to the next. The referenced objects must outlive it.
  WebPublisher(LiveTwin& live, const FixedRateLoop& loop, WebServer& server, Protocol& protocol,
               const AlarmSettings& alarms, std::int64_t every, bool read_only);
  ~WebPublisher();
  WebPublisher(const WebPublisher&) = delete;
  WebPublisher& operator=(const WebPublisher&) = delete;

  void start();
  void join();

  /// Any thread: runs a task on the monitor in the publisher's thread, with the wall time [s].
  /// False: too many wait.
  bool post(std::function<void(TwinMonitor&, double)> task);

 private:
  struct Sink;

  void addChannels(const Twin& twin, bool read_only);
  void run();
  void take(const double* record);
  void sendPictures();
  void report(double now);
  void sendMonitored(double now);
  std::shared_ptr<const Dynamics> dynamicsOf(std::size_t system) const;
  PictureMotion motionOf(std::size_t system) const;
  void setStamp(std::int64_t step);

  LiveTwin& live_;
  const FixedRateLoop& loop_;
  WebServer& server_;
  Protocol& protocol_;
  WebChannels channels_;
  Observer observer_;
  OrderObserver orders_;
  EnsembleObserver ensembles_;
  StepMessages messages_;
  TwinMonitor monitor_;
  EvenThinning thinning_;
  std::int64_t every_;  // steps
  std::vector<SystemPicture> pictures_;
  std::vector<bool> stopped_;
  std::int64_t newest_step_;
  std::int64_t earlier_steps_ = 0;  // before the last reset: stamps do not go back
  std::uint64_t left_out_ = 0;
  bool state_is_due_ = false;  // for clients, at the present step
  bool stopped_now_ = false;
  std::int64_t started_;  // [ns], wall clock
  // Of the previous report.
  std::uint64_t reported_epoch_ = 0;
  double reported_time_ = 0.0;                                     // [s], simulated
  double reported_at_ = std::numeric_limits<double>::quiet_NaN();  // [s], wall time
  std::mutex tasks_mutex_;
  std::vector<std::function<void(TwinMonitor&, double)>> tasks_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace whirl_twin
