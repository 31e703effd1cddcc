// Opening LCM, with a sentence a person can act on when it does not open.
#pragma once

#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

#include "messages/refusal.h"

namespace whirl_twin {

/// LCM did not open; what() says at which url and what to do about it.
class LcmNotAvailable : public RunFailure {
 public:
  using RunFailure::RunFailure;
};

/// An open LCM at `url`, e.g. kDefaultLcmUrl. Throws LcmNotAvailable.
std::shared_ptr<lcm::LCM> openLcm(const std::string& url);

/// Waits up to `timeout` for an event, then has all that have arrived handled, at most `most` of
/// them. Returns how many.
int handleArrived(lcm::LCM& lcm, std::chrono::microseconds timeout, int most);

}  // namespace whirl_twin
