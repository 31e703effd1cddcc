#include "studies/point_evaluator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "accuracy/step_choice.h"
#include "messages/input_error.h"
#include "realtime/denormals.h"
#include "scene/scene_reader.h"
#include "scene/yaml_file.h"
#include "studies/alarm_watch.h"
#include "studies/analysed_numbers.h"
#include "studies/published_quantities.h"
#include "twin/stop_text.h"
#include "twin/twin.h"

namespace whirl_twin {

namespace {

constexpr std::int64_t kStopCheckSteps = 1024;  // steps between checks of `stop`

/// A reduction during a run, and the place of its result.
struct Followed {
  PublishedQuantity quantity;
  Reduction reduction;
  double* result;
};

/// Alarms of a type, and the place of their number.
struct Counted {
  std::string type;
  double* result;
};

/// Replaces line breaks.
std::string oneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ';');
  return text;
}

}  // namespace

StepsChosen chooseSteps(const Study& study) {
  StepsChosen chosen;
  const Scene scene = readSceneFile(study.scene_path);
  chosen.choices.resize(scene.systems.size());
  if (study.duration) {
    const std::vector<StepChoice> choices = chooseSteps(scene);
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (scene.systems[i].integrator == "auto") {
        chosen.choices[i] = {choices[i].integrator, choices[i].substeps};
      }
    }
  }
  return chosen;
}

PointEvaluator::PointEvaluator(const Study& study, const StepsChosen& steps,
                               const std::atomic<bool>& stop)
    : study_(study),
      steps_(steps),
      stop_(stop),
      tree_(separated(readYamlText(study.scene_text, study.scene_path, "a scene", "a step"))) {}

Scene PointEvaluator::sceneAt(const std::vector<double>& values) {
  for (std::size_t j = 0; j < values.size(); ++j) {
    for (const SceneNumber& place : study_.vary[j].places) {
      put(tree_, place, values[j], study_.vary[j].written_unit);
    }
  }
  Scene scene = readScene(tree_, study_.scene_path);
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    scene.systems[i].ensemble = {};
    const StepsChosen::Choice& choice = steps_.choices[i];
    if (!choice.integrator.empty()) {
      scene.systems[i].chosen_integrator = choice.integrator;
      scene.systems[i].substeps = choice.substeps;
    }
  }
  return scene;
}

void PointEvaluator::simulate(const Scene& scene, std::vector<std::vector<double>>& leaves) {
  Twin twin(scene);
  const std::map<std::string, PublishedQuantity> published = publishedQuantities(twin.built());
  std::vector<Followed> followed;
  std::vector<Counted> counted;
  for (std::size_t k = 0; k < study_.measures.size(); ++k) {
    const std::vector<ExpressionLeaf>& asked = study_.measures[k].expression.leaves();
    for (std::size_t i = 0; i < asked.size(); ++i) {
      if (asked[i].reduction.empty()) {
        if (const auto type = countedAlarm(asked[i].path)) {
          counted.push_back({*type, &leaves[k][i]});
        }
        continue;
      }
      const auto found = published.find(asked[i].path);
      if (found == published.end()) {
        throw InputError(fmt::format("has no {} with these parameters", asked[i].path));
      }
      followed.push_back(
          {found->second, Reduction(asked[i].reduction, asked[i].argument), &leaves[k][i]});
    }
  }
  const auto steps =
      static_cast<std::int64_t>(std::llround(*study_.duration / scene.stepSeconds()));
  std::optional<AlarmWatch> alarms;
  if (!counted.empty()) {
    alarms.emplace(twin, study_.alarms);
  }
  QuantityReader reader(twin);
  const DenormalsToZero denormals_to_zero;  // as `twin simulate`: the same numbers
  for (std::int64_t step = 0; step <= steps; ++step) {
    if (step % kStopCheckSteps == 0 && stop_.load(std::memory_order_relaxed)) {
      throw Interrupted();
    }
    if (step > 0) {
      twin.step();
    }
    if (alarms) {
      alarms->look();
    }
    reader.look();
    for (Followed& f : followed) {
      if (!f.quantity.ofDrive() && twin.status(f.quantity.owner) != StepStatus::kOk) {
        throw RunFailure(fmt::format("{} stopped in step {} (t = {:g} s): {}",
                                     scene.systems[f.quantity.owner].name, step, twin.time(),
                                     describe(twin.status(f.quantity.owner))));
      }
      const double value = reader.value(f.quantity);
      if (f.quantity.kind != PublishedQuantity::Kind::kVibration || !std::isnan(value)) {
        f.reduction.take(twin.time(), value);
      }
    }
  }
  for (const Followed& f : followed) {
    *f.result = f.reduction.result();
  }
  for (const Counted& c : counted) {
    *c.result = alarms->raised(c.type);
  }
}

std::vector<double> PointEvaluator::measured(const std::vector<double>& values) {
  const Scene scene = sceneAt(values);
  std::vector<std::vector<double>> leaves;
  for (const Measure& measure : study_.measures) {
    leaves.emplace_back(measure.expression.leaves().size());
  }
  if (study_.duration) {
    simulate(scene, leaves);
  }
  const BuiltScene built = build(scene);
  AnalysedScene analysed(built, study_.speed);
  std::vector<double> results;
  for (std::size_t k = 0; k < study_.measures.size(); ++k) {
    const Expression& expression = study_.measures[k].expression;
    for (std::size_t i = 0; i < leaves[k].size(); ++i) {
      const ExpressionLeaf& leaf = expression.leaves()[i];
      if (!leaf.reduction.empty() || countedAlarm(leaf.path)) {
        continue;
      }
      const auto varied = std::find_if(study_.vary.begin(), study_.vary.end(),
                                       [&](const Variation& v) { return v.path == leaf.path; });
      leaves[k][i] = varied != study_.vary.end()
                         ? values[static_cast<std::size_t>(varied - study_.vary.begin())]
                         : analysed.value(analysedNumber(leaf.path, built).value());
    }
    results.push_back(expression.value(leaves[k]));
  }
  return results;
}

Outcome PointEvaluator::at(const std::vector<double>& values) {
  try {
    return {measured(values), ""};
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    return {{}, oneLine(error.what())};
  }
}

}  // namespace whirl_twin
