#include "tools/channel_filter.h"

#include <fnmatch.h>

#include <algorithm>

namespace whirl_twin {

void addChannelOption(const ProgramCommand& command, ChannelFilter& filter) {
  command
      .option("--channel", filter,
              "only channels (of a bag: topics) that match, such as '*_WHIRL'; may be repeated")
      .type("PATTERN")
      .oneByOne();
}

bool selects(const ChannelFilter& filter, const std::string& channel) {
  return filter.empty() ||
         std::any_of(filter.begin(), filter.end(), [&](const std::string& pattern) {
           return fnmatch(pattern.c_str(), channel.c_str(), 0) == 0;
         });
}

}  // namespace whirl_twin
