// Saves the twin in a file, every so often while it runs and when it has ended. The loop takes its
// state between two steps, the publisher what it knows beside it; a thread of its own writes the
// file, which others do not wait for.
#pragma once

#include <chrono>
#include <future>
#include <string>

#include "nodes/record_publisher.h"
#include "nodes/twin_services.h"

namespace whirl_twin {

class CheckpointSaver {
 public:
  /// path: empty, nothing is saved. What is referred to outlives it. period [s]. Throws Refusal
  /// where the twin's state cannot be saved, RunFailure where the file cannot be written.
  CheckpointSaver(LiveTwin& live, SceneLines scene, std::string path, double period,
                  TwinServices& services, RecordPublisher& publisher);

  /// For the thread of the services, often.
  void saveIfDue();
  /// The loop and the publisher have ended.
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
  std::future<std::string> writing_;  // what went wrong; "" nothing
};

}  // namespace whirl_twin
