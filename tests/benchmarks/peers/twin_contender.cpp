#include "twin_contender.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "scene/scene_reader.h"
#include "twin/twin.h"

namespace whirl_twin::comparison {
namespace {

class TwinRun final : public Run {
 public:
  TwinRun(const Scene& scene, const Output& output, std::int64_t steps)
      : scene_(scene), output_(output), steps_(steps) {}

  /// Builds the twin and takes its first step, with which some methods prepare theirs.
  void prepare() override {
    twin_ = std::make_unique<Twin>(scene_);
    state_.resize(2 * twin_->running(0).dof() + 1);
    twin_->step();
    twin_->reset();
  }
  bool integrate(double* out) override {
    twin_->reset();
    for (std::size_t sample = 0; sample < output_.samples; ++sample) {
      for (std::int64_t i = 0; i < steps_; ++i) {
        twin_->step();
      }
      twin_->running(0).write(state_.data());
      out = std::copy_n(state_.data(), output_.coordinates, out);
    }
    return twin_->status(0) == StepStatus::kOk;
  }

 private:
  Scene scene_;
  Output output_;
  std::int64_t steps_;  ///< between two samples
  std::unique_ptr<Twin> twin_;
  std::vector<double> state_;
};

/// Steps are whole numbers of nanoseconds: the counts that divide the interval, thinned.
std::vector<double> dividingCounts(const Output& output) {
  const std::int64_t interval = std::llround(output.interval * 1.0e9);
  std::vector<double> counts;
  for (std::int64_t count = 1; count < 100000; ++count) {
    const auto value = static_cast<double>(count);
    if (interval % count == 0 && (counts.empty() || value >= 1.1 * counts.back())) {
      counts.push_back(value);
    }
  }
  return counts;
}

}  // namespace

void addTwin(const std::string& text, const Output& output, std::vector<Contender>& contenders) {
  const auto scene = [text, output](double steps, const std::string& integrator) {
    YAML::Node tree = YAML::Load(text);
    tree["step"] = fmt::format("{:.9f}", output.interval / steps);
    for (auto system : tree["systems"]) {
      system.second["integrator"] = integrator;
    }
    return readScene(tree, "benchmark");
  };
  const Twin twin(scene(1.0, "auto"));
  if (twin.running(0).dof() != output.coordinates) {
    throw std::logic_error("the scene and its equations differ in their coordinates");
  }
  for (const std::string& integrator : twin.systems()[0]->setup().integrators) {
    contenders.push_back({"whirl_twin " + integrator, true, Ladder::kSteps, dividingCounts(output),
                          [scene, output, integrator](double steps) {
                            return std::make_unique<TwinRun>(scene(steps, integrator), output,
                                                             std::llround(steps));
                          }});
  }
}

}  // namespace whirl_twin::comparison
