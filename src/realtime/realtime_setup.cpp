#include "realtime/realtime_setup.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/capability.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "messages/input_error.h"

namespace whirl_twin {
namespace {

// A requested setting was not obtained: an error in mode kEnforce, else a warning.
void notObtained(RealtimeMode mode, const std::string& what, RealtimeStatus& status) {
  if (mode == RealtimeMode::kEnforce) {
    throw RunFailure("realtime enforce: " + what);
  }
  status.warnings.push_back(what);
}

// Whether the calling thread has a capability in effect. (glibc has no wrapper for capget.)
bool hasCapability(unsigned capability) {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[_LINUX_CAPABILITY_U32S_3] = {};
  if (syscall(SYS_capget, &header, data) != 0) {
    return false;
  }
  return (data[CAP_TO_INDEX(capability)].effective & CAP_TO_MASK(capability)) != 0;
}

// Locked memory of the process, the line VmLck of proc(5) [KiB].
long lockedKibibytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    if (word == "VmLck:") {
      long kibibytes = 0;
      status >> kibibytes;
      return kibibytes;
    }
  }
  return 0;
}

std::string policyName(int policy) {
  switch (policy & ~SCHED_RESET_ON_FORK) {
    case SCHED_OTHER:
      return "SCHED_OTHER";
    case SCHED_FIFO:
      return "SCHED_FIFO";
    case SCHED_RR:
      return "SCHED_RR";
    case SCHED_BATCH:
      return "SCHED_BATCH";
    case SCHED_IDLE:
      return "SCHED_IDLE";
    default:
      return fmt::format("policy {}", policy);
  }
}

}  // namespace

std::string toString(RealtimeMode mode) {
  switch (mode) {
    case RealtimeMode::kEnforce:
      return "enforce";
    case RealtimeMode::kWarn:
      return "warn";
    case RealtimeMode::kIgnore:
      return "ignore";
  }
  throw std::logic_error("realtime mode: not one of the enumeration");
}

RealtimeMode parseRealtimeMode(const std::string& name) {
  for (const RealtimeMode mode :
       {RealtimeMode::kEnforce, RealtimeMode::kWarn, RealtimeMode::kIgnore}) {
    if (name == toString(mode)) {
      return mode;
    }
  }
  throw InputError("realtime: must be enforce, warn or ignore, found \"" + name + "\"");
}

void lockMemory(RealtimeMode mode, RealtimeStatus& status) {
  if (mode == RealtimeMode::kIgnore) {
    status.memory_locked = lockedKibibytes() > 0;
    return;
  }
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  if (limit.rlim_cur != RLIM_INFINITY && !hasCapability(CAP_IPC_LOCK)) {
    notObtained(mode,
                fmt::format("memory is not locked: expected an unlimited memlock limit "
                            "(/etc/security/limits.conf) or CAP_IPC_LOCK, found a limit of {} KiB",
                            limit.rlim_cur / 1024),
                status);
    return;
  }
  // The order of the man page of mlockall for real-time: lock the existing heap first, then prevent
  // malloc from returning memory, and take large blocks from the heap, not from mmap. Later
  // allocations are locked page by page on the first write: a message length announced by a client
  // of a port (ROS allocates it at once) uses no memory before so much data arrives.
  if (mlockall(MCL_CURRENT) != 0 || mlockall(MCL_FUTURE | MCL_ONFAULT) != 0) {
    notObtained(mode, fmt::format("memory is not locked: mlockall: {}", std::strerror(errno)),
                status);
    return;
  }
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_MMAP_MAX, 0);
  status.memory_locked = lockedKibibytes() > 0;
  if (!status.memory_locked) {
    notObtained(mode, "memory is not locked: mlockall succeeded, but VmLck is 0", status);
  }
}

