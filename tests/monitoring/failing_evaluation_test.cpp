// A system that cannot be evaluated is uncertain, with the reason: its alarms stay, and those of
// others act. References: the limits of damping within a shaft, w = p (1 + c_e / c_i), and the band
// of a critical speed.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "messages/alert.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace failing_evaluation_test {

/// As another system, but for what happens where its small deviations are asked for.
class Failing final : public Dynamics {
 public:
  Failing(std::shared_ptr<const Dynamics> system, std::function<void()> happens)
      : system_(std::move(system)), happens_(std::move(happens)) {}

  std::string model() const override { return system_->model(); }
  int dof() const override { return system_->dof(); }
  std::vector<CoordinateInfo> coordinates() const override { return system_->coordinates(); }
  bool linear() const override { return false; }
  bool hasShaft() const override { return system_->hasShaft(); }
  bool isRotor() const override { return system_->isRotor(); }
  bool speedDependent() const override { return system_->speedDependent(); }
  double phaseMark() const override { return system_->phaseMark(); }
  double naturalLength() const override { return system_->naturalLength(); }
  const Dynamics& atMeanLoad() const override { return *this; }
  std::string singularMass() const override { return ""; }
  std::vector<Station> stations() const override { return system_->stations(); }
  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override {
    return system_->acceleration(q, v, at);
  }
  Eigen::VectorXd residualForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                const EvaluationPoint<double>& at) const override {
    return system_->residualForce(q, v, at);
  }
  Eigen::VectorXd appliedForce(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const EvaluationPoint<double>& at) const override {
    return system_->appliedForce(q, v, at);
  }
  Eigen::MatrixXd massMatrix(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                             const EvaluationPoint<double>& at) const override {
    return system_->massMatrix(q, v, at);
  }
  Eigen::VectorXd momenta(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                          const EvaluationPoint<double>& at) const override {
    return system_->momenta(q, v, at);
  }
  Energies energies(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    const EvaluationPoint<double>& at) const override {
    return system_->energies(q, v, at);
  }
  Linearization linearization(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                              const Eigen::VectorXd& a,
                              const EvaluationPoint<double>& at) const override {
    happens_();
    return system_->linearization(q, v, a, at);
  }
  std::vector<Reaction> reactions(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                  const Eigen::VectorXd& a,
                                  const EvaluationPoint<double>& at) const override {
    return system_->reactions(q, v, a, at);
  }
  std::vector<Condition> conditions(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                    const Eigen::VectorXd& a,
                                    const EvaluationPoint<double>& at) const override {
    return system_->conditions(q, v, a, at);
  }
  Sketch sketch(const Eigen::VectorXd& q, const EvaluationPoint<double>& at) const override {
    return system_->sketch(q, at);
  }

 private:
  std::shared_ptr<const Dynamics> system_;
  std::function<void()> happens_;
};

SharedSystem failing(const SharedSystem& system, std::function<void()> happens) {
  auto other = std::make_shared<BuiltSystem>(*system);
  other->dynamics = std::make_shared<Failing>(system->dynamics, std::move(happens));
  return other;
}

/// Within its critical band; above its threshold speed of 20 (1 + 8/8) rad/s; a pendulum.
constexpr char kDanger[] = R"(
step: 0.001
drives: {shaft: {speed: 58.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 7200.0, damping: 12.0, eccentricity: 1.0e-4}
  unstable:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 800.0, damping: 8.0, internal_damping: 8.0}
  pendulum: {model: pendulum, parameters: {mass: 1.0, length: 0.5, damping: 0.3}}
)";

StabilityResult lastOf(EvaluationQueue& queue) {
  StabilityResult last;
  while (queue.pending()) {
    for (StabilityResult& result : queue.take()) {
      last = std::move(result);
    }
    std::this_thread::yield();
  }
  return last;
}

TEST(AFailingEvaluation, IsUncertainWithItsReasonAndTheOthersAreJudged) {
  const BuiltScene scene = build(sceneOf(kDanger));
  const SharedSystem rotor =
      failing(scene.systems[0], [] { throw std::runtime_error("no convergence"); });
  for (const EvaluationQueue::Mode mode :
       {EvaluationQueue::Mode::kAtOnce, EvaluationQueue::Mode::kConcurrent}) {
    EvaluationQueue queue({rotor, scene.systems[1]}, mode);
    queue.add({0, rotor, {1, 0.001, 0}, {0.0, 0.0}, {0.0, 0.0}, 58.0, 0});
    const StabilityResult uncertain = lastOf(queue);
    EXPECT_EQ(uncertain.failure, "no convergence");
    EXPECT_EQ(uncertain.margin.verdict_name, "uncertain");
    EXPECT_EQ(uncertain.margin.system, "rotor");
    queue.add({1, scene.systems[1], {1, 0.001, 0}, {0.0, 0.0}, {0.0, 0.0}, 58.0, 0});
    const StabilityResult judged = lastOf(queue);
    EXPECT_EQ(judged.failure, "");
    EXPECT_EQ(judged.margin.verdict_name, "unstable");
    ASSERT_TRUE(judged.speeds);
    EXPECT_NEAR(judged.speeds->thresholds.lowest(), 40.0, 1.0e-6);
    // With other parameters it is evaluated again.
    queue.add({0, scene.systems[0], {2, 0.002, 0}, {0.0, 0.0}, {0.0, 0.0}, 58.0, 0});
    EXPECT_EQ(lastOf(queue).margin.verdict_name, "asymptotically_stable");
  }
}

