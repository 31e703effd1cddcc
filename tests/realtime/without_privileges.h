// While it exists, the calling thread and the threads it starts have the rights of a user without
// real-time privileges: effective capabilities dropped, rtprio limit 0, a small memlock limit. So a
// test without privileges gives the same result when root runs it.
#pragma once

#include <linux/capability.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>

namespace whirl_twin {

class WithoutPrivileges {
 public:
  WithoutPrivileges() {
    munlockall();  // an earlier test may have locked memory; under the small limit nothing could
                   // grow
    syscall(SYS_capget, &header_, before_);
    __user_cap_data_struct none[_LINUX_CAPABILITY_U32S_3] = {before_[0], before_[1]};
    for (__user_cap_data_struct& word : none) {
      word.effective = 0;
    }
    syscall(SYS_capset, &header_, none);
    lower(RLIMIT_RTPRIO, 0, rtprio_before_);
    lower(RLIMIT_MEMLOCK, 64 * 1024, memlock_before_);
  }

  ~WithoutPrivileges() {
    setrlimit(RLIMIT_RTPRIO, &rtprio_before_);
    setrlimit(RLIMIT_MEMLOCK, &memlock_before_);
    syscall(SYS_capset, &header_, before_);
  }

  WithoutPrivileges(const WithoutPrivileges&) = delete;
  WithoutPrivileges& operator=(const WithoutPrivileges&) = delete;

 private:
  // Only the soft limit, which needs no right to be raised again.
  static void lower(__rlimit_resource resource, rlim_t most, rlimit& before) {
    getrlimit(resource, &before);
    const rlimit lowered{std::min(before.rlim_cur, most), before.rlim_max};
    setrlimit(resource, &lowered);
  }

  __user_cap_header_struct header_{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct before_[_LINUX_CAPABILITY_U32S_3] = {};
  rlimit rtprio_before_{};
  rlimit memlock_before_{};
};

}  // namespace whirl_twin
