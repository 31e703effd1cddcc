// Saves checkpoints of the twin to a file, periodically and at the end. The loop copies its state
// between two steps, the publisher adds its own; a separate thread writes the file, so that neither
// waits for it.
#pragma once

#include <chrono>
#include <future>
#include <string>

#include "nodes/record_publisher.h"
#include "nodes/twin_services.h"

namespace whirl_twin {

class CheckpointSaver {
 public:
  /// path: empty: nothing is saved. The referenced objects must outlive it. period [s]. Throws
  /// InputError if the twin's state cannot be saved, RunFailure if the file cannot be written.
  CheckpointSaver(LiveTwin& live, SceneLines scene, std::string path, double period,
                  TwinServices& services, RecordPublisher& publisher);

  /// To be called often, by the thread of the services.
  void saveIfDue();
  /// After the loop and the publisher have ended.
  void saveAtEnd();

 private:
  using Clock = std::chrono::steady_clock;

  void write();
  void finishWriting();
  void take(SavedObserver observer);

  std::string path_;
  Clock::duration period_;
  TwinServices& services_;
  RecordPublisher& publisher_;
  Checkpoint checkpoint_;
  Clock::time_point next_;
  std::future<std::string> writing_;  // the error; "" without one
};

}  // namespace whirl_twin
