// Delay of the monitor's verdict after a change of a parameter, or of the speed: wall time from the
// message to the margin, with the evaluating thread asleep before. The transport of both messages
// by ROS or LCM and the polling period of the node (up to 0.2 ms) are not included.
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "monitoring/twin_monitor.h"
#include "scene/scene_reader.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

constexpr const char* kQuartic =
    "step: 0.001\ndrives: {shaft: {speed: 100.0}}\nsystems:\n  rotor: {model: jeffcott_rotor, "
    "drive: "
    "shaft, parameters: {mass: 2.0, stiffness: 18000.0, damping: 12.0, internal_damping: 1.0}}\n";
constexpr const char* kRub =
    "step: 0.001\ndrives: {shaft: {speed: 50.0}}\nsystems:\n  rotor: {model: jeffcott_rotor, "
    "drive: "
    "shaft, parameters: {mass: 2.0, stiffness: 18000.0, damping: 12.0, rub_stiffness: 1.0e+5, "
    "rub_clearance: 1.0e-3, rub_friction: 0.1, rotor_radius: 0.05}}\n";
constexpr int kTrials = 200;
constexpr auto kRest = std::chrono::milliseconds(5);

/// A monitor as in the node, after its first verdict and critical speeds.
class Watched {
 public:
  explicit Watched(const char* text)
      : twin_(readScene(YAML::Load(text), "benchmark")),
        observer_(twin_),
        record_(twin_.layout().size),
        monitor_(build(twin_.scene()), AlarmSettings(), EvaluationQueue::Mode::kConcurrent) {
    twin_.step();
    twin_.write(record_.data());
    observer_.observe(record_.data());
    change_ = observer_.parameters(0);
    whirl_ = observer_.whirl(0);
    monitor_.take(whirl_, 0.0);
    settle();
  }
  /// [s], from the message to the first verdict.
  template <class Message>
  double delay(const Message& tell) {
    const auto begin = std::chrono::steady_clock::now();
    tell();
    while (monitor_.takeMargins().empty()) {  // to yield would be to wait for other programs
    }
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    settle();
    return passed.count();
  }
  double afterParameter() {
    for (std::size_t i = 0; i < change_.names.size(); ++i) {
      if (change_.names[i] == "damping") {
        change_.values[i] = change_.values[i] == 12.0 ? 14.0 : 12.0;
      }
    }
    return delay([this] { monitor_.take(change_); });
  }
  /// Two hundredths of the speed, a hundredth of a second after the last.
  double afterSpeed() {
    whirl_.at.time += 0.06;
    whirl_.speed *= faster_ ? 1.02 : 1.0 / 1.02;
    faster_ = !faster_;
    return delay([this] { monitor_.take(whirl_, whirl_.at.time); });
  }

 private:
  void settle() {
    do {
      std::this_thread::sleep_for(kRest);
      monitor_.takeMargins();
    } while (monitor_.evaluating());
  }

  Twin twin_;
  Observer observer_;
  std::vector<double> record_;
  TwinMonitor monitor_;
  state::ParameterChange change_;
  state::WhirlState whirl_;
  bool faster_ = true;
};

void measure(const char* system, const char* change, const char* text, double (Watched::*delay)()) {
  Watched watched(text);
  std::vector<double> delays;
  for (int i = 0; i < kTrials; ++i) {
    delays.push_back(1.0e3 * (watched.*delay)());
  }
  std::sort(delays.begin(), delays.end());
  fmt::print("| {} | {} | {:.3f} ms | {:.3f} ms | {:.3f} ms |\n", system, change, delays.front(),
             delays[delays.size() / 2], delays[delays.size() * 95 / 100]);
}

}  // namespace
}  // namespace whirl_twin

int main() {
  using whirl_twin::Watched;
  fmt::print(
      "| system | change of | shortest | median | 95th percentile |\n|---|---|---|---|---|\n");
  for (const auto& [system, text] :
       {std::pair{"rotor, quartic", whirl_twin::kQuartic}, std::pair{"rub", whirl_twin::kRub}}) {
    whirl_twin::measure(system, "a parameter", text, &Watched::afterParameter);
    whirl_twin::measure(system, "speed", text, &Watched::afterSpeed);
  }
  return 0;
}
