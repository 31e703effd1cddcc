#include "nodes/command_lease.h"

#include <fmt/format.h>

namespace whirl_twin {

std::string CommandLease::ask(const std::string& sender, double now) {
  const std::string other = holder(now);
  if (!other.empty() && other != sender) {
    return fmt::format("{} has the command for another {:.1f} s, longer if it sends more commands",
                       other, until_ - now);
  }
  holder_ = sender;
  until_ = now + duration_;
  return "";
}

void CommandLease::release(const std::string& sender) {
  if (sender == holder_) {
    until_ = -1.0;
  }
}

}  // namespace whirl_twin
