#include "studies/block_evaluator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "messages/input_error.h"
#include "realtime/denormals.h"
#include "scene/parameter_paths.h"
#include "twin/ensemble_members.h"

namespace whirl_twin {

namespace {

const char* const kMethod = "exponential";

bool isNamed(const SceneNumber& place, std::size_t at, const std::string& name) {
  const auto* const key = at < place.size() ? std::get_if<std::string>(&place[at]) : nullptr;
  return key != nullptr && *key == name;
}

bool isVaried(const Study& study, const std::string& path) {
  return std::any_of(study.vary.begin(), study.vary.end(),
                     [&](const Variation& v) { return v.path == path; });
}

}  // namespace

BlockEvaluator::BlockEvaluator(const Study& study, const StepsChosen& steps,
                               const std::atomic<bool>& stop)
    : study_(study),
      stop_(stop),
      one_(study, steps, stop),
      scene_(build(one_.sceneAt({}))),
      together_(mayGoTogether()) {
  if (together_) {
    quick_.emplace(study, scene_);
  }
}

/// A single system, on a shaft with the same motion at all points, of which only the peak is
/// measured.
bool BlockEvaluator::mayGoTogether() const {
  const Scene& scene = scene_.scene;
  if (!study_.duration || scene.systems.size() != 1 || !scene.controllers.empty() ||
      !scene_.systems[0]->dynamics->isRotor() || scene_.systems[0]->integrator != kMethod) {
    return false;
  }
  const bool avoids =  // critical speeds, which depend on the point
      std::any_of(scene.drives.begin(), scene.drives.end(),
                  [](const DriveSpec& drive) { return !drive.avoid.empty(); });
  if (avoids) {
    return false;
  }
  const std::string& name = scene.systems[0].name;
  const bool of_system =
      std::all_of(study_.vary.begin(), study_.vary.end(), [&](const Variation& variation) {
        const SceneNumber& place = variation.places.front();
        return isNamed(place, 0, "systems") && isNamed(place, 1, name) &&
               (isNamed(place, 2, "initial") ||
                (isNamed(place, 2, "parameters") && !isNamed(place, 3, "speed")));
      });
  return of_system &&
         std::all_of(study_.measures.begin(), study_.measures.end(), [&](const Measure& measure) {
           const std::vector<ExpressionLeaf>& leaves = measure.expression.leaves();
           return std::all_of(leaves.begin(), leaves.end(), [&](const ExpressionLeaf& leaf) {
             return leaf.reduction.empty()
                        ? isVaried(study_, leaf.path)
                        : (leaf.reduction == "max" || leaf.reduction == "peak") &&
                              (leaf.path == name + ".whirl.radius" ||
                               leaf.path == name + ".whirl_radius");
           });
         });
}

std::vector<Outcome> BlockEvaluator::outcomes(std::uint64_t block,
                                              const std::function<void(std::uint64_t)>& done) {
  if (together_) {
    if (auto all = together(block)) {
      done(study_.sizeOf(block));
      return *std::move(all);
    }
  }
  std::vector<Outcome> all;
  for (std::uint64_t i = 0; i < study_.sizeOf(block); ++i) {
    if (stop_.load(std::memory_order_relaxed)) {
      throw Interrupted();
    }
    all.push_back(one_.at(study_.valuesAt(study_.firstOf(block) + i)));
    if (study_.stop_at_failure && !all.back().failure.empty()) {
      break;
    }
    done(1);
  }
  return all;
}

Outcome BlockEvaluator::at(std::uint64_t point) {
  const std::uint64_t block = point / study_.block;
  if (together_) {  // the number of sub-steps depends on the whole batch
    if (const auto all = together(block)) {
      return (*all)[point - study_.firstOf(block)];
    }
  }
  return one_.at(study_.valuesAt(point));
}

BlockEvaluator::Quick::Quick(const Study& study, const BuiltScene& scene)
    : model(*scene.systems[0]->model), spec(scene.scene.systems[0]) {
  possible = !spec.rest;  // the equilibrium depends on the point
  for (const Variation& variation : study.vary) {
    const SceneNumber& place = variation.places.front();
    possible = possible && variation.places.size() == 1 && variation.written_unit.empty() &&
               place.size() == 4 && isNamed(place, 2, "parameters") &&
               std::holds_alternative<std::string>(place[3]);
    names.push_back(possible ? std::get<std::string>(place[3]) : "");
  }
}

bool BlockEvaluator::Quick::put(const std::vector<double>& values) {
  Diagnostics diagnostics("");
  for (std::size_t j = 0; j < names.size(); ++j) {
    if (!setParameter(names[j], values[j], model, spec, diagnostics)) {
      return false;
    }
  }
  return true;
}

/// Is its result the same as that of reading the whole scene?
bool BlockEvaluator::isQuick(const std::vector<double>& values) {
  if (!quick_->possible || !quick_->put(values)) {
    return false;
  }
  try {
    const SystemSpec read = one_.sceneAt(values).systems.front();
    return read.parameters == quick_->spec.parameters && read.q == quick_->spec.q &&
           read.v == quick_->spec.v && read.speed == quick_->spec.speed;
  } catch (const InputError&) {
    return false;
  }
}

std::optional<IsotropicRotor> BlockEvaluator::rotorAt(const std::vector<double>& values,
                                                      bool quick) {
  if (!quick || !quick_->put(values)) {
    const SystemSpec spec = one_.sceneAt(values).systems.front();
    return isotropicRotor(*spec.setup->made.dynamics, spec);
  }
  const SystemSpec& spec = quick_->spec;
  const ModelSetup made = quick_->model.setUp(spec.parameters, spec.settings, spec.setup->around);
  return isotropicRotor(*made.dynamics, spec);
}

std::optional<std::vector<Outcome>> BlockEvaluator::together(std::uint64_t block) {
  std::vector<Outcome> all(study_.sizeOf(block));
  std::vector<IsotropicRotor> rotors;
  std::vector<std::size_t> places;  // of the rotors among the points
  const auto values = [&](std::size_t i) { return study_.valuesAt(study_.firstOf(block) + i); };
  const bool quick = isQuick(values(0)) && isQuick(values(all.size() - 1));
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (stop_.load(std::memory_order_relaxed)) {
      throw Interrupted();
    }
    try {
      const std::optional<IsotropicRotor> rotor = rotorAt(values(i), quick);
      if (!rotor) {
        return std::nullopt;
      }
      rotors.push_back(*rotor);
      places.push_back(i);
    } catch (const std::exception&) {
      all[i] = one_.at(values(i));  // which reports the reason
    }
  }
  if (rotors.empty()) {
    return all;
  }
  Drive drive = scene_.driveOf(*scene_.systems[0]);
  IsotropicRotors steps(rotors, scene_.scene.stepSeconds(), highestSpeed(drive));
  if (steps.parts() > kMaxPartsSideBySide) {
    return std::nullopt;
  }
  const auto count =
      static_cast<std::int64_t>(std::llround(*study_.duration / scene_.scene.stepSeconds()));
  const DenormalsToZero denormals_to_zero;
  for (std::int64_t step = 0; step < count; ++step) {
    if (stop_.load(std::memory_order_relaxed)) {
      throw Interrupted();
    }
    drive.begin(scene_.scene.time + step * scene_.scene.step);
    steps.stepLater(drive);
  }
  steps.catchUp();
  for (std::size_t m = 0; m < rotors.size(); ++m) {
    const std::vector<double> point = values(places[m]);
    const double peak = steps.peak(m);
    if (!std::isfinite(peak) || !std::isfinite(std::norm(steps.position(m)))) {
      all[places[m]] = one_.at(point);
      continue;
    }
    for (const Measure& measure : study_.measures) {
      std::vector<double> leaves;
      for (const ExpressionLeaf& leaf : measure.expression.leaves()) {
        const auto varied = std::find_if(study_.vary.begin(), study_.vary.end(),
                                         [&](const Variation& v) { return v.path == leaf.path; });
        leaves.push_back(leaf.reduction.empty()
                             ? point[static_cast<std::size_t>(varied - study_.vary.begin())]
                             : peak);
      }
      all[places[m]].measures.push_back(measure.expression.value(leaves));
    }
  }
  return all;
}

}  // namespace whirl_twin
