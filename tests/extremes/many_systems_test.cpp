// Ten thousand systems in one scene: each is read, built and stepped as if alone, moves
// bit-identically, and uses the memory of a single one.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "../scene/scenes.h"
#include "allocation_guard.h"
#include "measured.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace many_systems_test {

constexpr int kMany = 10000;

/// Every third a rotor on the shaft, one with a separate speed, or a pendulum; all different.
std::string systemText(int i) {
  const double part = static_cast<double>(i) / kMany;
  if (i % 3 == 0) {
    return fmt::format(
        "  s{}: {{model: jeffcott_rotor, drive: shaft, parameters: {{mass: 1, stiffness: {:.9g}, "
        "damping: 5, eccentricity: 1.0e-4}}}}\n",
        i, 1000.0 + 3000.0 * part);
  }
  if (i % 3 == 1) {
    return fmt::format(
        "  s{}: {{model: jeffcott_rotor, parameters: {{mass: 1, stiffness: 2500, speed: {:.9g}, "
        "eccentricity: 1.0e-4}}}}\n",
        i, 100.0 * part);
  }
  return fmt::format(
      "  s{}: {{model: double_pendulum, parameters: {{mass1: 1, mass2: 1, length1: 1, length2: "
      "1}}, "
      "initial: {{theta1: {:.9g}}}}}\n",
      i, part);
}

/// The scene of the systems i = first, first + stride, ... below kMany.
std::string sceneText(int first, int stride) {
  std::string text =
      "step: 0.001\ndrives: {shaft: {speed: 0, profile: [{speed: 60, max_acceleration: "
      "500}]}}\nsystems:\n";
  for (int i = first; i < kMany; i += stride) {
    text += systemText(i);
  }
  return text;
}

std::vector<double> record(const Twin& twin) {
  std::vector<double> r(twin.layout().size);
  twin.write(r.data());
  return r;
}

TEST(TenThousandSystems, MoveAsEachWouldAlone) {
  const std::string text = sceneText(0, 1);
  EXPECT_LT(text.size(), 4u << 20) << "what a scene file may have";
  Twin all(sceneOf(text));
  ASSERT_EQ(all.systems().size(), static_cast<std::size_t>(kMany));
  for (int step = 0; step < 200; ++step) {
    all.step();
  }
  const std::vector<double> together = record(all);
  for (int i = 0; i < kMany; ++i) {
    ASSERT_EQ(all.status(static_cast<std::size_t>(i)), StepStatus::kOk) << i;
  }
  // Every 97th, of all three kinds.
  double moved = 0.0;
  for (int i = 0; i < kMany; i += 97) {
    Twin alone(
        sceneOf("step: 0.001\ndrives: {shaft: {speed: 0, profile: [{speed: 60, "
                "max_acceleration: 500}]}}\nsystems:\n" +
                systemText(i)));
    for (int step = 0; step < 200; ++step) {
      alone.step();
    }
    const std::vector<double> single = record(alone);
    const SystemView one = alone.layout().system(single.data(), 0);
    const SystemView among = all.layout().system(together.data(), static_cast<std::size_t>(i));
    EXPECT_EQ(one.status(), among.status());
    EXPECT_EQ(std::memcmp(one.motion(), among.motion(),
                          SystemView::motionSize(one.dof()) * sizeof(double)),
              0)
        << "system " << i;
    moved = std::fmax(moved, std::fabs(one.q()[0] - alone.systems()[0]->spec.q[0]));
  }
  EXPECT_GT(moved, 0.01) << "they did move";
  Observer observer(all);
  observer.observe(together.data());
  EXPECT_EQ(observer.systemCount(), static_cast<std::size_t>(kMany));
  EXPECT_EQ(observer.whirl(9999).system, "s9999");
  EXPECT_EQ(observer.whirl(0).x, all.layout().system(together.data(), 0).q()[0]);
}

/// Resources of a scene: numbers in a record, allocations to read and to build it, to step it.
struct Room {
  explicit Room(const std::string& text) {
    const AllocationGuard reading;
    const Scene scene = sceneOf(text);
    to_read = static_cast<double>(reading.allocations());
    const AllocationGuard building;
    Twin twin(scene);
    to_build = static_cast<double>(building.allocations());
    record = static_cast<double>(twin.layout().size);
    const AllocationGuard stepping;
    for (int i = 0; i < 10; ++i) {
      twin.step();
    }
    to_step = static_cast<double>(stepping.allocations());
  }
  double to_read = 0.0;
  double to_build = 0.0;
  double record = 0.0;
  double to_step = 0.0;
};

TEST(TenThousandSystems, TakeTheRoomOfEachInProportion) {
  const Room all(sceneText(0, 1));
  const Room tenth(sceneText(0, 10));
  const Room three(sceneText(0, 3334));  // 0, 3334, 6668: one of each kind
  // Record: step, schedule and the shaft; then per system status, q, v, work, generation and error,
  // and its own shaft where it has one.
  EXPECT_EQ(three.record, 8.0 + (8.0) + (8.0 + 6.0) + (8.0 + 6.0));
  EXPECT_EQ(all.record, 8.0 + 8.0 * kMany + 6.0 * (kMany - 3334));
  EXPECT_EQ(all.to_step, 0.0);
  if (AllocationGuard::active()) {
    // Vectors that grow reallocate a few times more; names of 3 to 5 letters fit everywhere.
    EXPECT_NEAR(all.to_build / tenth.to_build, 10.0, 0.2);
    EXPECT_NEAR(all.to_read / tenth.to_read, 10.0, 0.2);
    EXPECT_LE(all.to_build / kMany, 1.1 * three.to_build / 3.0);
    fmt::print(
        "[ MEASURED ] allocations a system: {:.0f} to read, {:.0f} to build, {:.0f} to step\n",
        all.to_read / kMany, all.to_build / kMany, all.to_step);
  }
}

}  // namespace many_systems_test
}  // namespace whirl_twin
