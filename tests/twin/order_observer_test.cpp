// Orders, non-synchronous components and precession of the shipped rotors, against references: the
// area swept by the velocities, the orbit of steady unbalance response, whirls of linear theory.
#include "twin/order_observer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <functional>
#include <map>

#include "../scene/scenes.h"
#include "signal/full_spectrum.h"

namespace whirl_twin {
namespace order_observer_test {

namespace fs = std::filesystem;
using Complex = std::complex<double>;

/// A run of a scene, with every state of every rotor and all published orders.
struct FollowedRun {
  explicit FollowedRun(const Scene& scene)
      : twin(scene), observer(twin), orders(twin), record(twin.layout().size) {}

  void until(double time, const std::function<void(const state::OrderState&)>& published) {
    std::vector<std::size_t> all(twin.systems().size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] = i;
    }
    while (twin.seconds(twin.stepCount()) < time - 1e-9) {
      twin.step();
      twin.write(record.data());
      observer.observe(record.data());
      orders.take(record.data(), observer);
      for (const std::size_t i : all) {
        for (std::size_t k = 0; observer.isRotor(i) && k < observer.stations(i).size(); ++k) {
          motion[observer.stations(i)[k]].push_back(observer.whirlOf(i, k));
        }
      }
      orders.tell(observer, all, [&](const std::string&, auto make) { published(make()); });
    }
  }

  /// The last seconds of a rotor, back from a delay.
  std::vector<WhirlMotion> last(const state::OrderState& s) const {
    const std::vector<WhirlMotion>& whirl = motion.at(s.system);
    const auto count =
        static_cast<std::size_t>(std::llround(s.window / twin.scene().stepSeconds()));
    return {whirl.end() - static_cast<std::ptrdiff_t>(std::min(count, whirl.size())), whirl.end()};
  }

