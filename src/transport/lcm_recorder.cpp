#include "transport/lcm_recorder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "messages/input_error.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_event_log.h"

namespace whirl_twin {

LcmRecorder::LcmRecorder(std::shared_ptr<lcm::LCM> lcm, const std::string& pattern,
                         const std::string& path)
    : lcm_(std::move(lcm)), path_(path), file_(path, "w") {
  if (!file_.good()) {
    throwLogNotWritten(path_, errno);
  }
  subscription_ =
      lcm_subscribe(lcm_->getUnderlyingLCM(), pattern.c_str(), &LcmRecorder::take, this);
  if (subscription_ == nullptr) {
    throw LcmNotAvailable(fmt::format("LCM cannot receive {} (is multicast enabled?)", pattern));
  }
  lcm_subscription_set_queue_capacity(subscription_, 0);
}

LcmRecorder::~LcmRecorder() {
  lcm_unsubscribe(lcm_->getUnderlyingLCM(), subscription_);
}

int LcmRecorder::record(std::chrono::milliseconds timeout, int most) {
  const int handled = handleArrived(*lcm_, timeout, most);
  if (error_ == 0 && std::fflush(file_.getFilePtr()) != 0) {
    error_ = errno;
  }
  if (error_ != 0) {
    throwLogNotWritten(path_, error_);
  }
  return handled;
}

void LcmRecorder::take(const lcm_recv_buf_t* buffer, const char* channel, void* recorder) {
  auto& self = *static_cast<LcmRecorder*>(recorder);
  lcm::LogEvent event{0, buffer->recv_utime, channel, static_cast<std::int32_t>(buffer->data_size),
                      buffer->data};
  if (self.file_.writeEvent(&event) == 0) {
    ++self.recorded_;
  } else if (self.error_ == 0) {
    self.error_ = errno;
  }
}

}  // namespace whirl_twin
