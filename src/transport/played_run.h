// What the player says of the run it plays, on the loop's channel: that it is held, and that its
// time begins anew. A monitor then takes neither the end of a log for a loss of data nor a jump
// back for messages out of order.
#pragma once

#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <optional>
#include <string>

#include "messages/message.h"
#include "transport/lcm_publisher.h"

namespace whirl_twin {

class PlayedRun {
 public:
  PlayedRun(std::shared_ptr<lcm::LCM> lcm, const std::string& prefix, std::int64_t started)
      : lcm_(std::move(lcm), prefix), started_(started) {}

  /// A message that is about to be played. Returns whether it has been sent here in place of the
  /// log's own, which says what is not so any more.
  bool take(const Message& message);

  /// From now on it is held, or goes on.
  void hold(bool held);

  /// What comes next is at another time, maybe an earlier one.
  void jump() { jumped_ = heard_; }

 private:
  void say(std::uint64_t epoch, std::int64_t later);

  LcmPublisher lcm_;
  std::int64_t started_;  ///< [ns], for a log that does not tell when its run was
  state::LoopStatistics loop_;
  state::Instant now_;
  bool heard_ = false;  ///< a message with an instant
  bool told_ = false;   ///< the log has said something about its loop
  bool jumped_ = false;
  std::uint64_t jumps_ = 0;
};

}  // namespace whirl_twin
