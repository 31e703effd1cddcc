// The guard must detect every allocation, or the tests that use it prove nothing.
#include "allocation_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace whirl_twin {
namespace allocation_guard_test {

// The compiler may elide an allocation whose result is unused.
void* volatile seen = nullptr;

// Expected count for so many allocations: under a sanitizer the guard is inactive and counts none.
std::uint64_t counted(std::uint64_t allocations) {
  return AllocationGuard::active() ? allocations : 0;
}

TEST(AllocationGuard, CountsOperatorNew) {
  const AllocationGuard guard;
  auto number = std::make_unique<double>(1.0);
  seen = number.get();
  EXPECT_EQ(guard.allocations(), counted(1));
}

TEST(AllocationGuard, CountsOperatorNewOfAlignedTypes) {
  struct alignas(64) Line {
    double values[8];
  };
  const AllocationGuard guard;
  auto line = std::make_unique<Line>();
  seen = line.get();
  EXPECT_EQ(guard.allocations(), counted(1));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(line.get()) % 64, 0U);
}

TEST(AllocationGuard, CountsTheFunctionsOfC) {
  const AllocationGuard guard;
  void* block = std::malloc(8);
  seen = block;
  EXPECT_EQ(guard.allocations(), counted(1));
  block = std::realloc(block, 100'000);
  seen = block;
  EXPECT_EQ(guard.allocations(), counted(2));
  std::free(block);
  block = std::calloc(4, 8);
  seen = block;
  EXPECT_EQ(guard.allocations(), counted(3));
  std::free(block);
  block = std::aligned_alloc(64, 64);
  seen = block;
  EXPECT_EQ(guard.allocations(), counted(4));
  std::free(block);
  ASSERT_EQ(posix_memalign(&block, 64, 64), 0);
  seen = block;
  EXPECT_EQ(guard.allocations(), counted(5));
  std::free(block);
}

TEST(AllocationGuard, CountsAVectorThatGrows) {
  std::vector<double> values(1);
  const AllocationGuard guard;
  values.resize(1000);
  seen = values.data();
  EXPECT_EQ(guard.allocations(), counted(1));
}

TEST(AllocationGuard, CountsAStringThatGrowsBeyondItsOwnRoom) {
  std::string text = "short";
  const AllocationGuard guard;
  text += " and then much longer than a string keeps within itself";
  seen = text.data();
  EXPECT_EQ(guard.allocations(), counted(1));
}

TEST(AllocationGuard, CountsAFunctionThatDoesNotFitItsOwnRoom) {
  const double captured[8] = {1.0};
  const AllocationGuard guard;
  const std::function<double()> function = [captured] { return captured[0]; };
  EXPECT_EQ(guard.allocations(), counted(1));
  EXPECT_EQ(function(), 1.0);
  EXPECT_EQ(guard.allocations(), counted(1));  // calling it does not allocate
}

TEST(AllocationGuard, CountsNothingWhereNothingIsAllocated) {
  std::vector<double> values(100);
  const AllocationGuard guard;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = std::sin(static_cast<double>(i));
  }
  values.clear();
  values.resize(100);
  EXPECT_EQ(guard.allocations(), 0U);
}

TEST(AllocationGuard, CountsOnlyItsOwnThread) {
  std::uint64_t by_other = 0;
  std::thread other([&by_other] {
    const AllocationGuard guard_of_other;
    for (int i = 0; i < 10; ++i) {
      seen = std::make_unique<double[]>(100).get();
    }
    by_other = guard_of_other.allocations();
  });
  const AllocationGuard guard;
  other.join();
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_EQ(by_other, counted(10));
}

TEST(AllocationGuard, GuardsNest) {
  const AllocationGuard outer;
  seen = std::make_unique<double>(1.0).get();
  const AllocationGuard inner;
  seen = std::make_unique<double>(2.0).get();
  EXPECT_EQ(outer.allocations(), counted(2));
  EXPECT_EQ(inner.allocations(), counted(1));
}

}  // namespace allocation_guard_test
}  // namespace whirl_twin
