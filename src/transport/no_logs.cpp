// In place of the readers of logs, in a build without LCM.
#include <fmt/format.h>

#include "messages/input_error.h"
#include "transport/logged_messages.h"

namespace whirl_twin {

LoggedMessages readLoggedMessages(const std::string& path, const std::string&, const Kinds&,
                                  const TakeLogged&, const LogProgress&, LogOrder) {
  throw RunFailure(fmt::format(
      "{}: cannot be read: built without LCM: run scripts/setup, then build again", path));
}

std::string outOfOrder(const LoggedMessages&) {
  return "";
}

std::string foundElsewhere(const LoggedMessages&) {
  return "";
}

}  // namespace whirl_twin
