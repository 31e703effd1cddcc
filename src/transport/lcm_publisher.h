// States out to LCM, each on its channel. Belongs to a publisher thread: it allocates and writes to
// a socket.
#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>
#include <utility>

#include "messages/alert.h"
#include "messages/stability_margin.h"
#include "messages/states.h"

namespace whirl_twin {

class LcmPublisher {
 public:
  /// Opens LCM at `url`. An empty url means off. If LCM cannot be opened (no multicast route, a
  /// malformed url) the publisher stays off and warning() says so.
  explicit LcmPublisher(const std::string& url);

  /// Publishes on an LCM that is open already, e.g. "memq://" in a test.
  explicit LcmPublisher(std::shared_ptr<lcm::LCM> lcm) : lcm_(std::move(lcm)) {}

  bool on() const { return lcm_ != nullptr; }

  /// Why LCM is off although it was asked for; empty when all is well.
  const std::string& warning() const { return warning_; }

  // Each does nothing while off.
  void publish(const state::WhirlState& whirl);
  void publish(const state::PendulumState& pendulum);
  void publish(const state::DriveState& drive);
  void publish(const state::MotorState& motor);
  void publish(const state::EnsembleState& ensemble);
  void publish(const state::StabilityMargin& margin);
  void publish(const state::ParameterChange& change);
  void publish(const state::Alert& alert);

  /// Messages handed to LCM, and messages LCM could not send.
  std::uint64_t sent() const { return sent_; }
  std::uint64_t failed() const { return failed_; }

 private:
  template <class State>
  void send(const State& state);

  std::shared_ptr<lcm::LCM> lcm_;
  std::string warning_;
  std::uint64_t sent_ = 0;
  std::uint64_t failed_ = 0;
};

}  // namespace whirl_twin
