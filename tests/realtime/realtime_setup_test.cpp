#include "realtime/realtime_setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <cfloat>
#include <stdexcept>
#include <thread>
#include <vector>

#include "messages/input_error.h"
#include "realtime/denormals.h"
#include "without_privileges.h"

namespace whirl_twin {
namespace realtime_setup_test {

using ::testing::HasSubstr;

// The message of the std::runtime_error that call() must throw.
template <class Call>
std::string errorOf(Call call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(RealtimeMode, NamesAreReadAsTheyAreWritten) {
  EXPECT_EQ(toString(RealtimeMode::kEnforce), "enforce");
  EXPECT_EQ(toString(RealtimeMode::kWarn), "warn");
  EXPECT_EQ(toString(RealtimeMode::kIgnore), "ignore");
  for (const auto mode : {RealtimeMode::kEnforce, RealtimeMode::kWarn, RealtimeMode::kIgnore}) {
    EXPECT_EQ(parseRealtimeMode(toString(mode)), mode);
  }
}

TEST(RealtimeMode, AnUnknownNameIsRefusedWithWhatIsExpected) {
  try {
    parseRealtimeMode("always");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "realtime: must be enforce, warn or ignore, found \"always\"");
  }
}

TEST(RealtimeSetup, WithoutPrivilegesEnforceFailsAndSaysWhatIsMissing) {
  const WithoutPrivileges user;
  RealtimeStatus status;
  EXPECT_THAT(errorOf([&] { lockMemory(RealtimeMode::kEnforce, status); }),
              HasSubstr("expected an unlimited memlock limit"));
  EXPECT_THAT(errorOf([&] { scheduleThisThread(RealtimeMode::kEnforce, 50, status); }),
              HasSubstr("expected CAP_SYS_NICE or an rtprio limit of at least 50"));
}

TEST(RealtimeSetup, WithoutPrivilegesWarnGoesOnAndSaysWhatIsMissing) {
  const WithoutPrivileges user;
  RealtimeStatus status;
  lockMemory(RealtimeMode::kWarn, status);
  scheduleThisThread(RealtimeMode::kWarn, 50, status);
  EXPECT_FALSE(status.memory_locked);
  EXPECT_EQ(status.policy, "SCHED_OTHER");
  EXPECT_EQ(status.priority, 0);
  ASSERT_EQ(status.warnings.size(), 2U);
  EXPECT_THAT(status.warnings[0], HasSubstr("memory is not locked"));
  EXPECT_THAT(status.warnings[1], HasSubstr("no real-time scheduling"));
}

// Locking under a small limit would make later allocations fail: so it must not be done.
TEST(RealtimeSetup, WithoutPrivilegesMemoryCanStillBeAllocatedAfterwards) {
  const WithoutPrivileges user;
  RealtimeStatus status;
  lockMemory(RealtimeMode::kWarn, status);
  const std::vector<double> large(4'000'000, 1.0);  // 32 MB, far beyond the limit
  EXPECT_EQ(large.back(), 1.0);
}

TEST(RealtimeSetup, IgnoreAsksForNothingAndReportsWhatThereIs) {
  const WithoutPrivileges user;
  RealtimeStatus status;
  lockMemory(RealtimeMode::kIgnore, status);
  scheduleThisThread(RealtimeMode::kIgnore, 50, status);
  const ProcessorAwake awake(RealtimeMode::kIgnore, status);
  EXPECT_FALSE(status.memory_locked);
  EXPECT_EQ(status.policy, "SCHED_OTHER");
  EXPECT_EQ(status.priority, 0);
  EXPECT_TRUE(status.warnings.empty());
}

// Whatever rights this run has: a setting was obtained, or there is a warning.
TEST(RealtimeSetup, WhatWasNotObtainedIsWarnedOf) {
  std::thread([] {
    RealtimeStatus status;
    scheduleThisThread(RealtimeMode::kWarn, 50, status);
    const int policy = sched_getscheduler(0);
    EXPECT_EQ(status.policy, policy == SCHED_FIFO ? "SCHED_FIFO" : "SCHED_OTHER");
    EXPECT_EQ(status.priority, policy == SCHED_FIFO ? 50 : 0);
    EXPECT_EQ(status.warnings.empty(), policy == SCHED_FIFO);
  }).join();
}

TEST(RealtimeSetup, APageTouchedForTheFirstTimeIsAPageFault) {
  munlockall();  // locked memory is there from the beginning
  constexpr std::size_t kPages = 64;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const block =
      mmap(nullptr, kPages * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(block, MAP_FAILED);
  madvise(block, kPages * page, MADV_NOHUGEPAGE);
  const std::uint64_t before = threadPageFaults();
  for (std::size_t i = 0; i < kPages; ++i) {
    static_cast<volatile char*>(block)[i * page] = 1;
  }
  EXPECT_GE(threadPageFaults(), before + kPages);
  munmap(block, kPages * page);
}

TEST(RealtimeSetup, TheKernelIsNamed) {
  EXPECT_THAT(kernelDescription(), HasSubstr("#"));
}

TEST(DenormalsToZero, HoldsWhileItLivesAndNoLonger) {
  volatile double smallest = DBL_MIN;
  {
    const DenormalsToZero flush;
    const volatile double half = smallest / 2.0;
    EXPECT_EQ(half == 0.0, DenormalsToZero::kSupported);
  }
  const volatile double half = smallest / 2.0;
  EXPECT_GT(half, 0.0);
}

}  // namespace realtime_setup_test
}  // namespace whirl_twin