  Twin twin;
  Observer observer;
  OrderObserver orders;
  std::vector<double> record;
  std::map<std::string, std::vector<WhirlMotion>> motion;
};

/// Area swept about the mean, by the velocities of the model, relative to that of circles.
double sweptArea(const std::vector<WhirlMotion>& motion, const state::OrderState& s) {
  double swept = 0.0, circles = 0.0;
  for (const WhirlMotion& m : motion) {
    const double x = m.x - s.mean_x, y = m.y - s.mean_y;
    swept += x * m.y_rate - y * m.x_rate;
    circles += std::hypot(x, y) * std::hypot(m.x_rate, m.y_rate);
  }
  return std::copysign(1.0, s.speed) * swept / circles;
}

Scene shipped(const std::string& name) {
  return readSceneFile(std::string(WHIRL_TWIN_SOURCE) + "/config/scenes/" + name + ".yaml");
}

TEST(ShippedRotors, PrecessionIsThatOfTheMotion) {
  int rotors = 0, spectra = 0;
  for (const auto& file : fs::directory_iterator(WHIRL_TWIN_SOURCE "/config/scenes")) {
    const Scene scene = shipped(file.path().stem());
    FollowedRun run(scene);
    // Motion caused by noise of a controller's sensors has no definite sense.
    if (run.orders.empty() || !scene.controllers.empty()) {
      continue;
    }
    std::map<std::string, int> decided;
    run.until(file.path().stem() == "oil_whip" ? 3.0 : 6.0, [&](const state::OrderState& s) {
      if (!s.valid) {
        return;
      }
      const std::vector<WhirlMotion> motion = run.last(s);
      const double truth = sweptArea(motion, s);
      SCOPED_TRACE(file.path().stem().string() + " " + s.system + " at " +
                   std::to_string(s.at.time));
      EXPECT_NEAR(s.precession, truth, 0.05);
      if (std::fabs(truth) > 0.1) {
        ++decided[s.system];
        EXPECT_EQ(s.forward, truth > 0.0);
        Eigen::ArrayXcd z(static_cast<Eigen::Index>(motion.size()));
        for (std::size_t i = 0; i < motion.size(); ++i) {
          z[static_cast<Eigen::Index>(i)] = {motion[i].x - s.mean_x, motion[i].y - s.mean_y};
        }
        const FullSpectrum spectrum(z, scene.stepSeconds());
        // It weighs the window otherwise: where the sense does not change meanwhile.
        const auto middle = motion.begin() + static_cast<std::ptrdiff_t>(motion.size() / 2);
        const bool steady = sweptArea({motion.begin(), middle}, s) * truth > 0.0 &&
                            sweptArea({middle, motion.end()}, s) * truth > 0.0;
        if (steady && std::fabs(truth) > 0.3) {
          ++spectra;
          EXPECT_EQ(spectrum.precession(s.speed) > 0.0, s.forward);
        }
      }
    });
    rotors += static_cast<int>(decided.size());
  }
  EXPECT_GE(rotors, 20);
  EXPECT_GE(spectra, 1500);
}

TEST(OilWhip, IsAForwardLineOfItsOwnFrequencyBesideASmallFirstOrder) {
  FollowedRun run(shipped("oil_whip"));
  state::OrderState quiet, whip;
  run.until(11.5, [&](const state::OrderState& s) {
    if (s.at.time > 5.0 && s.valid) {
      EXPECT_TRUE(s.forward) << s.at.time;
    }
    (s.at.time < 6.0 ? quiet : whip) = s;
  });
  // The sag is the mean, not the orbit.
  EXPECT_NEAR(quiet.mean_y, -1.0e-3, 0.02e-3);
  EXPECT_LT(quiet.forward_amplitude[0], 1e-5);
  EXPECT_NEAR(quiet.forward_lag[0], M_PI, 0.05);  // far above its critical speed
  ASSERT_FALSE(whip.line_frequency.empty());
  EXPECT_NEAR(whip.line_frequency[0], 98.65, 0.05);
  EXPECT_NEAR(whip.line_growth[0], 1.13, 0.02);
  EXPECT_GT(whip.line_forward[0], 5.0 * whip.line_backward[0]);
  EXPECT_GT(whip.line_forward[0], 5.0 * whip.forward_amplitude[0]);
  EXPECT_NEAR(whip.forward_lag[0], M_PI, 0.05);
  // e / (1 - (p/w)^2), nearly, as the whip leaves it alone.
  EXPECT_NEAR(whip.forward_amplitude[0], 5e-6 / (1.0 - std::pow(98.65 / 350.0, 2.0)), 0.02e-6);
}

TEST(InternalDamping, GrowsAsLinearTheorySays) {
  // m z'' + (c + ci) z' + (k - i ci W) z = 0.
  FollowedRun run(
      sceneOf("{step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: {mass: 1, "
              "stiffness: 1.0e4, damping: 4, internal_damping: 4, eccentricity: 1.0e-5, speed: "
              "250}, initial: {x: 1.0e-6}}}}"));
  state::OrderState last;
  run.until(4.0, [&](const state::OrderState& s) { last = s; });
  const std::complex<double> c(8.0, 0.0), k(1.0e4, -4.0 * 250.0);
  const std::complex<double> root = 0.5 * (-c + std::sqrt(c * c - 4.0 * k));
  const std::complex<double> forward = root.imag() > 0.0 ? root : -c - root;
  ASSERT_EQ(last.line_frequency.size(), 1u);
  EXPECT_NEAR(last.line_frequency[0], forward.imag(), 1e-3);
  EXPECT_NEAR(last.line_growth[0], forward.real(), 1e-3);
  EXPECT_NEAR(last.line_ratio[0], forward.imag() / 250.0, 1e-5);
}

TEST(SteadyUnbalance, OrdersAreTheOrbitThatTheModelHas) {
  FollowedRun run(
      sceneOf("{step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: {mass: 2, "
              "stiffness: 7200, stiffness_y: 9000, damping: 12, eccentricity: 1.0e-4, "
              "phase_mark: 0.4, speed: 64}, initial: {x: 0}}}}"));
  state::OrderState last;
  run.until(12.0, [&](const state::OrderState& s) { last = s; });
  const state::WhirlState whirl = run.observer.whirl(0);
  ASSERT_TRUE(last.valid);
  EXPECT_NEAR(last.forward_amplitude[0] + last.backward_amplitude[0], whirl.orbit_major,
              1e-6 * whirl.orbit_major);
  EXPECT_NEAR(std::fabs(last.forward_amplitude[0] - last.backward_amplitude[0]), whirl.orbit_minor,
              1e-6 * whirl.orbit_major);
  EXPECT_EQ(last.forward, whirl.forward);
  // The response along x, by hand, from the phase reference.
  const Complex along_x = 2.0 * 1e-4 * 64.0 * 64.0 / Complex(7200.0 - 2.0 * 64.0 * 64.0, 12.0 * 64);
  const Complex forward = std::polar(last.forward_amplitude[0], -last.forward_lag[0]);
  const Complex backward = std::polar(last.backward_amplitude[0], -last.backward_lag[0]);
  EXPECT_LT(std::abs(forward + std::conj(backward) - along_x * std::polar(1.0, -0.4)),
            1e-6 * std::abs(along_x));
}

TEST(OrderObserver, TellsTheSameWhicheverRecordsTheObserverSees) {
  const Scene scene = sceneOf(kThreeSystems);
  Twin twin(scene);
  Observer every(twin), some(twin);
  OrderObserver all(twin), passed(twin);
  std::vector<double> record(twin.layout().size);
  int published = 0;
  while (twin.seconds(twin.stepCount()) < 3.0) {
    twin.step();
    twin.write(record.data());
    every.observe(record.data());
    all.take(record.data(), every);
    const bool due = passed.dueAt(twin.stepCount());
    if (due || !some.look(record.data())) {
      some.observe(record.data());
    }
    passed.take(record.data(), some);
    std::vector<state::OrderState> both;
    const auto keep = [&](const std::string& subject, auto make) {
      EXPECT_EQ(subject, "rotor");
      both.push_back(make());
    };
    all.tell(every, {0, 1, 2}, keep);
    if (due) {
      passed.tell(some, {0, 1, 2}, keep);
      ASSERT_EQ(both.size(), 2u);
      EXPECT_EQ(both[0].at.step, both[1].at.step);
      EXPECT_EQ(both[0].forward_amplitude, both[1].forward_amplitude);
      EXPECT_EQ(both[0].line_frequency, both[1].line_frequency);
      ++published;
    }
  }
  EXPECT_EQ(published, 60);  // 20 a second
}

}  // namespace order_observer_test
}  // namespace whirl_twin
