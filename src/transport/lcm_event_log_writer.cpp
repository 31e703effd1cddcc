#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "transport/lcm_converters.h"
#include "transport/lcm_decode.h"
#include "transport/lcm_event_log.h"

namespace whirl_twin {
namespace {

[[noreturn]] void throwCannotWrite(const std::string& path) {
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
}

}  // namespace

EventLogWriter::EventLogWriter(const std::string& path) : path_(path), file_(path, "w") {
  if (!file_.good()) {
    throwCannotWrite(path_);
  }
}

template <class State>
void EventLogWriter::writeEvent(const State& state) {
  const auto message = toLcm(state);
  payload_.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(payload_.data(), 0, static_cast<int>(payload_.size()));
  lcm::LogEvent event{};
  event.timestamp = message.utime;
  event.channel = channelOf(state);
  event.datalen = static_cast<std::int32_t>(payload_.size());
  event.data = payload_.data();
  if (file_.writeEvent(&event) != 0) {
    throwCannotWrite(path_);
  }
}

void EventLogWriter::write(const state::WhirlState& whirl) {
  writeEvent(whirl);
}

void EventLogWriter::write(const state::PendulumState& pendulum) {
  writeEvent(pendulum);
}

void EventLogWriter::write(const state::DriveState& drive) {
  writeEvent(drive);
}

void EventLogWriter::write(const state::MotorState& motor) {
  writeEvent(motor);
}

void EventLogWriter::write(const state::EnsembleState& ensemble) {
  writeEvent(ensemble);
}

void EventLogWriter::write(const state::StabilityMargin& margin) {
  writeEvent(margin);
}

void EventLogWriter::write(const state::ParameterChange& change) {
  writeEvent(change);
}

void EventLogWriter::write(const state::Alert& alert) {
  writeEvent(alert);
}

void EventLogWriter::finish() {
  if (std::fflush(file_.getFilePtr()) != 0 || std::ferror(file_.getFilePtr()) != 0) {
    throwCannotWrite(path_);
  }
}

}  // namespace whirl_twin
