#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "messages/input_error.h"
#include "transport/lcm_event_log.h"

namespace whirl_twin {

void throwLogNotWritten(const std::string& path, int error) {
  throw RunFailure(fmt::format("{}: cannot be written: {}", path, std::strerror(error)));
}

EventLogWriter::EventLogWriter(const std::string& path) : path_(path), file_(path, "w") {
  if (!file_.good()) {
    throwLogNotWritten(path_, errno);
  }
}

void EventLogWriter::writeEvent(const std::string& channel, std::int64_t utime,
                                const std::uint8_t* data, std::size_t size) {
  lcm::LogEvent event{};
  event.timestamp = utime;
  event.channel = channel;
  event.datalen = static_cast<std::int32_t>(size);
  event.data = const_cast<std::uint8_t*>(data);  // LCM uses the same struct for reading
  if (file_.writeEvent(&event) != 0) {
    throwLogNotWritten(path_, errno);
  }
}

void EventLogWriter::finish() {
  if (std::fflush(file_.getFilePtr()) != 0 || std::ferror(file_.getFilePtr()) != 0) {
    throwLogNotWritten(path_, errno);
  }
}

}  // namespace whirl_twin
