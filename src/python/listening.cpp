#include "python/listening.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "messages/input_error.h"
#include "python/conversions.h"
#include "reports/output.h"

namespace py = pybind11;

namespace whirl_twin {

namespace {

constexpr std::chrono::milliseconds kLook{50};  // for signals
constexpr std::int64_t kStepsPerNotice = 256;   // of progress

class ThreadProgress final : public WorkProgress {
 public:
  void begin(const std::string&, std::int64_t steps, bool) override {
    steps_ = std::max<std::int64_t>(1, steps);
  }
  std::int64_t show(std::int64_t done) override {
    done_.store(done, std::memory_order_relaxed);
    if (stop_.load(std::memory_order_relaxed)) {
      throw RunFailure("interrupted");
    }
    return kStepsPerNotice;
  }
  void clear() override {}
  bool interrupted() override { return stop_.load(std::memory_order_relaxed); }
  std::atomic<bool>& stop() override { return stop_; }

  double part() const {
    return std::min(1.0, static_cast<double>(done_.load()) / static_cast<double>(steps_.load()));
  }

 private:
  std::atomic<std::int64_t> steps_{1};
  std::atomic<std::int64_t> done_{0};
  std::atomic<bool> stop_{false};
};

std::mutex messages_mutex;
std::vector<std::string> messages;

}  // namespace

void takeMessages() {
  setMessageSink([](const std::string& message) {
    const std::lock_guard<std::mutex> lock(messages_mutex);
    messages.push_back(message);
  });
}

void handOnMessages() {
  std::vector<std::string> taken;
  {
    const std::lock_guard<std::mutex> lock(messages_mutex);
    taken.swap(messages);
  }
  if (taken.empty()) {
    return;
  }
  const py::object warn =
      py::module_::import("logging").attr("getLogger")("whirl_twin").attr("warning");
  for (std::string& message : taken) {
    message.erase(message.find_last_not_of('\n') + 1);
    constexpr const char* kProgram = "twin: ";
    if (message.rfind(kProgram, 0) == 0) {
      message.erase(0, std::char_traits<char>::length(kProgram));
    }
    warn("%s", pythonText(message));
  }
}

void requireNoSignal() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) {
    throw py::error_already_set();
  }
}

void runListening(const py::object& progress, const std::function<void(WorkProgress&)>& work) {
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0) {
    throw py::type_error("progress: must be a function of one number, or None");
  }
  ThreadProgress shared;
  std::mutex mutex;
  std::condition_variable ended;
  bool has_ended = false;
  std::exception_ptr failure;  // of the work
  std::optional<py::error_already_set> python_error;
  const auto look = [&](double part) {
    try {
      if (PyErr_CheckSignals() != 0) {
        throw py::error_already_set();
      }
      handOnMessages();
      if (!progress.is_none()) {
        progress(part);
      }
    } catch (py::error_already_set& error) {
      python_error.emplace(std::move(error));
      shared.stop().store(true);
    }
  };
  std::thread thread([&] {
    try {
      work(shared);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(mutex);
    has_ended = true;
    ended.notify_one();
  });
  {
    const py::gil_scoped_release release;
    std::unique_lock<std::mutex> lock(mutex);
    while (!ended.wait_for(lock, kLook, [&] { return has_ended; })) {
      if (python_error) {
        continue;
      }
      lock.unlock();
      {
        const py::gil_scoped_acquire acquire;
        look(shared.part());
      }
      lock.lock();
    }
    lock.unlock();
    thread.join();
  }
  if (!python_error) {
    look(failure ? shared.part() : 1.0);
  }
  if (python_error) {
    throw py::error_already_set(std::move(*python_error));
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

}  // namespace whirl_twin
