#include "nodes/checkpoint_saver.h"

#include <ros/ros.h>

#include <optional>
#include <utility>

#include "messages/input_error.h"

namespace whirl_twin {

namespace {

std::string whyNotWritten(const std::string& path, const std::string& bytes) {
  try {
    writeCheckpoint(path, bytes);
    return "";
  } catch (const RunFailure& error) {
    return error.what();
  }
}

}  // namespace

CheckpointSaver::CheckpointSaver(LiveTwin& live, SceneLines scene, std::string path, double period,
                                 TwinServices& services, RecordPublisher& publisher)
    : path_(std::move(path)),
      period_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(period))),
      services_(services),
      publisher_(publisher),
      next_(Clock::now() + period_) {
  if (path_.empty()) {
    return;
  }
  checkpoint_.scene = std::move(scene);
  // Saves once before the run: reports early that the state cannot be saved, and the file exists.
  try {
    checkpoint_.twin = imageOf(live.atRest());
  } catch (const InputError& error) {
    throw InputError(std::string("checkpoint: ") + error.what());
  }
  services_.takeAtRest(checkpoint_);
  take(publisher_.savedAtEnd());
  writeCheckpoint(path_, bytesOf(checkpoint_));
}

void CheckpointSaver::saveIfDue() {
  if (path_.empty() || Clock::now() < next_) {
    return;
  }
  if (writing_.valid() && writing_.wait_for(Clock::duration::zero()) != std::future_status::ready) {
    return;  // a slow disk
  }
  finishWriting();
  next_ = Clock::now() + period_;
  if (!services_.take(checkpoint_)) {
    return;
  }
  if (std::optional<SavedObserver> observer = publisher_.savedAt(checkpoint_.step)) {
    take(std::move(*observer));
    write();
  }
}

void CheckpointSaver::saveAtEnd() {
  if (path_.empty()) {
    return;
  }
  finishWriting();
  services_.takeAtRest(checkpoint_);
  take(publisher_.savedAtEnd());
  write();
  finishWriting();
}

void CheckpointSaver::take(SavedObserver observer) {
  checkpoint_.observer = std::move(observer.image);
  checkpoint_.live["clock_steps"] = observer.clock_steps;
}

void CheckpointSaver::write() {
  writing_ = std::async(std::launch::async, whyNotWritten, path_, bytesOf(checkpoint_));
}

void CheckpointSaver::finishWriting() {
  if (!writing_.valid()) {
    return;
  }
  const std::string why = writing_.get();
  if (!why.empty()) {
    ROS_ERROR_THROTTLE(10.0, "checkpoint: %s", why.c_str());
  }
}

}  // namespace whirl_twin
