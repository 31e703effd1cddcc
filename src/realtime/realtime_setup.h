// Real-time settings of Linux for a user-space thread: locked memory, a real-time scheduling
// policy, a processor without deep sleep states. The obtained settings are read back and reported,
// never assumed. (mlockall(2), mallopt(3), sched(7), getrusage(2), Linux's PM QoS interface.)
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace whirl_twin {

/// Handling of real-time settings that are not obtained.
enum class RealtimeMode {
  kEnforce,  ///< the loop does not start without them
  kWarn,     ///< the loop starts with what is available and reports what is missing
  kIgnore    ///< no setting is requested
};

/// "enforce", "warn" or "ignore".
std::string toString(RealtimeMode mode);

/// The inverse of toString. Throws InputError with the name found and those expected.
RealtimeMode parseRealtimeMode(const std::string& name);

/// The settings obtained.
struct RealtimeStatus {
  std::string policy;          ///< of the loop's thread: "SCHED_FIFO", "SCHED_OTHER", ...
  int priority = 0;            ///< real-time priority; 0 without one
  int cpu = -1;                ///< the one processor that the thread may run on; -1: several
  bool memory_locked = false;  ///< the process has locked memory: VmLck of proc(5) is not 0
  std::string kernel;          ///< release and version, which names PREEMPT_RT where it applies
  std::vector<std::string> warnings;  ///< settings requested and not obtained, with the remedy
};

/// Locks present and future memory of the process and keeps freed memory in it. It stays locked:
/// other loops of the process may rely on it. Without CAP_IPC_LOCK under a finite RLIMIT_MEMLOCK
/// nothing is locked, because later allocations would fail. A failure is a RunFailure in kEnforce,
/// a warning in kWarn; kIgnore only reads back.
void lockMemory(RealtimeMode mode, RealtimeStatus& status);

/// Touches the stack and the heap of the calling thread up to the expected size, after
/// lockMemory(), so that these pages are present from the start; growth within that size is not a
/// leak.
void touchMemory();

/// Sets SCHED_FIFO at `priority` for the calling thread and reads the setting back. A failure is
/// handled as in lockMemory; kIgnore only reads back.
void scheduleThisThread(RealtimeMode mode, int priority, RealtimeStatus& status);

/// Pins the calling thread to this processor, -1: to the allowed ones, and reads the affinity back.
/// A failure is handled as in lockMemory; kIgnore also tries, but reports nothing.
void keepThisThreadTo(int cpu, RealtimeMode mode, RealtimeStatus& status);

/// While it exists, excludes sleep states with a long exit latency on every processor, by holding
/// /dev/cpu_dma_latency open at 0 us. A failure is a warning, never an error; kIgnore does not try.
class ProcessorAwake {
 public:
  ProcessorAwake(RealtimeMode mode, RealtimeStatus& status);
  ~ProcessorAwake();
  ProcessorAwake(const ProcessorAwake&) = delete;
  ProcessorAwake& operator=(const ProcessorAwake&) = delete;

 private:
  int file_ = -1;
};

/// Page faults, minor and major, of the calling thread since it began. Real-time safe.
std::uint64_t threadPageFaults() noexcept;

/// Release and version of the running kernel.
std::string kernelDescription();

}  // namespace whirl_twin