/// Seconds from now.
double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(AnEvaluationThatTakesTooLong, IsUncertainAndTheOthersAreJudgedInTime) {
  const BuiltScene scene = build(sceneOf(kDanger));
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  const SharedSystem slow = failing(scene.systems[0], [ended] { ended.wait(); });
  const auto begin = std::chrono::steady_clock::now();
  {
    EvaluationQueue queue({slow, scene.systems[1]}, EvaluationQueue::Mode::kConcurrent);
    EXPECT_LT(secondsSince(begin), kMaxEvaluation + 1.0);  // it does not wait for the speeds
    StabilityResult uncertain;
    double longest_wait = 0.0;
    std::int64_t step = 0;
    while (uncertain.failure.empty() && secondsSince(begin) < 3.0 * kMaxEvaluation) {
      ++step;
      queue.add({0, slow, {step, 0.1, 0}, {0.0, 0.0}, {0.0, 0.0}, 58.0, 0});
      queue.add({1, scene.systems[1], {step, 0.1, 0}, {0.0, 0.0}, {0.0, 0.0}, 58.0, 0});
      const auto asked = std::chrono::steady_clock::now();
      bool answered = false;
      while (!answered && secondsSince(asked) < 3.0) {
        for (StabilityResult& result : queue.take()) {
          answered = answered || (result.request.system == 1 && result.margin.at.step == step);
          if (result.request.system == 0) {
            uncertain = std::move(result);
          } else {
            EXPECT_EQ(result.margin.verdict_name, "unstable");
          }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      longest_wait = std::max(longest_wait, secondsSince(asked));
    }
    EXPECT_EQ(uncertain.failure, "its evaluation takes longer than 5 s");
    EXPECT_EQ(uncertain.margin.verdict_name, "uncertain");
    EXPECT_LT(longest_wait, 1.0);  // 0.2 s, and what a busy machine takes
    // Parameters that can be evaluated are, though the others are still being.
    queue.add({0, scene.systems[0], {1, 0.2, 0}, {0.0, 0.0}, {0.0, 0.0}, 58.0, 0});
    EXPECT_EQ(lastOf(queue).margin.verdict_name, "asymptotically_stable");
  }
  EXPECT_LT(secondsSince(begin), 4.0 * kMaxEvaluation);  // nobody has waited for it
  end.set_value();
}

bool isActive(WatchedTwin& watched, const std::string& system, const std::string& type) {
  for (const state::Alert& alert : watched.monitor.alerts().active()) {
    if (alert.system == system && alert.type == type) {
      return true;
    }
  }
  return false;
}

TEST(ParametersThatOverflow, LeaveTheAlarmsOfTheirSystemAndOfAllOthers) {
  for (const auto& [name, value] :
       {std::pair("internal_damping", 1e308), {"stiffness", 1e308}, {"mass", 5e-324}}) {
    WatchedTwin watched(sceneOf(kDanger));
    watched.run(7.0);
    ASSERT_TRUE(isActive(watched, "rotor", alert_type::kInCriticalBand));
    ASSERT_TRUE(isActive(watched, "unstable", alert_type::kUnstable));
    for (const std::size_t system : {0U, 1U}) {
      state::ParameterChange change = watched.twin.systems()[system]->parameters();
      for (std::size_t i = 0; i < change.names.size(); ++i) {
        change.values[i] = change.names[i] == name ? value : change.values[i];
      }
      EXPECT_FALSE(watched.monitor.take(change)) << name;
    }
    watched.margins.clear();
    watched.run(5.0);
    EXPECT_TRUE(isActive(watched, "rotor", alert_type::kInCriticalBand)) << name;
    EXPECT_TRUE(isActive(watched, "unstable", alert_type::kUnstable)) << name;
    for (const state::StabilityMargin& margin : watched.margins) {
      EXPECT_EQ(margin.verdict_name == "uncertain", margin.system != "pendulum") << margin.system;
    }
    const std::vector<std::string> why = watched.monitor.notOk(watched.wall, false);
    EXPECT_NE(why[0].find("cannot be evaluated: parameters: systems.rotor.parameters"),
              std::string::npos)
        << why[0];
    EXPECT_EQ(why[2], "");
    // What it was before is believed again.
    EXPECT_TRUE(watched.monitor.take(watched.twin.systems()[0]->parameters()));
    watched.run(0.5);
    EXPECT_EQ(watched.monitor.notOk(watched.wall, false)[0], "");
  }
}

}  // namespace failing_evaluation_test
}  // namespace whirl_twin