void touchMemory() {
  constexpr std::size_t kStack = 256 * 1024;  // bytes
  constexpr std::size_t kBlock = 64 * 1024;   // bytes, allocated by malloc on the heap, not by mmap
  constexpr std::size_t kBlocks = 24;
  std::array<char, kStack> stack;  // NOLINT: written next
  explicit_bzero(stack.data(), kStack);
  static_cast<void>(std::vector<std::vector<char>>(kBlocks, std::vector<char>(kBlock)));
}

void scheduleThisThread(RealtimeMode mode, int priority, RealtimeStatus& status) {
  sched_param wanted{};
  wanted.sched_priority = priority;
  const int error = mode == RealtimeMode::kIgnore
                        ? 0
                        : pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);

  int policy = SCHED_OTHER;
  sched_param obtained{};
  pthread_getschedparam(pthread_self(), &policy, &obtained);
  status.policy = policyName(policy);
  status.priority = obtained.sched_priority;
  if (mode == RealtimeMode::kIgnore) {
    return;
  }
  // Without a real-time policy the kernel may delay a wake-up by this slack, 50 us by default.
  prctl(PR_SET_TIMERSLACK, 1UL);
  if (error != 0) {
    rlimit limit{};
    getrlimit(RLIMIT_RTPRIO, &limit);
    notObtained(mode,
                fmt::format("no real-time scheduling: SCHED_FIFO priority {}: {}: expected "
                            "CAP_SYS_NICE or an rtprio limit of at least {} "
                            "(/etc/security/limits.conf), found a limit of {}",
                            priority, std::strerror(error), priority, limit.rlim_cur),
                status);
  } else if (policy != SCHED_FIFO || obtained.sched_priority != priority) {
    notObtained(mode,
                fmt::format("no real-time scheduling: expected SCHED_FIFO priority {}, found {} "
                            "priority {} when read back",
                            priority, status.policy, status.priority),
                status);
  }
}

void keepThisThreadTo(int cpu, RealtimeMode mode, RealtimeStatus& status) {
  int error = 0;
  if (cpu >= 0) {
    cpu_set_t wanted;
    CPU_ZERO(&wanted);
    CPU_SET(static_cast<std::size_t>(cpu), &wanted);
    error = pthread_setaffinity_np(pthread_self(), sizeof(wanted), &wanted);
  }
  cpu_set_t obtained;
  CPU_ZERO(&obtained);
  pthread_getaffinity_np(pthread_self(), sizeof(obtained), &obtained);
  status.cpu = -1;
  for (int i = 0; CPU_COUNT(&obtained) == 1 && i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(static_cast<std::size_t>(i), &obtained)) {
      status.cpu = i;
    }
  }
  if (error != 0 && mode != RealtimeMode::kIgnore) {
    notObtained(mode,
                fmt::format("not pinned to processor {}: {}: must be a processor that this process "
                            "may use (taskset -cp {})",
                            cpu, std::strerror(error), getpid()),
                status);
  }
}

ProcessorAwake::ProcessorAwake(RealtimeMode mode, RealtimeStatus& status) {
  if (mode == RealtimeMode::kIgnore) {
    return;
  }
  constexpr const char* kFile = "/dev/cpu_dma_latency";
  const std::int32_t longest_wake_up = 0;  // [us]; the kernel applies it while the file is open
  file_ = open(kFile, O_WRONLY | O_CLOEXEC);
  if (file_ < 0 || write(file_, &longest_wake_up, sizeof longest_wake_up) < 0) {
    status.warnings.push_back(
        fmt::format("processors may enter deep sleep: {}: {}", kFile, std::strerror(errno)));
  }
}

ProcessorAwake::~ProcessorAwake() {
  if (file_ >= 0) {
    close(file_);
  }
}

std::uint64_t threadPageFaults() noexcept {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return static_cast<std::uint64_t>(usage.ru_minflt) + static_cast<std::uint64_t>(usage.ru_majflt);
}

std::string kernelDescription() {
  utsname name{};
  uname(&name);
  return std::string(name.release) + " " + name.version;
}

}  // namespace whirl_twin
