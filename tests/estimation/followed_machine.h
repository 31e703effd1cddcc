// A simulated plant that publishes its sensor data, and the state estimator that follows it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "estimation/estimator_scene.h"
#include "estimation/state_estimator.h"
#include "scene/scene_reader.h"
#include "twin/measurements.h"
#include "twin/observer.h"

namespace whirl_twin {

inline BuiltScene builtSceneOf(const std::string& text) {
  return build(readScene(YAML::Load(text), "a test"));
}

/// A running plant that publishes its sensor data.
class Machine {
 public:
  explicit Machine(const std::string& scene)
      : twin_(builtSceneOf(scene)),
        generations_(std::make_shared<SystemGenerations>(twin_)),
        observer_(twin_, generations_),
        measurements_(twin_.scene().sensors, twin_.built(), observer_),
        record_(twin_.layout().size) {}

  std::vector<state::Measurement> step() {
    twin_.step();
    twin_.write(record_.data());
    observer_.observe(record_.data());
    return measurements_.observe(observer_);
  }
  void setStiffness(double stiffness) {
    const SharedSystem next =
        twin_.systems()[0]->with({"stiffness", "stiffness_y"}, {stiffness, stiffness}, "a test");
    const std::int64_t generation = generations_->add(0, {next->dynamics, next->parameters()});
    old_.push_back(twin_.replace(0, twin_.stepperOf(*next), generation));
  }
  double time() const { return twin_.time(); }
  double x() const { return observer_.coordinates(0)[0]; }
  double y() const { return observer_.coordinates(0)[1]; }

 private:
  Twin twin_;
  std::shared_ptr<SystemGenerations> generations_;
  Observer observer_;
  Measurements measurements_;
  std::vector<double> record_;
  std::vector<std::unique_ptr<Stepper>> old_;
};

/// The state estimator, and all its output.
class Twinned {
 public:
  Twinned(const std::string& scene, const FollowSettings& settings)
      : twin_(build(readEstimatorScene(YAML::Load(scene), "a test"))),
        follower(twin_, std::make_shared<SystemGenerations>(twin_), settings, 10, listener()) {}

  const state::FollowState& last() const { return published.back(); }
  double x() const { return whirl_[whirl_.size() - 2]; }
  double y() const { return whirl_.back(); }
  /// Of all records, one after another.
  std::vector<double> whirl() const { return whirl_; }
  std::vector<double> time;   ///< [s], of each record
  std::vector<double> angle;  ///< [rad], of the shaft in each record
  double recorded = 0.0;      ///< [s], of the newest record
  double speed = 0.0;         ///< [rad/s], of the shaft there

 private:
  EstimatorListener listener() {
    return {[this](const double* record) {
              const auto rotor = twin_.layout().system(record, 0);
              whirl_.push_back(rotor.q()[0]);
              whirl_.push_back(rotor.q()[1]);
              recorded = twin_.seconds(RecordLayout::step(record));
              time.push_back(recorded);
              angle.push_back(RecordLayout::shaft(record, 0).angle().total());
              speed = RecordLayout::shaft(record, 0).speed();
            },
            [this](const state::FollowState& state) { published.push_back(state); }};
  }

  Twin twin_;
  std::vector<double> whirl_;

 public:
  std::vector<state::FollowState> published;
  StateEstimator follower;
};

}  // namespace whirl_twin
