// A twin restored from a checkpoint of another continues bit-identically: every shipped scene, with
// controllers, ensembles, commands and parameters changed live, and their published data. Any file
// other than a complete one of the same scene is rejected.
#include "twin/checkpoint.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "../scene/scenes.h"
#include "controllers/controller_entry.h"
#include "messages/checksum.h"
#include "messages/input_error.h"
#include "running_twin.h"

namespace whirl_twin {
namespace checkpoint_test {

namespace fs = std::filesystem;

std::vector<double> recordOf(const Twin& twin) {
  std::vector<double> record(twin.layout().size);
  twin.write(record.data());
  return record;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

/// Numbers of a rotor's whirl and of energies, which the past of the motion is in.
std::vector<double> toldBy(const Observer& observer) {
  std::vector<double> observed;
  for (std::size_t i = 0; i < observer.systemCount(); ++i) {
    observed.push_back(observer.energyResidual(i));
    observed.push_back(observer.errorEstimate(i));
    if (observer.isRotor(i)) {
      observed.push_back(observer.whirlPhase(i));
      observed.push_back(observer.whirlRadius(i));
    }
  }
  return observed;
}

/// A twin, and an observer of each of its steps.
struct Observed {
  explicit Observed(const Scene& scene) : twin(scene), observer((twin.buildEnsembles(), twin)) {}

  void step(int steps) {
    for (int i = 0; i < steps; ++i) {
      twin.step();
      observer.observe(recordOf(twin).data());
    }
  }
  Checkpoint saved() {
    Checkpoint checkpoint;
    checkpoint.step = twin.stepCount();
    checkpoint.twin = imageOf(twin);
    checkpoint.observer = imageOf(observer);
    return checkpoint;
  }
  void restore(const Checkpoint& checkpoint) {
    whirl_twin::restore(checkpoint, twin, "test");
    whirl_twin::restore(checkpoint, observer, "test");
  }
  std::vector<double> members() {
    std::vector<double> all;
    for (std::size_t i = 0; i < twin.systems().size(); ++i) {
      if (const Ensemble* const ensemble = twin.ensemble(i)) {
        std::vector<double> record(ensemble->recordSize());
        ensemble->write(twin.stepCount(), record.data());
        all.insert(all.end(), record.begin(), record.end());
      }
    }
    return all;
  }

  Twin twin;
  Observer observer;
};

std::vector<std::string> shippedScenes() {
  std::vector<std::string> names;
  for (const auto& file : fs::directory_iterator(WHIRL_TWIN_SOURCE "/config/scenes")) {
    names.push_back(file.path().stem().string());
  }
  return names;
}

class EveryScene : public testing::TestWithParam<std::string> {
 protected:
  Scene scene() const {
    return readSceneFile(WHIRL_TWIN_SOURCE "/config/scenes/" + GetParam() + ".yaml");
  }
};

TEST_P(EveryScene, GoesOnToTheBit) {
  constexpr int kSteps = 400;
  Observed unbroken(scene());
  Observed resumed(scene());
  resumed.step(7);  // its previous state does not matter
  for (const int before : {1, 73, 326}) {
    unbroken.step(before);
    const Checkpoint saved = checkpointOf(bytesOf(unbroken.saved()), "test");
    resumed.restore(saved);
    ASSERT_TRUE(same(recordOf(unbroken.twin), recordOf(resumed.twin))) << before;
    ASSERT_TRUE(same(toldBy(unbroken.observer), toldBy(resumed.observer))) << before;
    // One continues; the other has a different state when it is restored the next time.
    for (int i = 0; i < kSteps; ++i) {
      resumed.step(1);
    }
    Observed once_more(scene());
    once_more.restore(saved);
    for (int i = 0; i < kSteps; ++i) {
      unbroken.step(1);
      once_more.step(1);
      ASSERT_TRUE(same(recordOf(unbroken.twin), recordOf(once_more.twin)))
          << "step " << unbroken.twin.stepCount() << ", saved at " << saved.step;
      ASSERT_TRUE(same(toldBy(unbroken.observer), toldBy(once_more.observer)))
          << "step " << unbroken.twin.stepCount() << ", saved at " << saved.step;
    }
    EXPECT_TRUE(same(unbroken.members(), once_more.members()));
    EXPECT_TRUE(same(unbroken.members(), resumed.members()));
  }
}

INSTANTIATE_TEST_SUITE_P(, EveryScene, testing::ValuesIn(shippedScenes()),
                         [](const auto& each) { return each.param; });

constexpr const char* kChanged = R"(
step: 0.001
drives: {shaft: {speed: 20.0}}
systems:
  rotor:
    model: rigid_disc_rotor
    drive: shaft
    parameters: {mass: 6.0, polar_inertia: 0.0768, transverse_inertia: 0.03845,
                 overhung: {length: 0.3, bending_stiffness: 1610.066}, damping_displacement: 20.0,
                 eccentricity: 2.0e-5}
  trolley:
    model: cart_pendulum
    parameters: {cart_mass: 20.0, rod_mass: 10.0, rod_length: 6.0, stiffness: 0.0}
    inputs: {force: 1.0}
  mass: {model: linear_system, parameters: {names: [x], mass: [[1.0]], damping: [[4.0]], stiffness: [[50.0]]}}
controllers:
  hold: {type: pid, rate: 230.0, measures: [mass.x], acts_on: [mass.force_x],
         delay: {mean: 0.006, jitter: 0.002, seed: 4},
         sensor: {noise: 1.0e-4, bandwidth: 60.0, seed: 3},
         parameters: {kp: 20.0, ki: 100.0, kd: 1.0, setpoint: 0.02}}
)";

/// With a manually run loop, live changes, checkpoint and resume.
class LiveCheckpoint : public testing::Test {
 protected:
  static Checkpoint saved(Running& running) {
    Checkpoint checkpoint;
    const auto wait = [&running] {
      while (running.live.carriedOut() < running.live.sent()) {
        running.cycle();
      }
      return true;
    };
    EXPECT_TRUE(takeCheckpoint(running.live, running.parameters, wait, checkpoint));
    return checkpointOf(bytesOf(checkpoint), "test");
  }
  /// The records of the steps after one.
  static std::vector<std::vector<double>> behind(std::int64_t step, Running& running) {
    std::vector<std::vector<double>> all;
    while (running.live.pop(running.record.data())) {
      if (RecordLayout::step(running.record.data()) > step) {
        all.push_back(running.record);
      }
    }
    return all;
  }
  static void change(Running& running) {
    ASSERT_TRUE(running.set("rotor", "damping_displacement", 30.0).done);
    const SpeedMove move{80.0, 40.0, 300.0, 0.0};
    ASSERT_TRUE(running.parameters.prepareFor(0, move));
    TwinCommand speed;
    speed.kind = TwinCommand::Kind::kSetSpeed;
    speed.speed = move.speed;
    speed.max_acceleration = move.max_acceleration;
    speed.max_jerk = move.max_jerk;
    ASSERT_TRUE(running.live.send(speed));
    TwinCommand force;
    force.kind = TwinCommand::Kind::kSetInput;
    force.system = 1;
    force.value = -7.0;
    force.duration = 500'000'000;
    ASSERT_TRUE(running.live.send(force));
    running.cycle(100);
    ASSERT_TRUE(running.set("rotor", "mass", 7.0, 0.8).done);
    ASSERT_TRUE(running.set("hold", "kp", 35.0).done);
    running.cycle(50);
    EXPECT_TRUE(running.parameters.continueRamps().empty());
    running.cycle(60);
  }
  static void resume(Running& running) {
    for (int i = 0; i < 15; ++i) {
      running.cycle(100);
      EXPECT_TRUE(running.parameters.continueRamps().empty());
    }
  }
};

TEST_F(LiveCheckpoint, WhatWasChangedGoesOnToTheBit) {
  const Scene scene = sceneOf(kChanged);
  Running unbroken(scene);
  unbroken.cycle(301);
  change(unbroken);
  const Checkpoint saved = this->saved(unbroken);
  Running resumed(scene);
  whirl_twin::resume(saved, resumed.live, resumed.parameters, "test");
  EXPECT_EQ(resumed.live.stepCount(), saved.step);
  resumed.cycle(2);  // publishes its state, and continues like the other one after the checkpoint
  ASSERT_EQ(resumed.live.stepCount(), unbroken.live.stepCount());
  resume(unbroken);
  resume(resumed);
  const auto expected = behind(saved.step, unbroken);
  const auto found = behind(saved.step, resumed);
  ASSERT_GT(expected.size(), 1500U);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_TRUE(same(found[i], expected[i])) << i << " records behind";
  }
  // The published parameters continue, too, and a reset restores the scene's values in both.
  Observer observer(resumed.live.twin(), resumed.live.generations());
  EXPECT_EQ(observer.parameters(0).values, [&] {
    Observer other(unbroken.live.twin(), unbroken.live.generations());
    return other.parameters(0).values;
  }());
  for (Running* const each : {&unbroken, &resumed}) {
    each->command(TwinCommand::Kind::kReset);
    each->parameters.restored();
    each->cycle(200);
  }
  EXPECT_TRUE(same(recordOf(unbroken.live.twin()), recordOf(resumed.live.twin())));
}

// Memory of 200 checkpoints of a twin whose parameters were changed live.
TEST_F(LiveCheckpoint, TakesNoMemoryForGood) {
  Running running(sceneOf(kChanged));
  running.cycle(10);
  change(running);
  Checkpoint checkpoint;
  std::string bytes;
  const auto take = [&](int times) {
    for (int i = 0; i < times; ++i) {
      takeAtRest(running.live, running.parameters, checkpoint);
      checkpoint.live["clock_steps"] = i;
      bytes = bytesOf(checkpoint);
    }
    return static_cast<double>(::mallinfo2().uordblks);
  };
  const double before = take(20);
  EXPECT_LT((take(200) - before) / 200, 1000.0) << "bytes a checkpoint";
}

struct Remembering {
  static constexpr const char* kName = "remembering";
  static constexpr const char* kSummary = "the value before";
  static constexpr std::array<Parameter<Remembering>, 0> parameters() { return {}; }
  void reset(const ControllerPlan&) noexcept { before.assign(1, 0.0); }
  void update(const ControlSample& sample, double* outputs) noexcept {
    outputs[0] = std::exchange(before[0], sample.values[0]);
  }
  std::vector<double> before;
};
struct Exchanging : Remembering {
  void exchange(StateImage& image) noexcept { image(before); }
};

template <class Law>
bool canBeSaved() {
  LawController<Law> controller{Law(), ControllerPlan()};
  std::vector<char> room(1000);
  StateImage image = StateImage::taking(room.data(), room.size());
  controller.exchange(image);
  return image.sound();
}

TEST(ALawThatOwnsMemory, HasToSayWhatItsStateIs) {
  EXPECT_FALSE(canBeSaved<Remembering>());
  EXPECT_TRUE(canBeSaved<Exchanging>());
}

TEST_F(LiveCheckpoint, AStateOfAnotherTwinIsRefused) {
  Running running(sceneOf(kChanged));
  running.cycle(10);
  const Checkpoint saved = this->saved(running);
  Running other(sceneOf(kThreeSystems));
  try {
    whirl_twin::resume(saved, other.live, other.parameters, "run.checkpoint");
    FAIL() << "it was taken";
  } catch (const InputError& inputError) {
    EXPECT_EQ(std::string(inputError.what()).find("run.checkpoint: "), 0U) << inputError.what();
  }
}

/// Restores a corrupt state into a twin, and takes a few steps if it is not rejected.
void tryDamaged(const Checkpoint& damaged, Observed& observed) {
  try {
    observed.restore(damaged);
    observed.step(3);
  } catch (const InputError&) {
  }
}

// States with changed bits in bytes of each number, with a matching checksum: rejected, or another
// state that a twin can have; no crash, and no endless loop. In a separate process. Every byte with
// WHIRL_TWIN_EXTREMES=full.
TEST(ADamagedState, NeitherCrashesNorHangs) {
  std::vector<Scene> scenes{sceneOf(kChanged)};
  for (const char* const name : {"demo", "levitation", "sommerfeld"}) {
    scenes.push_back(
        readSceneFile(std::string(WHIRL_TWIN_SOURCE "/config/scenes/") + name + ".yaml"));
  }
  const char* const extremes = std::getenv("WHIRL_TWIN_EXTREMES");
  const std::size_t stride = extremes != nullptr && std::string(extremes) == "full" ? 1 : 3;
  auto* const at = static_cast<std::size_t*>(
      ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  for (const Scene& scene : scenes) {
    for (const bool of_observer : {false, true}) {
      const pid_t child = ::fork();
      if (child == 0) {
        Observed observed(scene);
        observed.step(150);
        const Checkpoint saved = observed.saved();
        std::string Checkpoint::*const image =
            of_observer ? &Checkpoint::observer : &Checkpoint::twin;
        for (at[0] = 0; at[0] < (saved.*image).size(); at[0] += stride) {
          ::alarm(20);
          Checkpoint damaged = saved;
          constexpr std::array<int, 4> kBits{0x01, 0x40, 0x80, 0xff};
          at[1] = static_cast<std::size_t>(kBits[at[0] / stride % kBits.size()]);
          (damaged.*image)[at[0]] ^= static_cast<char>(at[1]);
          tryDamaged(damaged, observed);
        }
        ::_exit(0);
      }
      int status = 0;
      ::waitpid(child, &status, 0);
      EXPECT_EQ(status, 0) << scene.name << (of_observer ? ", observer" : "") << ": byte " << at[0]
                           << ", bits " << at[1];
    }
  }
  ::munmap(at, 4096);
}

/// Of three systems, as a file.
class File : public testing::Test {
 protected:
  File() : observed(sceneOf(kThreeSystems)) {
    observed.step(50);
    checkpoint = observed.saved();
    checkpoint.scene = sceneLines(YAML::Load(kThreeSystems), observed.twin);
    bytes = bytesOf(checkpoint);
  }
  /// The error text.
  static std::string whyNot(const std::string& bytes) {
    try {
      checkpointOf(bytes, "run.checkpoint");
      return "";
    } catch (const InputError& inputError) {
      return inputError.what();
    }
  }
  /// With one text replaced by another, and a matching checksum.
  std::string with(const std::string& text, const std::string& other) const {
    const std::size_t body = bytes.find('\n', bytes.find('\n') + 1) + 1;
    std::string rest = bytes.substr(body);
    const std::size_t at = rest.find(text);
    EXPECT_NE(at, std::string::npos) << text;
    rest.replace(at, text.size(), other);
    char promise[64];
    std::snprintf(promise, sizeof promise, "%zu %08x\n", rest.size(),
                  crc32c(rest.data(), rest.size()));
    return bytes.substr(0, bytes.find('\n') + 1) + promise + rest;
  }

  Observed observed;
  Checkpoint checkpoint;
  std::string bytes;
};

TEST_F(File, IsReadAsItWasWritten) {
  const fs::path folder = fs::path(testing::TempDir()) / "checkpoint_test";
  fs::create_directories(folder);
  const std::string path = folder / "run.checkpoint";
  writeCheckpoint(path, "something else");
  writeCheckpoint(path, bytes);
  EXPECT_EQ(bytesOf(readCheckpoint(path)), bytes);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  EXPECT_THROW(writeCheckpoint(folder / "none" / "run.checkpoint", bytes), RunFailure);
  EXPECT_THROW(writeCheckpoint(folder, bytes), RunFailure);
  EXPECT_THROW(readCheckpoint(folder / "other"), InputError);
  fs::remove_all(folder);
}

TEST_F(File, TornAnywhereItIsRefused) {
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    ASSERT_EQ(whyNot(bytes.substr(0, length)).find("run.checkpoint: "), 0U) << length;
  }
  EXPECT_NE(whyNot(bytes.substr(0, bytes.size() - 1)).find("truncated: must have "),
            std::string::npos);
  EXPECT_NE(whyNot(bytes + "x"), "");
}

TEST_F(File, WithAnyByteOtherItIsRefused) {
  std::mt19937 random(11);
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = bytes;
    char& byte = damaged[random() % damaged.size()];
    byte = static_cast<char>(byte ^ (1 << random() % 8));
    ASSERT_NE(whyNot(damaged), "");
  }
}

