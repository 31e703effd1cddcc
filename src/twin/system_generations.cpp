#include "twin/system_generations.h"

#include <algorithm>
#include <utility>

#include "scene/changed_controller.h"

namespace whirl_twin {

SystemGenerations::SystemGenerations(const Twin& twin) {
  for (const SharedSystem& system : twin.systems()) {
    SystemGeneration start{system->dynamics, system->parameters()};
    known_.push_back({{0, std::make_shared<const SystemGeneration>(std::move(start))}});
  }
  for (const ControllerSpec& controller : twin.scene().controllers) {
    SystemGeneration start{nullptr, parametersOf(controller)};
    known_.push_back({{0, std::make_shared<const SystemGeneration>(std::move(start))}});
  }
}

std::int64_t SystemGenerations::add(std::size_t which, SystemGeneration generation) {
  const std::lock_guard<std::mutex> lock(mutex_);
  known_[which][++newest_] = std::make_shared<const SystemGeneration>(std::move(generation));
  return newest_;
}

void SystemGenerations::restore(std::size_t which, std::int64_t number,
                                SystemGeneration generation) {
  const std::lock_guard<std::mutex> lock(mutex_);
  known_[which][number] = std::make_shared<const SystemGeneration>(std::move(generation));
  newest_ = std::max(newest_, number);
}

std::shared_ptr<const SystemGeneration> SystemGenerations::at(std::size_t which,
                                                              std::int64_t generation) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return known_[which].at(generation);
}

void SystemGenerations::forgetBefore(std::size_t which, std::int64_t generation) {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto& known = known_[which];
  if (generation > 0) {
    known.erase(known.upper_bound(0), known.lower_bound(generation));
  }
}

}  // namespace whirl_twin
