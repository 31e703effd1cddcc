// A twin stepped by a loop of Python: whole steps only, bit-identical to those of a run.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "twin/observer.h"
#include "twin/system_generations.h"
#include "twin/twin.h"

namespace whirl_twin {

class SteppedTwin {
 public:
  /// Throws SceneError if the steps cannot be prepared.
  explicit SteppedTwin(const Scene& scene);

  /// `look` is called about every 50 ms of wall time; its exception ends the steps after a whole
  /// one.
  void step(std::int64_t count, const std::function<void()>& look);
  void reset();

  /// Of its name. Throws InputError with a hint.
  std::size_t systemNamed(const std::string& name) const;
  /// An input from the next step on, for so many seconds of simulated time; none: until the next
  /// value. Throws InputError for an input that is not there or not a number in the scene.
  void setInput(const std::string& system, const std::string& input, double value,
                std::optional<double> duration);
  /// A parameter by its path, in the unit of the model, from the next step on. Throws InputError.
  void setParameter(const std::string& system, const std::string& path, double value);
  std::optional<double> parameter(const std::string& system, const std::string& path) const;

  /// The state as bytes; restore() takes it back into a twin of the same scene, whose parameters
  /// must be those of the scene. Both throw InputError, with nothing changed.
  std::string save();
  void restore(const std::string& bytes);

  const Twin& twin() const { return twin_; }
  const Observer& observer() const { return observer_; }

 private:
  void observe();
  void put(std::int64_t step, const std::string& images, std::size_t twin_size);
  std::int64_t stepUnobserved(std::int64_t count);

  Scene scene_;
  Twin twin_;
  std::shared_ptr<SystemGenerations> generations_;
  Observer observer_;
  std::vector<double> record_;
  std::vector<SharedSystem> systems_;  // with the parameters as they are
};

}  // namespace whirl_twin