TEST_F(File, OfAnotherOriginItIsRefusedInWords) {
  EXPECT_EQ(whyNot(bytes), "");
  EXPECT_NE(whyNot(with("version: ", "version: 0.0.1 # ")).find("found whirl_twin 0.0.1"),
            std::string::npos);
  EXPECT_NE(whyNot(with("machine: ", "machine: 36 bits # ")).find("found 36 bits"),
            std::string::npos);
  std::string later = bytes;
  later.replace(later.find("checkpoint 2"), 12, "checkpoint 3");
  EXPECT_EQ(whyNot(later), "run.checkpoint: must be a checkpoint of format 2, found format 3");
  const std::string rest = bytes.substr(bytes.find('\n', bytes.find('\n') + 1) + 1);
  char former[80];  // with FNV-1a
  std::snprintf(former, sizeof former, "whirl_twin checkpoint 1\n%zu %016llx\n", rest.size(),
                static_cast<unsigned long long>(fingerprint(rest.data(), rest.size())));
  EXPECT_EQ(whyNot(former + rest), "");
  EXPECT_EQ(whyNot("time,rotor.x\n0,0\n"),
            "run.checkpoint: must be a checkpoint of a twin, found another file");
  EXPECT_NE(whyNot(with("version", "vorsion")), "");
}

TEST_F(File, OfAnotherSceneItIsRefusedByWhatIsOther) {
  const auto whyNotFor = [&](const std::string& yaml) -> std::string {
    const Twin twin(sceneOf(yaml));
    try {
      requireScene(checkpoint, sceneLines(YAML::Load(yaml), twin), "run.checkpoint");
      return "";
    } catch (const InputError& inputError) {
      return inputError.what();
    }
  };
  std::string yaml = kThreeSystems;
  EXPECT_EQ(whyNotFor(yaml), "");
  const auto replace = [&](const std::string& text, const std::string& other) {
    yaml.replace(yaml.find(text), text.size(), other);
  };
  replace("stiffness: 1.0e4", "stiffness: 10000");  // the same number
  EXPECT_EQ(whyNotFor(yaml), "");
  replace("stiffness: 10000", "stiffness: 2.5e4");
  EXPECT_EQ(whyNotFor(yaml),
            "run.checkpoint: must be saved from the same scene\n"
            "  systems.rotor.parameters.stiffness: expected 25000, found 10000");
}

}  // namespace checkpoint_test
}  // namespace whirl_twin
