// A wall clock that a test sets, for a process under LD_PRELOAD: CLOCK_REALTIME is ahead by the
// number of nanoseconds in the file WALL_CLOCK_OFFSET.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace {

const volatile std::int64_t* mappedOffset() {
  static const std::int64_t none = 0;
  const char* const name = std::getenv("WALL_CLOCK_OFFSET");
  const int file = name == nullptr ? -1 : open(name, O_RDONLY | O_CLOEXEC);
  void* const memory =
      file < 0 ? MAP_FAILED : mmap(nullptr, sizeof none, PROT_READ, MAP_SHARED, file, 0);
  return memory == MAP_FAILED ? &none : static_cast<const volatile std::int64_t*>(memory);
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* now) noexcept {
  static const volatile std::int64_t* const offset = mappedOffset();
  const long answer = syscall(SYS_clock_gettime, clock, now);
  if (answer == 0 && clock == CLOCK_REALTIME) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    const std::int64_t sum = now->tv_sec * kSecond + now->tv_nsec + *offset;
    now->tv_sec = sum / kSecond;
    now->tv_nsec = sum % kSecond;
  }
  return static_cast<int>(answer);
}
