// What a thread must ask of Linux to be real-time in user space: memory that is never paged out, a
// real-time scheduling policy, a processor that does not fall into deep sleep. What was obtained is
// read back and reported, never assumed.
// (mlockall(2), mallopt(3), sched(7), getrusage(2), Linux's PM QoS interface.)
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace whirl_twin {

/// How much it matters that the real-time settings are obtained.
enum class RealtimeMode {
  kEnforce,  ///< the loop does not start without them
  kWarn,     ///< the loop starts with what there is, and says what is missing
  kIgnore    ///< nothing is asked for
};

/// "enforce", "warn" or "ignore".
std::string toString(RealtimeMode mode);

/// The reverse of toString; Refusal names what was found and what is expected.
RealtimeMode parseRealtimeMode(const std::string& name);

/// What was obtained.
struct RealtimeStatus {
  std::string policy;          ///< of the loop's thread: "SCHED_FIFO", "SCHED_OTHER", ...
  int priority = 0;            ///< real-time priority; 0 without one
  int cpu = -1;                ///< the one processor that the thread may run on; -1: several
  bool memory_locked = false;  ///< the process has locked memory: VmLck of proc(5) is not 0
  std::string kernel;          ///< release and version, which names PREEMPT_RT where it applies
  std::vector<std::string> warnings;  ///< what was asked for and not obtained, and how to get it
};

/// Locks present and future memory of the process and keeps freed memory in it. It stays locked:
/// other loops of the process may rely on it. Without CAP_IPC_LOCK under a finite RLIMIT_MEMLOCK
/// nothing is locked, because later allocations would fail there. A failure is a
/// RunFailure in kEnforce, a warning in kWarn; kIgnore only reads back.
void lockMemory(RealtimeMode mode, RealtimeStatus& status);

/// Writes to the stack and the heap of the calling thread as far as its work is to need them, after
/// lockMemory(): so much is there from the start, and no growth within it is a leak.
void touchMemory();

/// Gives the calling thread SCHED_FIFO at `priority` and reads back what it has. A failure is
/// treated as in lockMemory; kIgnore only reads back.
void scheduleThisThread(RealtimeMode mode, int priority, RealtimeStatus& status);

/// Lets the calling thread run on this processor only, -1: on those it may, and reads back. A
/// failure is treated as in lockMemory; kIgnore asks for it all the same and says nothing.
void keepThisThreadTo(int cpu, RealtimeMode mode, RealtimeStatus& status);

/// While it lives, keeps every processor out of the sleep states that take long to leave, by
/// holding /dev/cpu_dma_latency open at 0 us. A machine that refuses is a warning, never an error;
/// kIgnore does not ask.
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
