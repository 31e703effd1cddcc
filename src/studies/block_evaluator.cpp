#include "studies/block_evaluator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "messages/refusal.h"
#include "realtime/denormals.h"
#include "twin/ensemble_members.h"

namespace whirl_twin {

namespace {

const char* const kTogether = "side by side in vectors";
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
      together_(mayGoTogether()) {}

/// One system on a shaft that turns alike at all points, and measured by its peak alone.
bool BlockEvaluator::mayGoTogether() const {
  const Scene& scene = scene_.scene;
  if (!study_.duration || scene.systems.size() != 1 || !scene.controllers.empty() ||
      !scene_.systems[0]->dynamics->isRotor() || scene_.systems[0]->integrator != kMethod) {
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
  if (together_) {  // how a step is parted hangs on all that go together
    if (const auto all = together(block)) {
      return (*all)[point - study_.firstOf(block)];
    }
  }
  return one_.at(study_.valuesAt(point));
}

std::optional<std::vector<Outcome>> BlockEvaluator::together(std::uint64_t block) {
  std::vector<Outcome> all(study_.sizeOf(block));
  std::vector<EnsembleMember> members;
  std::vector<std::size_t> places;  // of the members among the points
  const auto values = [&](std::size_t i) { return study_.valuesAt(study_.firstOf(block) + i); };
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (stop_.load(std::memory_order_relaxed)) {
      throw Interrupted();
    }
    try {
      SystemSpec spec = one_.sceneAt(values(i)).systems.front();
      ModelSetup made = spec.setup->made;
      members.push_back({std::move(spec), std::move(made)});
      places.push_back(i);
    } catch (const Refusal&) {
      all[i] = one_.at(values(i));  // which says why
    }
  }
  if (members.empty()) {
    return all;
  }
  Drive drive = scene_.driveOf(*scene_.systems[0]);
  const auto steps = ensembleSteps(members, kMethod, Excitation(drive), scene_.scene.stepSeconds());
  if (std::string(steps->description()) != kTogether) {
    return std::nullopt;
  }
  const auto count =
      static_cast<std::int64_t>(std::llround(*study_.duration / scene_.scene.stepSeconds()));
  const DenormalsToZero denormals_to_zero;
  for (std::int64_t step = 0; step < count; ++step) {
    if (stop_.load(std::memory_order_relaxed)) {
      throw Interrupted();
    }
    const std::int64_t now = scene_.scene.time + step * scene_.scene.step;
    drive.begin(now);
    steps->step(static_cast<double>(now) * 1.0e-9);
  }
  std::vector<double> radii(members.size());
  std::vector<double> peaks(members.size());
  steps->write(radii.data(), peaks.data());
  for (std::size_t m = 0; m < members.size(); ++m) {
    const std::vector<double> point = values(places[m]);
    if (!std::isfinite(peaks[m]) || !std::isfinite(radii[m])) {
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
                             : peaks[m]);
      }
      all[places[m]].measures.push_back(measure.expression.value(leaves));
    }
  }
  return all;
}

}  // namespace whirl_twin
