// Wake-up latency of the real-time loop and its deadline misses, while it steps a scene: for
// scripts/latency, which runs cyclictest at the same time and prints its histogram here too.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "accuracy/step_choice.h"
#include "realtime/fixed_rate_loop.h"
#include "reports/drawings.h"
#include "scene/scene_reader.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

constexpr double kMicrosecond = 1.0e3;  // ns

/// Latencies [us], each with the cumulative number of wake-ups.
struct Latencies {
  std::string name;
  std::vector<double> latency, up_to;
  double longest = 0.0;
  std::uint64_t beyond_period = 0;

  double percentile(double percent) const {
    for (std::size_t i = 0; i < up_to.size(); ++i) {
      if (up_to[i] >= percent / 100.0 * up_to.back()) {
        return latency[i];
      }
    }
    return longest;
  }
};

/// Output of `cyclictest --histogram`: lines of a latency [us] and a count for each of its threads.
Latencies ofCyclictest(const std::string& file, double period) {
  std::ifstream in(file);
  if (!in) {
    throw std::runtime_error(file + ": cannot be read");
  }
  Latencies all{"cyclictest", {}, {}, 0.0, 0};
  double count = 0.0;
  for (std::string line; std::getline(in, line);) {
    double latency = 0.0, here = 0.0;
    if (std::sscanf(line.c_str(), "%lf %lf", &latency, &here) == 2) {
      count += here;
      all.latency.push_back(latency);
      all.up_to.push_back(count);
      all.longest = here > 0.0 ? latency : all.longest;
      all.beyond_period += latency > period ? static_cast<std::uint64_t>(here) : 0;
    }
    unsigned long overflow = 0, longest = 0;
    if (std::sscanf(line.c_str(), "# Max Latencies: %lu", &longest) == 1) {
      all.longest = static_cast<double>(longest);
    } else if (std::sscanf(line.c_str(), "# Histogram Overflows: %lu", &overflow) == 1) {
      count += static_cast<double>(overflow);
      all.latency.push_back(all.latency.empty() ? 0.0 : all.latency.back() + 1.0);
      all.up_to.push_back(count);
      all.beyond_period += overflow;
    }
  }
  if (count == 0.0) {
    throw std::runtime_error(file + ": no histogram of cyclictest");
  }
  return all;
}

Latencies ofLoop(const LoopTiming& timing) {
  Latencies all{
      "whirl_twin", {}, {}, static_cast<double>(timing.wake_up_latency.max()) / kMicrosecond, 0};
  const auto count = static_cast<double>(timing.wake_up_latency.count());
  for (double left = 1.0; left * count >= 1.0; left *= 0.97) {
    all.latency.push_back(
        static_cast<double>(timing.wake_up_latency.percentile(100.0 * (1.0 - left))) /
        kMicrosecond);
    all.up_to.push_back((1.0 - left) * count);
  }
  all.latency.push_back(all.longest);
  all.up_to.push_back(count);
  return all;
}

/// The fraction of wake-ups with a higher latency.
Series curve(const Latencies& all) {
  Series series{all.name, {}, {}};
  for (std::size_t i = 0; i < all.latency.size(); ++i) {
    const double later = 1.0 - all.up_to[i] / all.up_to.back();
    if (later > 0.0) {
      series.x.push_back(std::max(all.latency[i], 0.5));
      series.y.push_back(later);
    }
  }
  return series;
}

void draw(const std::vector<Latencies>& all, const std::string& title, const std::string& file) {
  Figure figure;
  Chart chart;
  chart.title = title;
  chart.x = {"wake-up latency (us)", true, true};
  chart.y = {"share of wake-ups that are later", true, true};
  for (const Latencies& one : all) {
    chart.series.push_back(curve(one));
  }
  figure.charts.push_back(chart);
  Drawings drawings;
  drawings.add(file, figureJson(figure));
  drawings.write();
}

int run(int argc, char** argv) {
  CLI::App app("Runs a scene in the real-time loop and tells how it kept its time");
  std::string scene_file, cyclictest, plot, title;
  double seconds = 60.0;
  FixedRateLoop::Options options;
  options.mode = RealtimeMode::kWarn;
  app.add_option("scene", scene_file)->required();
  app.add_option("--seconds", seconds, "how long")->check(CLI::PositiveNumber);
  app.add_option("--priority", options.priority, "SCHED_FIFO priority");
  app.add_option("--cpu", options.cpu, "the processor it keeps to");
  app.add_option("--busy-wait", options.busy_wait, "ns before each step that it waits awake");
  app.add_option("--cyclictest", cyclictest, "its histogram, waited for");
  app.add_option("--title", title, "of the picture");
  app.add_option("--plot", plot, "FILE.svg or FILE.png");
  CLI11_PARSE(app, argc, argv);

  Twin twin(withStepsChosen(readSceneFile(scene_file)));
  options.period = twin.scene().step;
  const auto cycles =
      static_cast<std::uint64_t>(seconds * 1e9 / static_cast<double>(options.period));
  std::uint64_t done = 0;
  FixedRateLoop loop(options);
  loop.start([&](std::int64_t) {
    twin.step();
    return ++done < cycles;
  });
  while (loop.running()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const LoopTiming timing = loop.timing();
  const RealtimeStatus status = loop.status();
  std::vector<Latencies> all{ofLoop(timing)};
  const double period = static_cast<double>(options.period) / kMicrosecond;
  nlohmann::json json{
      {"scene", twin.scene().name},
      {"period", 1e-9 * static_cast<double>(options.period)},
      {"policy", status.policy},
      {"steps", timing.cycles},
      {"overruns", timing.overruns},
      {"late_wakeups", timing.late_wake_ups},
      {"skipped", timing.skipped},
      {"execution_p50", 1e-9 * static_cast<double>(timing.execution_time.percentile(50.0))},
      {"execution_p99", 1e-9 * static_cast<double>(timing.execution_time.percentile(99.0))}};
  if (!cyclictest.empty()) {
    // It may end a little later than the loop.
    std::this_thread::sleep_for(std::chrono::seconds(3));
    all.push_back(ofCyclictest(cyclictest, period));
  }
  for (const Latencies& one : all) {
    json[one.name] = {{"p50", one.percentile(50.0)},
                      {"p99", one.percentile(99.0)},
                      {"p999", one.percentile(99.9)},
                      {"max", one.longest},
                      {"samples", one.up_to.back()}};
  }
  if (all.size() > 1) {
    json["cyclictest"]["later_than_the_period"] = all[1].beyond_period;
  }
  std::cout << json.dump(2) << "\n";
  if (!plot.empty()) {
    draw(all, title, plot);
  }
  return 0;
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  try {
    return whirl_twin::run(argc, argv);
  } catch (const std::exception& failure) {
    std::cerr << "loop_latency: " << failure.what() << "\n";
    return 1;
  }
}
