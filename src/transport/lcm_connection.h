// Opening LCM, with a sentence a person can act on when it does not open.
#pragma once

#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <stdexcept>
#include <string>

namespace whirl_twin {

/// LCM did not open; what() says at which url and what to do about it.
class LcmNotAvailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An open LCM at `url`, e.g. kDefaultLcmUrl. Throws LcmNotAvailable.
std::shared_ptr<lcm::LCM> openLcm(const std::string& url);

}  // namespace whirl_twin
