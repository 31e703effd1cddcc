// Sensor measurements of a running twin: the signal itself where they are perfect, the same bytes
// on every run, a keyphasor's phase.
#include "twin/measurements.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace measurements_test {

constexpr double kTwoPi = 6.283185307179586;

/// A Jeffcott rotor in its steady whirl, about, at 100 rad/s, and sensors.
std::string rotorWith(const std::string& sensors) {
  return "{step: 0.001, drives: {shaft: {speed: 100.0}}, systems: {rotor: {model: jeffcott_rotor, "
         "drive: shaft, parameters: {mass: 1.0, stiffness: 4900.0, damping: 40.0, eccentricity: "
         "1.0e-3}}}, sensors: " +
         sensors + "}";
}

struct Recorded {
  std::vector<state::Measurement> blocks;
  std::vector<state::WhirlState> whirl;  ///< step by step
};

Recorded runFor(const Scene& scene, int steps) {
  Twin twin(scene);
  Observer observer(twin);
  Measurements measurements(scene.sensors, twin.built(), observer);
  Recorded result;
  result.whirl.push_back(observer.whirl(0));
  std::vector<double> record(twin.layout().size);
  for (int i = 0; i < steps; ++i) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
    result.whirl.push_back(observer.whirl(0));
    for (const state::Measurement& block : measurements.observe(observer)) {
      result.blocks.push_back(block);
    }
  }
  for (const state::Measurement& block : measurements.finish()) {
    result.blocks.push_back(block);
  }
  return result;
}

struct Series {
  std::vector<std::int64_t> instants;
  std::vector<double> values;
};

Series channel(const std::vector<state::Measurement>& blocks, std::size_t place) {
  Series series;
  for (const state::Measurement& block : blocks) {
    const std::size_t width = block.channel.size();
    for (std::size_t k = 0; k < static_cast<std::size_t>(block.samples); ++k) {
      series.instants.push_back(block.period > 0 ? block.first_instant +
                                                       static_cast<std::int64_t>(k) * block.period
                                                 : block.instant[k]);
      series.values.push_back(block.value[k * width + place]);
    }
  }
  return series;
}

TEST(Measurements, PerfectSensorsAtTheStepsShowTheStates) {
  const Scene scene =
      sceneOf(rotorWith("{probes: {rate: 1000.0, channels: {x: {measures: rotor.x}, y: {measures: "
                        "rotor.y}, vx: {measures: rotor.x_rate}}}}"));
  const Recorded result = runFor(scene, 250);
  const Series x = channel(result.blocks, 0);
  const Series y = channel(result.blocks, 1);
  const Series rate = channel(result.blocks, 2);
  ASSERT_EQ(x.values.size(), 251u);
  for (std::size_t k = 0; k < x.values.size(); ++k) {
    EXPECT_EQ(x.instants[k], static_cast<std::int64_t>(k) * 1000000);
    EXPECT_EQ(x.values[k], result.whirl[k].x);
    EXPECT_EQ(y.values[k], result.whirl[k].y);
    EXPECT_EQ(rate.values[k], result.whirl[k].x_rate);
  }
  EXPECT_EQ(result.blocks.front().unit, (std::vector<std::string>{"m", "m", "m/s"}));
  for (std::size_t k = 0; k < result.blocks.size(); ++k) {
    EXPECT_EQ(result.blocks[k].at.step, static_cast<std::int64_t>(k)) << "numbered without a hole";
  }
}

TEST(Measurements, BetweenStepsTheSignalIsInterpolatedAndADelayShowsThePast) {
  const Scene scene = sceneOf(
      rotorWith("{probes: {rate: 7300.0, channels: {now: {measures: rotor.x}, late: {measures: "
                "rotor.x, delay: 2.0e-3}, oblique: {measures: rotor, direction: 0.5}}}}"));
  const Recorded result = runFor(scene, 2000);
  const Series now = channel(result.blocks, 0);
  const Series late = channel(result.blocks, 1);
  const Series oblique = channel(result.blocks, 2);
  // The steady whirl e w^2 / (p^2 - w^2 + 2 j zeta p w) of the second half.
  const std::complex<double> r =
      1.0e-3 * 1.0e4 / std::complex<double>(4900.0 - 1.0e4, 40.0 * 100.0);
  const double cubic = std::pow(100.0 * 1.0e-3, 4) / 384.0 * std::abs(r);
  for (std::size_t k = now.values.size() / 2; k < now.values.size(); ++k) {
    const double t = static_cast<double>(now.instants[k]) * 1.0e-9;
    EXPECT_EQ(now.instants[k], std::llround(static_cast<double>(k) / 7300.0 * 1.0e9));
    EXPECT_NEAR(now.values[k], (r * std::polar(1.0, 100.0 * t)).real(), 2.0 * cubic + 1.0e-11);
    EXPECT_NEAR(late.values[k], (r * std::polar(1.0, 100.0 * (t - 2.0e-3))).real(),
                2.0 * cubic + 1.0e-11);
    EXPECT_NEAR(oblique.values[k], (r * std::polar(1.0, 100.0 * t - 0.5)).real(),
                2.0 * cubic + 1.0e-11);
  }
}

TEST(Measurements, RunOutTurnsWithTheShaftAndNoiseRepeats) {
  const std::string sensors =
      "{probes: {rate: 1000.0, seed: 3, channels: {x: {measures: rotor.x, noise: 3.0e-6}, y: "
      "{measures: rotor.y, run_out: 2.0e-5, run_out_angle: 0.4}}}}";
  const Scene scene = sceneOf(rotorWith(sensors));
  const Recorded first = runFor(scene, 1000);
  const Recorded second = runFor(scene, 1000);
  const Series noisy = channel(first.blocks, 0);
  EXPECT_EQ(noisy.values, channel(second.blocks, 0).values) << "the same bytes on every run";
  double squares = 0.0;
  for (std::size_t k = 0; k < noisy.values.size(); ++k) {
    squares += std::pow(noisy.values[k] - first.whirl[k].x, 2);
    const double angle = first.whirl[k].shaft_angle + 0.4 - 0.25 * kTwoPi;
    EXPECT_NEAR(channel(first.blocks, 1).values[k], first.whirl[k].y + 2.0e-5 * std::cos(angle),
                1.0e-15);
    if (k > 20) {
      break;  // each point rebuilds the series
    }
  }
  squares = 0.0;
  for (std::size_t k = 0; k < noisy.values.size(); ++k) {
    squares += std::pow(noisy.values[k] - first.whirl[k].x, 2);
  }
  // Four standard deviations of the estimate of 1001 samples.
  EXPECT_NEAR(std::sqrt(squares / 1001.0), 3.0e-6, 4.0 * 3.0e-6 / std::sqrt(2002.0));
  EXPECT_EQ(first.blocks.front().deviation.front(), 3.0e-6);
}

TEST(Measurements, KeyphasorTellsThePhaseOfTheShaft) {
  const Scene scene = sceneOf(rotorWith("{tacho: {keyphasor: shaft, mark: 0.3}}"));
  const Recorded result = runFor(scene, 3000);
  const Series pulses = channel(result.blocks, 0);
  ASSERT_EQ(pulses.instants.size(), 48u);  // 300 rad
  for (std::size_t k = 0; k < pulses.instants.size(); ++k) {
    EXPECT_NEAR(static_cast<double>(pulses.instants[k]) * 1.0e-9,
                (0.3 + kTwoPi * static_cast<double>(k)) / 100.0, 2.0e-9);
  }
}

}  // namespace measurements_test
}  // namespace whirl_twin
