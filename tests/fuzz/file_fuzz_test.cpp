// Any content of a file that a program reads back or imports is read, skipped or rejected with an
// error text. Checksums are recomputed, so that the code behind them is reached. 2,000 of each
// kind, a million with WHIRL_TWIN_EXTREMES=full, or as many as fit into WHIRL_TWIN_FUZZ_SECONDS;
// number and rate are properties of the test.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <memory>

#include "../tools/twin_program.h"
#include "breaker.h"
#include "messages/checksum.h"
#include "messages/input_error.h"
#include "monitoring/alarm_commands.h"
#include "monitoring/alarm_history.h"
#include "reports/rotor_drawing.h"
#include "scene/node_reader.h"
#include "scene/scene_reader.h"
#include "studies/result_folder.h"
#include "studies/study_reader.h"
#include "transport/logged_messages.h"
#include "twin/checkpoint.h"

namespace whirl_twin {
namespace file_fuzz_test {

constexpr int kFew = 2000;
constexpr int kMany = 1000000;

std::string damaged(Breaker& breaker, const std::string& text) {
  Bytes bytes(text.begin(), text.end());
  breaker.damage(bytes);
  return {bytes.begin(), bytes.end()};
}

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Runs it many times; returns the number of accepted inputs.
int tried(const std::function<void(Breaker&)>& one, unsigned seed) {
  const char* const limit = std::getenv("WHIRL_TWIN_FUZZ_SECONDS");
  const double most = limit == nullptr ? 1.0e9 : std::atof(limit);  // s
  const int wanted = often(kFew, kMany);
  Breaker breaker(seed);
  int taken = 0, inputs = 0;
  const auto begin = std::chrono::steady_clock::now();
  double longest = 0.0;
  for (int i = 0; i < wanted && secondsSince(begin) < most && !testing::Test::HasFailure(); ++i) {
    ++inputs;
    const auto before = std::chrono::steady_clock::now();
    try {
      one(breaker);
      ++taken;
    } catch (const InputError& why) {
      EXPECT_NE(std::string(why.what()), "") << i;
    } catch (const RunFailure& why) {
      EXPECT_NE(std::string(why.what()), "") << i;
    }
    longest = std::max(
        longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
  }
  testing::Test::RecordProperty("inputs", inputs);
  testing::Test::RecordProperty("per_second", static_cast<int>(inputs / secondsSince(begin)));
  testing::Test::RecordProperty("longest_ms", static_cast<int>(1.0e3 * longest));
  testing::Test::RecordProperty("taken", taken);
  return taken;
}

constexpr const char* kScene = R"(
step: 0.001
drives: {shaft: {speed: 40.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4}
  swing: {model: double_pendulum, parameters: {mass1: 1.0, mass2: 1.0, length1: 1.0, length2: 1.0}, initial: {theta1: 0.3}}
)";

TEST(FileFuzz, CheckpointsWhoseChecksumIsRight) {
  const Scene scene = readScene(YAML::Load(kScene), "fuzz");
  Twin twin(scene);
  twin.buildEnsembles();
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  const auto step = [&record](Twin& running, Observer& seeing) {
    running.step();
    running.write(record.data());
    seeing.observe(record.data());
  };
  for (int i = 0; i < 50; ++i) {
    step(twin, observer);
  }
  Checkpoint sound;
  sound.scene = sceneLines(YAML::Load(kScene));
  sound.step = twin.stepCount();
  sound.twin = imageOf(twin);
  sound.observer = imageOf(observer);
  tried(
      [&](Breaker& breaker) {
        Checkpoint changed = sound;
        std::string& image = breaker.below(2) == 0 ? changed.twin : changed.observer;
        image = damaged(breaker, image);
        std::string bytes = bytesOf(changed);  // with its checksum
        if (breaker.below(8) == 0) {
          bytes = damaged(breaker, bytes);
        }
        const Checkpoint read = checkpointOf(bytes, "fuzz");
        requireScene(read, sound.scene, "fuzz");
        Twin resumed(scene);
        resumed.buildEnsembles();
        Observer again(resumed);
        restore(read, resumed, "fuzz");
        restore(read, again, "fuzz");
        for (int i = 0; i < 3; ++i) {
          step(resumed, again);
        }
      },
      3);
}

TEST(FileFuzz, BlocksOfAStudyWhoseChecksumIsRight) {
  const TemporaryDirectory folder;
  folder.write("scene.yaml", kScene);
  const Study study =
      readStudy(folder.write("study.yaml",
                             "study: {scene: scene.yaml, block: 8}\n"
                             "vary: {rotor.stiffness: {relative_half_width: 0.1}}\n"
                             "design: {latin_hypercube: 8}\nrun: {duration: 0.01}\n"
                             "measure: {peak: max(rotor.whirl.radius), last: final(rotor.x)}\n"));
  const ResultFolder results(folder.file("results"), study, false);
  results.write(0, std::vector<Outcome>(8, Outcome{{1.0 / 3.0, -2.0e-5}, ""}));
  const std::string path = folder.file("results/blocks/000000000.csv");
  const std::string sound = contentsOf(path);
  const std::string end = "# end, checksum ";
  ASSERT_NE(sound.find(end), std::string::npos);
  const std::string rows = sound.substr(0, sound.find(end));
  tried(
      [&](Breaker& breaker) {
        const std::string changed = damaged(breaker, rows);
        char sum[16];
        std::snprintf(sum, sizeof sum, "%08x", crc32c(changed.data(), changed.size()));
        std::ofstream(path, std::ios::binary) << changed << end << sum << "\n";
        results.forEachPoint([](const PointResult&) {});
        results.merge();
      },
      5);
}

TEST(FileFuzz, LinesOfTheAlarmHistoryWhoseChecksumIsRight) {
  const TemporaryDirectory folder;
  const std::string path = folder.file("alarms.jsonl");
  {
    AlarmHistory history(path);
    state::Alert alert;
    alert.id = 3;
    alert.type = "UNSTABLE";
    alert.system = "rotor";
    alert.severity = state::Severity::kDanger;
    alert.text = "rotor: grows";
    history.write(alert);
    history.writeRun({1, 2});
    history.writeReset();
  }
  std::vector<std::string> lines = linesOf(contentsOf(path));
  tried(
      [&](Breaker& breaker) {
        std::ofstream file(path, std::ios::binary | std::ios::trunc);
        for (const std::string& line : lines) {
          const std::string rest = damaged(breaker, line.substr(0, line.find(", \"crc32c\"")));
          char sum[16];
          std::snprintf(sum, sizeof sum, "%08x", crc32c(rest.data(), rest.size()));
          file << rest << ", \"crc32c\": \"" << sum << "\"}\n";
        }
        file.close();
        const AlarmHistory history(path);
        AlertList list;
        list.restore(history.memory().alerts, history.memory().last_id, history.memory().counts);
      },
      7);
}

TEST(FileFuzz, Bags) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml", kScene);
  const std::string log = folder.file("sound.lcmlog"), bag = folder.file("sound.bag");
  ASSERT_EQ(twin({"simulate", scene, "--duration", "0.02", "--output", log}).status, 0);
  ASSERT_EQ(twin({"export", log, "--bag", bag}).status, 0);
  const std::string sound = contentsOf(bag);
  const std::string path = folder.file("damaged.bag");
  EXPECT_GT(tried(
                [&](Breaker& breaker) {
                  std::ofstream(path, std::ios::binary) << damaged(breaker, sound);
                  readLoggedMessages(
                      path, "TWIN_", allKinds(), [](const Message&, std::int64_t) {},
                      [](std::uint64_t, std::uint64_t) {});
                },
                11),
            0);
}

constexpr const char* kRotorToml = R"(
ross_version = "2.3.0"
[parameters]
rated_w = 100.0
["ShaftElement_Shaft Element 0"]
L = 0.25
idl = 0.0
odl = 0.05
idr = 0.0
odr = 0.05
n = 0
alpha = 0.0
beta = 0.0
shear_effects = true
rotary_inertia = true
gyroscopic = true
["ShaftElement_Shaft Element 0".material]
name = "Steel"
rho = 7810.0
E = 211e9
G_s = 81.2e9
[DiskElement_Disk]
n = 1
m = 32.6
Id = 0.178
Ip = 0.33
[BearingElement_Bearing]
n = 0
kxx = [1000000.0]
kyy = [800000.0]
kxy = [0.0]
kyx = [0.0]
cxx = [10.0]
cyy = [10.0]
)";

TEST(FileFuzz, RotorsOfOtherPrograms) {
  const TemporaryDirectory folder;
  const std::string path = folder.file("rotor.toml");
  const auto read = [&path](const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
    static_cast<void>(sceneText(drawingOfRoss(path)));
  };
  ASSERT_NO_THROW(read(kRotorToml));
  EXPECT_GT(tried([&](Breaker& breaker) { read(damaged(breaker, kRotorToml)); }, 13), 0);
}

TEST(FileFuzz, CommandsAboutAlarms) {
  const BuiltScene scene = build(readScene(YAML::Load(kScene), "fuzz"));
  TwinMonitor monitor(scene, AlarmSettings());
  const std::vector<std::string> words = {
      "", "rotor", "swing", "twin", "UNSTABLE", "\x1b[2J", std::string(5000, 'x')};
  const std::vector<double> numbers = {0.0, 1.0, 3600.0, -1.0, 1e308, std::nan(""), 5e-324};
  double wall = 0.0;
  EXPECT_GT(tried(
                [&](Breaker& breaker) {
                  state::AlarmCommand command;
                  command.command = static_cast<std::uint8_t>(breaker.below(6));
                  command.system = words[breaker.below(words.size())];
                  command.type = words[breaker.below(words.size())];
                  command.duration = numbers[breaker.below(numbers.size())];
                  const CommandAnswer answer = carryOut(command, monitor, wall, "the desk");
                  EXPECT_NE(answer.text, "");
                  monitor.tick(wall += 0.01, false);
                },
                17),
            0);
}

}  // namespace file_fuzz_test
}  // namespace whirl_twin
