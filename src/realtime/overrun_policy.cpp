#include "realtime/overrun_policy.h"

#include <stdexcept>

#include "messages/refusal.h"

namespace whirl_twin {

std::string toString(OverrunPolicy policy) {
  switch (policy) {
    case OverrunPolicy::kSkip:
      return "skip";
    case OverrunPolicy::kCatchUp:
      return "catch_up";
    case OverrunPolicy::kStop:
      return "stop";
  }
  throw std::logic_error("overrun policy: not one of the enumeration");
}

OverrunPolicy parseOverrunPolicy(const std::string& name) {
  for (const OverrunPolicy policy :
       {OverrunPolicy::kSkip, OverrunPolicy::kCatchUp, OverrunPolicy::kStop}) {
    if (name == toString(policy)) {
      return policy;
    }
  }
  throw Refusal("overrun policy: must be skip, catch_up or stop, found \"" + name + "\"");
}

}  // namespace whirl_twin
