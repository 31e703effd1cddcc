#include "allocation_guard.h"

#include <cerrno>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WHIRL_TWIN_COUNT_ALLOCATIONS 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
#define WHIRL_TWIN_COUNT_ALLOCATIONS 0
#endif
#endif
#if !defined(WHIRL_TWIN_COUNT_ALLOCATIONS)
#define WHIRL_TWIN_COUNT_ALLOCATIONS 1
#endif

namespace {

// Initial-exec: reading it must not itself allocate the thread's storage.
__attribute__((tls_model("initial-exec"))) thread_local std::uint64_t allocations_of_thread = 0;

}  // namespace

#if WHIRL_TWIN_COUNT_ALLOCATIONS
extern "C" {

// glibc's own functions under the names it keeps for this purpose.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(std::size_t size) {
  ++allocations_of_thread;
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  ++allocations_of_thread;
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) {
  ++allocations_of_thread;
  return __libc_realloc(block, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  ++allocations_of_thread;
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations_of_thread;
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  ++allocations_of_thread;
  if (alignment % sizeof(void*) != 0 || alignment == 0 || (alignment & (alignment - 1)) != 0) {
    return EINVAL;
  }
  void* const found = __libc_memalign(alignment, size);
  if (found == nullptr) {
    return ENOMEM;
  }
  *block = found;
  return 0;
}

}  // extern "C"
#endif

namespace whirl_twin {

AllocationGuard::AllocationGuard() noexcept : before_(allocations_of_thread) {}

std::uint64_t AllocationGuard::allocations() const noexcept {
  return allocations_of_thread - before_;
}

bool AllocationGuard::active() noexcept {
  return WHIRL_TWIN_COUNT_ALLOCATIONS != 0;
}

}  // namespace whirl_twin
