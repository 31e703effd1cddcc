// Counts the allocations of the calling thread while a guard exists, to verify that a step or a
// cycle of the loop does not allocate. Linking whirl_twin_allocation_guard replaces malloc, calloc,
// realloc and the aligned variants (and so operator new, which calls them) in the test's
// executable. Under a sanitizer, which replaces malloc itself, the guard is inactive and counts
// nothing.
#pragma once

#include <cstdint>

namespace whirl_twin {

class AllocationGuard {
 public:
  AllocationGuard() noexcept;
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;

  /// Allocations of this thread since the guard was made; frees are not counted. Guards may nest.
  std::uint64_t allocations() const noexcept;

  /// False under a sanitizer: then allocations() is always 0 and proves nothing.
  static bool active() noexcept;

 private:
  std::uint64_t before_;
};

}  // namespace whirl_twin
